// relax_normals() of junction_normals.h.
#include <bit>

#include "core/base/quick_math.h"
#include "core/geom/plant/graft/junction_normals.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = Limbs::none;
// A normal whose cosine to a face is below the first number is turned until it has the second one.
constexpr float least_lean = 0.03F, wanted_lean = 0.06F;
constexpr int most_turns = 24;

/// A set of numbers that are visited in rising order, again and again.
class WorkSet {
 public:
  explicit WorkSet(std::size_t count) : words_((count + 63) / 64, ~std::uint64_t{0}) {
    if (count % 64 != 0) words_.back() = (std::uint64_t{1} << count % 64) - 1;
  }
  void add(std::uint32_t number) { words_[number / 64] |= std::uint64_t{1} << number % 64; }

  /// Removes all numbers, by rising number, and calls each(number). A number that is added meanwhile is
  /// visited in this pass where it is greater than the current one, else in the next pass.
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

bool faces_away(const LoopFace& face, std::uint32_t group, std::span<const GroupNormal> normals) {
  return group != none && glm::dot(normals[group & ~1U].get(), face.normal) < least_lean;
}

/// The faces with a normal that faces away from one of its faces, in order.
std::vector<LoopFace> strained_faces(std::span<const LoopFace> faces, std::span<const GroupNormal> normals) {
  std::vector<std::uint8_t> is_strained;  // of each pair of groups
  for (const LoopFace& face : faces) {
    for (const std::uint32_t group : face.group) {
      if (!faces_away(face, group, normals)) continue;
      is_strained.resize(normals.size() / 2);
      is_strained[group / 2] = 1;
    }
  }
  std::vector<LoopFace> strained;
  if (is_strained.empty()) return strained;
  for (const LoopFace& face : faces) {
    bool any = false;
    for (const std::uint32_t group : face.group) any = any || (group != none && is_strained[group / 2]);
    if (any) strained.push_back(face);
  }
  return strained;
}

}  // namespace

void relax_normals(std::span<const LoopFace> all_faces, std::span<GroupNormal> normals) {
  const std::vector<LoopFace> faces = strained_faces(all_faces, normals);
  if (faces.empty()) return;
  // The faces at each pair of groups: at_pair[first[pair]] to at_pair[first[pair + 1] - 1].
  std::vector<std::uint32_t> first(normals.size() / 2 + 1, 0);
  const auto for_pairs = [&](const auto& each) {
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      for (const std::uint32_t group : faces[i].group) {
        if (group != none) each(first[group / 2], i);
      }
    }
  };
  for_pairs([](std::uint32_t& count, std::uint32_t) { ++count; });
  std::uint32_t sum = 0;
  for (std::uint32_t& each : first) each = sum += each;
  std::vector<std::uint32_t> at_pair(sum);
  for_pairs([&](std::uint32_t& end, std::uint32_t face) { at_pair[--end] = face; });

  // A face is visited again only after one of its normals has turned.
  WorkSet work(faces.size());
  bool turns = true;
  for (int turn = 0; turns && turn < most_turns; ++turn) {
    turns = false;
    work.take_all([&](std::uint32_t i) {
      const LoopFace& face = faces[i];
      for (const std::uint32_t group : face.group) {
        if (!faces_away(face, group, normals)) continue;
        const glm::vec3 normal = normals[group & ~1U].get();
        const float by = wanted_lean - glm::dot(normal, face.normal);
        normals[group & ~1U].set(math::quick_unit(normal + face.normal * by, normal));
        for (std::uint32_t k = first[group / 2]; k < first[group / 2 + 1]; ++k) work.add(at_pair[k]);
        turns = true;
      }
    });
  }
}

}  // namespace seedmesh
