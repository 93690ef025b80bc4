#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Area of a face that cannot be told from none, as a share of the squared size of the model.
constexpr float least_area = 4e-12F;

constexpr float pi = static_cast<float>(math::pi);

// Limbs that are looked at together: so many, or more where there are very many.
constexpr std::size_t least_limbs_a_chunk = 64, most_chunks = 128;
std::size_t limbs_a_chunk(std::size_t limbs) {
  return std::max(least_limbs_a_chunk, chunk_count(limbs, most_chunks));
}

// At fewer triangles one thread looks after what was written anew.
constexpr std::size_t many_triangles = 4096;

// Pairs of groups of a loop's normals that are joined together.
constexpr std::size_t pairs_a_chunk = 1024;

}  // namespace

/// Faces at loops: the normals as long as twice their area and of unit length; side by side that area, and of
/// each corner how far its edges go along each other; then by how much the face counts there.
struct GraftWriter::FaceBlock {
  static constexpr std::size_t most = 16;
  std::uint32_t corner[3 * most];
  FourFloats normal[most], unit[most];
  float size[most], along[3][most], weight[3][most];
};

SEEDMESH_WIDE void GraftWriter::measure(FaceBlock& block, const glm::vec3* position) {
  for (std::size_t first = 0; first < FaceBlock::most; first += Four::size) {
    const std::uint32_t* corner = block.corner + 3 * first;
    const Four p[3] = {Four::picked(position, corner), Four::picked(position, corner + 1),
                       Four::picked(position, corner + 2)};
    const Four normal = cross(difference(p[1], p[0]), difference(p[2], p[0]));
    const FourFloats size = root(dot(normal, normal));
    const Four unit = scaled(normal, 1.0F / size);
    normal.to_rows(block.normal + first);
    unit.to_rows(block.unit + first);
    const FourFloats columns[4] = {size, dot(difference(p[1], p[0]), difference(p[2], p[0])),
                                   dot(difference(p[2], p[1]), difference(p[0], p[1])),
                                   dot(difference(p[0], p[2]), difference(p[1], p[2]))};
    float* const out[4] = {block.size, block.along[0], block.along[1], block.along[2]};
    for (int k = 0; k < 4; ++k) std::memcpy(out[k] + first, &columns[k], sizeof(FourFloats));
  }
}

/// The angles at corners, by which faces count, so that it does not matter how the surface is cut into
/// triangles; by the size of the normals. Within 2e-5, after M. Abramowitz and I. Stegun, Handbook of
/// Mathematical Functions, 1964, 4.4.47.
SEEDMESH_WIDE void GraftWriter::weigh(FaceBlock& block) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < FaceBlock::most; ++i) {
      const float opposite = block.size[i], adjacent = block.along[k][i], side = std::abs(adjacent);
      const bool is_steep = opposite > side;
      const float share = (is_steep ? side : opposite) / (is_steep ? opposite : side), z = share * share;
      const float angle =
          share * (0.999866F + z * (-0.3302995F + z * (0.180141F + z * (-0.085133F + z * 0.0208351F))));
      const float sharp = is_steep ? 0.5F * pi - angle : angle;
      block.weight[k][i] = (adjacent < 0 ? pi - sharp : sharp) / opposite;
    }
  }
}

/// parallel_for, but for what was written anew of a small tree.
void GraftWriter::share_out(std::size_t count, std::size_t chunk,
                            const std::function<void(std::size_t, std::size_t, std::size_t)>& body) const {
  if (is_much_) return parallel_for(job_, count, chunk, body);
  for (std::size_t i = 0; i < chunk_count(count, chunk); ++i)
    body(i * chunk, std::min(count, (i + 1) * chunk), i);
}

/// Limbs that were written, those that they grow from, and those that begin at one of them.
void GraftWriter::find_concerned() {
  concern_.assign(range_.size(), Concern::nothing);
  for (std::size_t limb = 0; limb < range_.size(); ++limb) {
    const std::uint32_t parent = parent_.empty() ? none : parent_[limb];
    if (parent != none && dirty_[parent]) concern_[limb] = std::max(concern_[limb], Concern::loop);
    if (!dirty_[limb]) continue;
    concern_[limb] = Concern::all;
    if (parent != none) concern_[parent] = Concern::all;
  }
  std::size_t triangles = 0;
  for (std::size_t limb = 0; limb < range_.size(); ++limb)
    triangles += last_triangle(limb) - range_[limb].begin.triangle;
  is_much_ = is_first() || triangles >= many_triangles;
}

/// Is one of three corners of a loop that has changed?
bool GraftWriter::is_touched(const std::uint32_t* corner) const {
  return std::any_of(corner, corner + 3, [&](std::uint32_t vertex) {
    return group_[vertex] != none && touched_[group_[vertex] / 2];
  });
}

/// Up to where the triangles of a limb have to be looked at.
std::uint32_t GraftWriter::last_triangle(std::size_t limb) const {
  const Range& range = range_[limb];
  return concern_[limb] == Concern::all    ? range.end.triangle
         : concern_[limb] == Concern::loop ? range.first_end
                                           : range.begin.triangle;
}

/// Calls each(triangle) for those of a limb that touch a loop that has changed, as far as they have to be
/// looked at.
template <class Each>
void GraftWriter::each_at_loops(std::size_t limb, const Each& each) const {
  const Range& range = range_[limb];
  const std::uint32_t end = last_triangle(limb);
  for (std::size_t i = range.begin.loop_triangle; i < range.end.loop_triangle; ++i) {
    const std::uint32_t triangle = loop_triangles_[i];
    if (triangle >= end) break;
    if (is_first() || is_touched(mesh_.index.wide.data() + std::size_t{3} * triangle)) each(triangle);
  }
}

/// What the faces of some limbs give to the normals of the loops that they touch, or to groups from `nowhere`
/// on, behind all others: one for each face of a block, so that none waits for another. These faces are noted
/// at `to`; returns where they end.
GraftWriter::LoopFace* GraftWriter::add_loop_normals(std::size_t first_limb, std::size_t last_limb,
                                                     std::uint32_t nowhere, LoopFace* to) {
  FaceBlock block;
  std::size_t count = 0;
  const std::uint32_t* index = mesh_.index.wide.data();
  const auto add = [&](std::uint32_t triangle) {
    const std::uint32_t* corner = index + std::size_t{3} * triangle;
    for (std::size_t k = 0; k < 3; ++k) block.corner[3 * count + k] = corner[k];
    if (++count < FaceBlock::most) return;
    to = add_loop_faces(block, count, nowhere, to);
    count = 0;
  };
  if (is_first()) {  // they stand one behind another
    const std::size_t end = range_[last_limb - 1].end.loop_triangle;
    for (std::size_t i = range_[first_limb].begin.loop_triangle; i < end; ++i) add(loop_triangles_[i]);
  } else {
    for (std::size_t limb = first_limb; limb < last_limb; ++limb) each_at_loops(limb, add);
  }
  return count > 0 ? add_loop_faces(block, count, nowhere, to) : to;
}

/// The first `count` of a block, whose corners are known.
GraftWriter::LoopFace* GraftWriter::add_loop_faces(FaceBlock& block, std::size_t count, std::uint32_t nowhere,
                                                   LoopFace* face) {
  for (std::size_t l = count; l < FaceBlock::most; ++l) std::copy_n(block.corner, 3, block.corner + 3 * l);
  measure(block, mesh_.position.data());
  weigh(block);
  const bool all = is_first();
  GroupNormal* const sums = group_normal_.data();
  for (std::size_t l = 0; l < count; ++l) {
    if (!(block.size[l] > 0)) continue;
    const FourFloats normal = block.normal[l];
    std::memcpy(static_cast<void*>(face), &block.unit[l], sizeof(FourFloats));  // its groups come behind
    // Chosen, not branched to: nobody can foresee which corners count.
    for (std::size_t k = 0; k < 3; ++k) {
      std::uint32_t group = group_[block.corner[3 * l + k]];
      if (!all && group != none && !touched_[group / 2]) group = none;
      face->group[k] = group;
      GroupNormal& sum = sums[std::min(group, nowhere + static_cast<std::uint32_t>(l))];
      sum.row += normal * four_times(block.weight[k][l]);
    }
    ++face;
  }
  return face;
}

/// Faces with these corners, four at once, which look along their normals.
struct GraftWriter::Faces {
  const glm::vec3 *position, *normal;
  float least_square;

  FourFlags sound(const std::uint32_t* corner) const {
    constexpr float flattest = least_cosine_of_face * least_cosine_of_face;
    const Four a = Four::picked(position, corner);
    const Four face = cross(difference(Four::picked(position, corner + 1), a),
                            difference(Four::picked(position, corner + 2), a));
    const FourFloats size = dot(face, face), least = flattest * size;
    FourFlags flags = size > least_square;
    for (std::size_t k = 0; k < 3; ++k) {
      // What comes behind a normal may be another's, who writes it now.
      const auto alone = [&](std::size_t i) { return spread_out(normal[corner[k + i]]); };
      const FourFloats over = dot(face, Four::of_rows(alone(0), alone(3), alone(6), alone(9)));
      flags &= (over > 0.0F) & (over * over > least);
    }
    return flags;
  }
};

/// How many of `count` faces come before the first four that are not all sound.
SEEDMESH_WIDE std::size_t GraftWriter::sound_faces(const Faces& faces, const std::uint32_t* corner,
                                                   std::size_t count) {
  std::size_t sound = 0;
  while (sound + Four::size <= count && all_of(faces.sound(corner + 3 * sound))) sound += Four::size;
  return sound;
}

float GraftWriter::least_square_of_face() const {
  const float least = 2 * least_area * context_.scale.size * context_.scale.size;
  return least * least;
}

GraftWriter::Faces GraftWriter::faces() const {
  return {mesh_.position.data(), mesh_.normal.data(), least_square_of_face()};
}

/// Adds to `bad` what is wrong of the triangles `first` to `last - 1`.
void GraftWriter::look_at(std::uint32_t first, std::uint32_t last, std::vector<std::uint32_t>& bad) const {
  const Faces faces = this->faces();
  const std::uint32_t* index = mesh_.index.wide.data();
  for (std::uint32_t t = first; t < last;) {
    t += static_cast<std::uint32_t>(sound_faces(faces, index + std::size_t{3} * t, last - t));
    const std::uint32_t end = std::min(last, t + static_cast<std::uint32_t>(Four::size));
    std::uint32_t corner[3 * Four::size];
    for (std::uint32_t l = 0; t < end && l < Four::size; ++l)
      std::copy_n(index + std::size_t{3} * std::min(t + l, end - 1), 3, corner + 3 * l);
    const FourFlags flags = t < end ? faces.sound(corner) : FourFlags{};
    for (const std::uint32_t begin = t; t < end; ++t) {
      if (!flags[t - begin]) bad.push_back(t);
    }
  }
}

/// The triangles of a limb that are bad, as far as something has changed for them.
void GraftWriter::find_bad(std::size_t limb, std::vector<std::uint32_t>& bad) const {
  if (dirty_[limb]) return look_at(range_[limb].begin.triangle, last_triangle(limb), bad);
  const Faces faces = this->faces();
  std::uint32_t number[Four::size], corner[3 * Four::size];
  std::size_t count = 0;
  const auto look = [&] {
    for (std::size_t l = count; l < Four::size; ++l) std::copy_n(corner, 3, corner + 3 * l);
    const FourFlags flags = faces.sound(corner);
    for (std::size_t l = 0; l < count; ++l) {
      if (!flags[l]) bad.push_back(number[l]);
    }
    count = 0;
  };
  each_at_loops(limb, [&](std::uint32_t triangle) {
    number[count] = triangle;
    const std::uint32_t* from = mesh_.index.wide.data() + std::size_t{3} * triangle;
    for (std::size_t k = 0; k < 3; ++k) corner[3 * count + k] = from[k];
    if (++count == Four::size) look();
  });
  if (count > 0) look();
}

/// A bad face is the fault of the openings that it touches. False: it touches none.
bool GraftWriter::blame(const std::uint32_t* corner, std::vector<Trust>& trust, bool is_late) const {
  bool touches = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t group = group_[corner[k]];
    if (group == none) continue;
    touches = true;
    Trust& child = trust[group_limb_[group / 2]];
    child = std::max(child, is_late ? Trust::closed : Trust::detached);
  }
  return touches;
}

/// join_loop_normals() of four pairs at once; false: one is for math::unit, and all are as they were.
SEEDMESH_WIDE bool GraftWriter::join_four(GroupNormal* normals) {
  const auto picked = [&](std::size_t i) {
    return Four::of_rows(normals[i].row, normals[i + 2].row, normals[i + 4].row, normals[i + 6].row);
  };
  Four one = picked(0), other = picked(1);
  if (!to_units(one) || !to_units(other)) return false;
  Four both = sum(one, other);
  if (!to_units(both)) return false;
  FourFloats rows[Four::size];
  both.to_rows(rows);
  for (std::size_t k = 0; k < Four::size; ++k) normals[2 * k].row = rows[k];
  return true;
}

/// The mean of both surfaces, whatever the size of their faces. From here on the even group has it.
void GraftWriter::join_loop_normals() {
  share_out(touched_.size(), pairs_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t pair = begin; pair < end; ++pair) {
      if (is_first() && pair + Four::size <= end && join_four(group_normal_.data() + 2 * pair)) {
        pair += Four::size - 1;
        continue;
      }
      if (!touched_[pair]) continue;
      const glm::vec3 one = math::quick_unit(group_normal_[2 * pair].get(), glm::vec3{0});
      const glm::vec3 other = math::quick_unit(group_normal_[2 * pair + 1].get(), glm::vec3{0});
      group_normal_[2 * pair].set(math::quick_unit(one + other, glm::vec3{0, 1, 0}));
    }
  });
}

void GraftWriter::put_loop_normals(std::size_t limb) {
  if (concern_[limb] == Concern::nothing) return;
  const Range& range = range_[limb];
  const std::uint32_t loop_end = range.begin.vertex + loops_[limb].count + 1;
  const std::size_t end = std::min(range.end.vertex, concern_[limb] == Concern::all ? none : loop_end);
  for (std::size_t i = range.begin.vertex; i < end; ++i) {
    if (group_[i] == none || !touched_[group_[i] / 2]) continue;
    mesh_.normal[i] = group_normal_[group_[i] & ~1U].get() + 0.0F;
    if (has_tangents()) lay_tangent(mesh_, i);
  }
}

/// Of all limbs, so many at once; what each gives goes to groups of its own.
GraftWriter::LoopFaces GraftWriter::sum_loop_normals(std::size_t chunk) {
  const std::size_t limbs = range_.size(), chunks = chunk_count(limbs, chunk);
  LoopFaces faces{Array<LoopFace>(job_), std::vector<std::span<const LoopFace>>(chunks)};
  std::vector<std::size_t> first(chunks + 1, 0);
  for (std::size_t i = 0; i < limbs; ++i)
    first[i / chunk + 1] += range_[i].end.loop_triangle - range_[i].begin.loop_triangle;
  std::partial_sum(first.begin(), first.end(), first.begin());
  faces.all.resize(first.back());
  const auto groups = static_cast<std::uint32_t>(group_normal_.size());
  std::fill_n(group_normal_.extend(FaceBlock::most * chunks), FaceBlock::most * chunks, GroupNormal{});
  share_out(limbs, chunk, [&](std::size_t begin, std::size_t end, std::size_t i) {
    LoopFace* const own = faces.all.data() + first[i];
    const LoopFace* const last =
        add_loop_normals(begin, end, groups + static_cast<std::uint32_t>(FaceBlock::most * i), own);
    faces.chunk[i] = {own, last};
  });
  group_normal_.resize(groups);
  return faces;
}

std::size_t GraftWriter::settle(std::vector<Trust>& trust, bool is_late) {
  mark_touched();
  const std::size_t count = range_.size(), chunk = limbs_a_chunk(count);
  find_concerned();
  for (std::size_t pair = 0; pair < touched_.size(); ++pair) {
    if (touched_[pair]) group_normal_[2 * pair] = group_normal_[2 * pair + 1] = {};
  }
  if (!group_limb_.empty()) {
    const LoopFaces faces = sum_loop_normals(chunk);
    join_loop_normals();
    ease_loop_normals(faces);
  }
  std::vector<std::vector<std::uint32_t>> bad(chunk_count(count, chunk));
  share_out(count, chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    job_.check();
    if (is_first()) {
      // They stand one behind another, and are looked at together unless one may be mended.
      for (std::size_t limb = begin; limb < end; ++limb) put_loop_normals(limb);
      look_at(range_[begin].begin.triangle, range_[end - 1].end.triangle, bad[index]);
      if (bad[index].empty() || !have_seams(begin, end)) return;
      bad[index].clear();
    }
    for (std::size_t limb = begin; limb < end; ++limb) {
      if (!is_first()) put_loop_normals(limb);
      const std::size_t before = bad[index].size();
      find_bad(limb, bad[index]);
      if (bad[index].size() == before || !has_seams(limb)) continue;
      bad[index].resize(before);
      settle_ribs(limb);
      find_bad(limb, bad[index]);
    }
  });
  return take_blame(bad, trust, is_late);
}

/// Lowers the trust in the limbs of these triangles, limb by limb; returns how many there are, but for those
/// that are creased.
std::size_t GraftWriter::take_blame(const std::vector<std::vector<std::uint32_t>>& bad,
                                    std::vector<Trust>& trust, bool is_late) {
  std::size_t faults = 0;
  for (std::size_t index = 0; index < bad.size(); ++index) {
    std::size_t limb = index * limbs_a_chunk(range_.size());
    // Triangles of a limb stand together, those of limbs that were written anew behind the others'.
    const auto is_of = [&](std::uint32_t triangle) {
      return triangle >= range_[limb].begin.triangle && triangle < range_[limb].end.triangle;
    };
    for (std::size_t i = 0; i < bad[index].size();) {
      while (!is_of(bad[index][i])) ++limb;
      bool is_bad = false;
      for (; i < bad[index].size() && is_of(bad[index][i]); ++i) {
        const std::uint32_t triangle = bad[index][i];
        if (can_be_creased(triangle, limb)) {
          creased_.push_back(triangle);
          continue;
        }
        ++faults;
        is_bad = !blame(mesh_.index.wide.data() + std::size_t{3} * triangle, trust, is_late) || is_bad;
      }
      if (is_bad) trust[limb] = trust[limb] < Trust::closed && !is_late ? Trust::closed : Trust::none;
    }
  }
  return faults;
}

}  // namespace seedmesh
