#include "core/geom/plant/organ_groups.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::size_t bits_an_organ = 16;  // there are fewer than 2^28
constexpr float least_share = 2e-4F;       // of the model's size
constexpr float least_extent = 1e-9F;

/// A set of hashes, with open addressing.
class HashSet {
 public:
  HashSet(std::size_t most, const Job& job) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    table_ = Array<std::uint64_t>(job, size, std::uint64_t{0});
  }
  /// Returns false where the hash was in the set before.
  bool insert(std::uint64_t hash) {
    hash += hash == 0 ? 1 : 0;
    std::size_t at = hash & (table_.size() - 1);
    for (; table_[at] != 0; at = (at + 1) & (table_.size() - 1)) {
      if (table_[at] == hash) return false;
    }
    table_[at] = hash;
    return true;
  }

 private:
  Array<std::uint64_t> table_;
};

std::uint64_t word_of(float a, float b) {
  std::uint32_t words[2];
  std::memcpy(words, &a, sizeof(a));
  std::memcpy(words + 1, &b, sizeof(b));
  return words[0] | std::uint64_t{words[1]} << 32U;
}

/// A hash of everything that places an organ.
std::uint64_t hash_of(const Organ& organ) {
  std::uint64_t hash = mix(word_of(organ.position.x, organ.position.y) + organ.surface);
  hash = mix(hash ^ word_of(organ.position.z, organ.frame.w));
  hash = mix(hash ^ word_of(organ.frame.x, organ.frame.y));
  hash = mix(hash ^ word_of(organ.frame.z, organ.scale.x));
  return mix(hash ^ word_of(organ.scale.y, organ.scale.z));
}

/// A Bloom filter of positions: finds the organs that may have the same position as another.
class SharedPositions {
 public:
  SharedPositions(const Organs& organs, const Job& job) : bit_(job, organs.organ.size()) {
    std::size_t size = 1024;
    while (size < bits_an_organ * organs.organ.size()) size *= 2;
    Array<std::uint64_t> taken(job, size / 64, std::uint64_t{0});
    shared_ = Array<std::uint64_t>(job, size / 64, std::uint64_t{0});
    for (std::size_t i = 0; i < bit_.size(); ++i) {
      const glm::vec3& at = organs.organ[i].position;
      const std::uint64_t bit = mix(word_of(at.x, at.y) ^ word_of(at.z, 0) << 7U) & (size - 1);
      bit_[i] = static_cast<std::uint32_t>(bit);
      const std::uint64_t flag = std::uint64_t{1} << bit % 64, met = taken[bit / 64] & flag;
      taken[bit / 64] |= flag;
      if (met == 0) continue;
      shared_[bit / 64] |= flag;
      ++met_;
    }
  }
  bool is_shared(std::size_t organ) const {
    return (shared_[bit_[organ] / 64] >> bit_[organ] % 64 & 1U) != 0;
  }
  /// An upper bound of the number of such organs.
  std::size_t most() const { return 2 * met_; }

 private:
  Array<std::uint32_t> bit_;  ///< of each organ
  Array<std::uint64_t> shared_;
  std::size_t met_ = 0;  ///< organs whose bit was set before
};

}  // namespace

std::vector<OrganGroup> organ_groups(const Organs& organs, const FoliageOptions& options, const Job& job) {
  std::map<std::pair<std::uint32_t, std::int16_t>, std::vector<std::uint32_t>> by_appearance;
  const SharedPositions shared(organs, job);
  HashSet seen(shared.most(), job);
  std::vector<float> extents;
  for (const Mesh& surface : options.surfaces) {
    const Box box = bounds_of(surface.position.span());
    const glm::vec3 extent = box.max - box.min;
    extents.push_back(std::max({extent.x, extent.y, extent.z}));
  }
  const float least = std::max(least_share * options.model_size, least_extent);
  const std::size_t count = organs.organ.size();
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  std::vector<std::uint32_t>* members = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const Organ& organ = organs.organ[i];
    const float smallest = std::min({organ.scale.x, organ.scale.y, organ.scale.z}) * extents[organ.surface];
    if (!(smallest > least)) continue;
    if (shared.is_shared(i) && !seen.insert(hash_of(organ))) continue;
    if (!members || surface != organ.surface || color != organ.color) {
      surface = organ.surface;
      color = organ.color;
      members = &by_appearance[{surface, color}];
      if (by_appearance.size() == 1) members->reserve(count);
    }
    members->push_back(i);
  }
  std::vector<OrganGroup> groups;
  for (auto& [key, list] : by_appearance) groups.push_back({key.first, key.second, std::move(list)});
  return groups;
}

}  // namespace seedmesh
