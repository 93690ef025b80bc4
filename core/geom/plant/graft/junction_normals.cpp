#include "core/geom/plant/graft/junction_normals.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/wide.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
constexpr std::size_t least_limbs_a_chunk = 64, most_chunks = 128;
constexpr std::size_t pairs_a_chunk = 1024;

SEEDMESH_WIDE void measure_sides(FaceBlock& block, const glm::vec3* position,
                                 float (&along)[3][FaceBlock::most]) {
  for (std::size_t first = 0; first < FaceBlock::most; first += Vec3x4::size) {
    const std::uint32_t* corner = block.corner + 3 * first;
    const Vec3x4 p[3] = {Vec3x4::gather(position, corner), Vec3x4::gather(position, corner + 1),
                         Vec3x4::gather(position, corner + 2)};
    const Vec3x4 normal = cross(difference(p[1], p[0]), difference(p[2], p[0]));
    const Float4 size = root(dot(normal, normal));
    const Vec3x4 unit = scaled(normal, 1.0F / size);
    normal.to_rows(block.normal + first);
    unit.to_rows(block.unit + first);
    const Float4 columns[4] = {size, dot(difference(p[1], p[0]), difference(p[2], p[0])),
                               dot(difference(p[2], p[1]), difference(p[0], p[1])),
                               dot(difference(p[0], p[2]), difference(p[1], p[2]))};
    float* const out[4] = {block.size, along[0], along[1], along[2]};
    for (int k = 0; k < 4; ++k) std::memcpy(out[k] + first, &columns[k], sizeof(Float4));
  }
}

/// Angles at corners from the cross and the dot product of their sides, after M. Abramowitz and I. Stegun,
/// Handbook of Mathematical Functions, 1964, 4.4.47.
SEEDMESH_WIDE void measure_angles(FaceBlock& block, const float (&along)[3][FaceBlock::most]) {
  constexpr float pi = static_cast<float>(math::pi);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < FaceBlock::most; ++i) {
      const float opposite = block.size[i], adjacent = along[k][i], side = std::abs(adjacent);
      const bool is_steep = opposite > side;
      const float share = (is_steep ? side : opposite) / (is_steep ? opposite : side), z = share * share;
      const float angle =
          share * (0.999866F + z * (-0.3302995F + z * (0.180141F + z * (-0.085133F + z * 0.0208351F))));
      const float sharp = is_steep ? 0.5F * pi - angle : angle;
      block.weight[k][i] = (adjacent < 0 ? pi - sharp : sharp) / opposite;
    }
  }
}

/// Adds faces to the sums of their groups and lists them. One for each chunk of limbs.
class FaceSums {
 public:
  /// `unused`: the first of FaceBlock::most groups, to which corners without a changed group are added. Each
  /// face of a block has one of them, so that no addition waits for another.
  FaceSums(BarkBuffers& bark, const BarkRounds& rounds, std::uint32_t unused, LoopFace* faces)
      : bark_(bark), rounds_(rounds), unused_(unused), face_(faces) {}

  void add(std::uint32_t triangle) {
    std::copy_n(bark_.corners_of(triangle), 3, block_.corner + 3 * count_);
    if (++count_ == FaceBlock::most) flush();
  }

  /// Adds what is left and returns the end of the list.
  const LoopFace* finish() {
    if (count_ > 0) flush();
    return face_;
  }

 private:
  void flush() {
    for (std::size_t i = count_; i < FaceBlock::most; ++i)
      std::copy_n(block_.corner, 3, block_.corner + 3 * i);
    measure_faces(block_, bark_.mesh.position.data());
    const bool all = rounds_.is_first();
    GroupNormal* const sums = bark_.group_normal.data();
    for (std::size_t i = 0; i < count_; ++i) {
      if (!(block_.size[i] > 0)) continue;
      const Float4 normal = block_.normal[i];
      std::memcpy(static_cast<void*>(face_), &block_.unit[i], sizeof(Float4));  // the groups follow
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t group = bark_.group[block_.corner[3 * i + k]];
        if (!all && group != none && !rounds_.touched[group / 2]) group = none;
        face_->group[k] = group;
        // Selected without a branch, which would be mispredicted.
        GroupNormal& sum = sums[std::min(group, unused_ + static_cast<std::uint32_t>(i))];
        sum.row += normal * all_lanes(block_.weight[k][i]);
      }
      ++face_;
    }
    count_ = 0;
  }

  BarkBuffers& bark_;
  const BarkRounds& rounds_;
  std::uint32_t unused_;
  LoopFace* face_;
  FaceBlock block_;
  std::size_t count_ = 0;
};

/// Sums the faces at all changed loops, a chunk of limbs on each thread. Returns them in order.
Array<LoopFace> sum_faces(BarkBuffers& bark, const BarkRounds& rounds, const Job& job) {
  const std::size_t limbs = bark.range.size(), chunk = limbs_a_chunk(limbs),
                    chunks = chunk_count(limbs, chunk);
  std::vector<std::size_t> first(chunks + 1, 0), count(chunks, 0);
  for (std::size_t i = 0; i < limbs; ++i)
    first[i / chunk + 1] += bark.range[i].end.loop_triangle - bark.range[i].begin.loop_triangle;
  std::partial_sum(first.begin(), first.end(), first.begin());
  Array<LoopFace> faces(job, first.back());
  const auto groups = static_cast<std::uint32_t>(bark.group_normal.size());
  std::fill_n(bark.group_normal.extend(FaceBlock::most * chunks), FaceBlock::most * chunks, GroupNormal{});
  for_chunks(rounds, job, limbs, chunk, [&](std::size_t begin, std::size_t end, std::size_t i) {
    LoopFace* const own = faces.data() + first[i];
    FaceSums sums(bark, rounds, groups + static_cast<std::uint32_t>(FaceBlock::most * i), own);
    for (std::size_t limb = begin; limb < end; ++limb)
      for_loop_triangles(bark, rounds, limb, [&](std::uint32_t triangle) { sums.add(triangle); });
    count[i] = static_cast<std::size_t>(sums.finish() - own);
  });
  bark.group_normal.resize(groups);
  std::size_t end = 0;
  for (std::size_t i = 0; i < chunks; ++i) {
    if (end != first[i]) std::copy_n(faces.data() + first[i], count[i], faces.data() + end);
    end += count[i];
  }
  faces.resize(end);
  return faces;
}

}  // namespace

void measure_faces(FaceBlock& block, const glm::vec3* position) {
  float along[3][FaceBlock::most];
  measure_sides(block, position, along);
  measure_angles(block, along);
}

std::size_t limbs_a_chunk(std::size_t limbs) {
  return std::max(least_limbs_a_chunk, chunk_count(limbs, most_chunks));
}

void solve_junction_normals(BarkBuffers& bark, const BarkRounds& rounds, const Job& job) {
  const std::vector<std::uint8_t>& touched = rounds.touched;
  if (touched.empty()) return;
  GroupNormal* const normals = bark.group_normal.data();
  for (std::size_t pair = 0; pair < touched.size(); ++pair) {
    if (touched[pair]) normals[2 * pair] = normals[2 * pair + 1] = {};
  }
  const Array<LoopFace> faces = sum_faces(bark, rounds, job);
  GroupNormal* const sums = bark.group_normal.data();
  for_chunks(rounds, job, touched.size(), pairs_a_chunk,
             [&](std::size_t begin, std::size_t end, std::size_t) {
               for (std::size_t pair = begin; pair < end; ++pair) {
                 if (!touched[pair]) continue;
                 const glm::vec3 one = math::quick_unit(sums[2 * pair].get(), glm::vec3{0});
                 const glm::vec3 other = math::quick_unit(sums[2 * pair + 1].get(), glm::vec3{0});
                 sums[2 * pair].set(math::quick_unit(one + other, glm::vec3{0, 1, 0}));
               }
             });
  relax_normals(faces.span(), bark.group_normal.span());
}

void store_junction_normals(BarkBuffers& bark, const BarkRounds& rounds, std::size_t limb) {
  if (rounds.recheck[limb] == Recheck::nothing) return;
  const LimbRange& range = bark.range[limb];
  const std::uint32_t loop_end = range.begin.vertex + bark.loops[limb].count + 1;
  const std::uint32_t end =
      rounds.recheck[limb] == Recheck::all ? range.end.vertex : std::min(range.end.vertex, loop_end);
  for (std::size_t i = range.begin.vertex; i < end; ++i) {
    const std::uint32_t group = bark.group[i];
    if (group == none || !rounds.touched[group / 2]) continue;
    bark.mesh.normal[i] = bark.group_normal[group & ~1U].get() + 0.0F;
    if (bark.has_tangents) level_tangent(bark.mesh, i);
  }
}

}  // namespace seedmesh
