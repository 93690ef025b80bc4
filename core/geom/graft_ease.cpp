#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/quick_math.h"
#include "core/base/wide.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// Normals of loops that come nearer than this to the plane of a face, or behind it, are turned toward it by a
// little more, again and again.
constexpr float least_lean = 0.03F, wanted_lean = 0.06F;
constexpr int most_turns = 24;

/// Numbers that wait to be looked at, in turn.
class Waiting {
 public:
  explicit Waiting(std::size_t count) : words_((count + 63) / 64, ~std::uint64_t{0}) {
    if (count % 64 != 0) words_.back() = (std::uint64_t{1} << count % 64) - 1;
  }
  void add(std::uint32_t number) { words_[number / 64] |= std::uint64_t{1} << number % 64; }

  /// Calls each(number) for all by rising number, which wait no more then. Those that are added meanwhile
  /// come in this turn where they are greater, else in the next.
  template <class Each>
  void take_all(const Each& each) {
    for (std::size_t word = 0; word < words_.size(); ++word) {
      std::uint64_t greater = ~std::uint64_t{0};
      while (const std::uint64_t here = words_[word] & greater) {
        const std::uint64_t bit = here & (~here + 1);
        greater = ~(bit | (bit - 1));
        words_[word] &= ~bit;
        each(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(bit)));
      }
    }
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace

std::pair<GraftWriter::Seams::const_iterator, GraftWriter::Seams::const_iterator> GraftWriter::seams_of(
    std::size_t limb) const {
  const auto at = [&](std::uint32_t vertex) {
    return std::lower_bound(rib_seams_.begin(), rib_seams_.end(), std::pair{vertex, std::uint32_t{0}});
  };
  return {at(range_[limb].begin.vertex), at(range_[limb].end.vertex)};
}

/// The formula knows the normals of ribs; where rings of few corners cut deep ones, or a flare, their faces
/// look elsewhere. Such a limb gets the mean of its faces, turned as the normals of loops are.
void GraftWriter::settle_ribs(std::size_t limb) {
  const Range& range = range_[limb];
  const std::uint32_t first = range.begin.vertex;
  std::vector<std::uint32_t> same(range.end.vertex - first);
  std::iota(same.begin(), same.end(), 0U);
  const auto [seam, last_seam] = seams_of(limb);
  for (auto each = seam; each != last_seam; ++each) {
    if (each->second - first < same.size()) same[each->second - first] = each->first - first;
  }
  struct Face {
    glm::vec3 normal;
    std::uint32_t corner[3];
  };
  std::vector<Face> faces;
  std::vector<glm::vec3> sum(same.size(), glm::vec3(0));
  for (std::uint32_t t = range.begin.triangle; t < range.end.triangle; ++t) {
    const std::uint32_t* corner = mesh_.index.wide.data() + std::size_t{3} * t;
    glm::vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh_.position[corner[k]];
    Face face{math::quick_unit(glm::cross(p[1] - p[0], p[2] - p[0]), glm::vec3{0}), {}};
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 one = math::quick_unit(p[(k + 1) % 3] - p[k], glm::vec3{0}),
                      other = math::quick_unit(p[(k + 2) % 3] - p[k], glm::vec3{0});
      const glm::vec3 across = glm::cross(one, other);
      const double angle = math::quick_atan2(static_cast<double>(std::sqrt(glm::dot(across, across))),
                                             static_cast<double>(glm::dot(one, other)));
      const bool is_free = group_[corner[k]] == none && corner[k] - first < same.size();
      face.corner[k] = is_free ? same[corner[k] - first] : none;
      if (is_free) sum[face.corner[k]] += face.normal * static_cast<float>(angle);
    }
    faces.push_back(face);
  }
  for (glm::vec3& normal : sum) normal = math::quick_unit(normal, glm::vec3{0, 1, 0});
  bool turns = true;
  for (int turn = 0; turns && turn < most_turns; ++turn) {
    turns = false;
    for (const Face& face : faces) {
      for (const std::uint32_t corner : face.corner) {
        if (corner == none) continue;
        const float over = glm::dot(sum[corner], face.normal);
        if (over >= least_lean) continue;
        sum[corner] = math::quick_unit(sum[corner] + face.normal * (wanted_lean - over), sum[corner]);
        turns = true;
      }
    }
  }
  for (std::size_t i = 0; i < same.size(); ++i) {
    if (group_[first + i] != none) continue;
    mesh_.normal[first + i] = sum[same[i]] + 0.0F;
    if (has_tangents()) lay_tangent(mesh_, first + i);
  }
}

bool GraftWriter::looks_away(const LoopFace& face, std::uint32_t group) const {
  return group != none && glm::dot(group_normal_[group & ~1U].get(), face.normal) < least_lean;
}

/// Of four faces those that have a normal which looks away from them. `normals` of groups, of which `neutral`
/// is none and that of corners without a group.
FourFlags GraftWriter::strained(const LoopFace* faces, const GroupNormal* normals, std::uint32_t neutral) {
  const Four face = Four::of_rows(Four::row(&faces[0].normal), Four::row(&faces[1].normal),
                                  Four::row(&faces[2].normal), Four::row(&faces[3].normal));
  FourFlags away{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto normal = [&](const LoopFace& each) {
      return normals[std::min(each.group[k], neutral) & ~1U].row;
    };
    away |= dot(Four::of_rows(normal(faces[0]), normal(faces[1]), normal(faces[2]), normal(faces[3])), face) <
            least_lean;
  }
  return away;
}

/// The first of four of `faces`, from `from` on, that are not all at ease; fewer than four are left at the
/// end. `normals` with two more than there are groups: none.
SEEDMESH_WIDE std::size_t GraftWriter::first_strained(std::span<const LoopFace> faces,
                                                      std::span<const GroupNormal> normals,
                                                      std::size_t from) {
  const auto neutral = static_cast<std::uint32_t>(normals.size() - 2);
  while (from + Four::size <= faces.size() && all_of(~strained(faces.data() + from, normals.data(), neutral)))
    from += Four::size;
  return from;
}

/// The faces that have a normal which looks away from one of its faces.
std::vector<GraftWriter::LoopFace> GraftWriter::strained_faces(const LoopFaces& faces) {
  const std::size_t parts = faces.chunk.size();
  // Corners without a group get a normal that does not look away from anything.
  const std::size_t groups = group_normal_.size();
  std::fill_n(group_normal_.extend(2), 2, GroupNormal{four_times(std::numeric_limits<float>::quiet_NaN())});
  const std::span<const GroupNormal> normals = std::as_const(group_normal_).span();
  std::vector<std::vector<std::uint32_t>> away(parts);
  share_out(parts, 1, [&](std::size_t, std::size_t, std::size_t part) {
    const std::span<const LoopFace> all = faces.chunk[part];
    for (std::size_t at = 0; at < all.size();) {
      at = first_strained(all, normals, at);
      for (const std::size_t end = std::min(all.size(), at + Four::size); at < end; ++at) {
        for (const std::uint32_t group : all[at].group) {
          if (looks_away(all[at], group)) away[part].push_back(group / 2);
        }
      }
    }
  });
  group_normal_.resize(groups);
  std::vector<LoopFace> hard;
  if (std::all_of(away.begin(), away.end(), [](const auto& pairs) { return pairs.empty(); })) return hard;
  std::vector<std::uint8_t> strained(touched_.size() + 1, 0);  // the last for corners without a group
  for (const std::vector<std::uint32_t>& pairs : away) {
    for (const std::uint32_t pair : pairs) strained[pair] = 1;
  }
  const auto strain = [&](std::uint32_t group) {
    return strained[std::min<std::size_t>(group / 2, strained.size() - 1)];
  };
  std::vector<std::vector<LoopFace>> found(parts);
  share_out(parts, 1, [&](std::size_t, std::size_t, std::size_t part) {
    for (const LoopFace& face : faces.chunk[part]) {
      if ((strain(face.group[0]) | strain(face.group[1]) | strain(face.group[2])) != 0)
        found[part].push_back(face);
    }
  });
  std::size_t count = 0;
  for (const std::vector<LoopFace>& part : found) count += part.size();
  hard.reserve(count);
  for (const std::vector<LoopFace>& part : found) hard.insert(hard.end(), part.begin(), part.end());
  return hard;
}

/// Where a limb leaves at a narrow angle, the mean of both surfaces may look away from one of their faces;
/// the normal gives way, so that the limb need not.
void GraftWriter::ease_loop_normals(const LoopFaces& faces) {
  const std::vector<LoopFace> hard = strained_faces(faces);
  if (hard.empty()) return;
  // The faces at each pair of groups: from first[pair] to first[pair + 1].
  std::vector<std::uint32_t> first(touched_.size() + 1, 0);
  const auto for_pairs = [&](const auto& each) {
    for (std::uint32_t i = 0; i < hard.size(); ++i) {
      for (const std::uint32_t group : hard[i].group) {
        if (group != none) each(first[group / 2], i);
      }
    }
  };
  for_pairs([](std::uint32_t& count, std::uint32_t) { ++count; });
  std::uint32_t sum = 0;
  for (std::uint32_t& each : first) each = sum += each;
  std::vector<std::uint32_t> at_pair(sum);
  for_pairs([&](std::uint32_t& place, std::uint32_t face) { at_pair[--place] = face; });

  // A face is looked at again only if one of its normals has turned since it was.
  Waiting waiting(hard.size());
  bool turns = true;
  for (int turn = 0; turns && turn < most_turns; ++turn) {
    turns = false;
    waiting.take_all([&](std::uint32_t i) {
      const LoopFace& face = hard[i];
      for (const std::uint32_t group : face.group) {
        if (!looks_away(face, group)) continue;
        const glm::vec3 normal = group_normal_[group & ~1U].get();
        const float wanted = wanted_lean - glm::dot(normal, face.normal);
        group_normal_[group & ~1U].set(math::quick_unit(normal + face.normal * wanted, normal));
        for (std::uint32_t k = first[group / 2]; k < first[group / 2 + 1]; ++k) waiting.add(at_pair[k]);
        turns = true;
      }
    });
  }
}

}  // namespace seedmesh
