#include "core/geom/lod/position_numbers.h"

#include <bit>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr std::size_t check_interval = 4'096;

std::size_t hash_of(const glm::vec3& at) {
  const std::uint64_t low =
      std::uint64_t{std::bit_cast<std::uint32_t>(at.x)} << 32U | std::bit_cast<std::uint32_t>(at.y);
  return mix(low ^ mix(std::bit_cast<std::uint32_t>(at.z)));
}

}  // namespace

PositionNumbers position_numbers(const Array<glm::vec3>& positions, const Job& job) {
  PositionNumbers out{Array<std::uint32_t>(job, positions.size()), Array<std::uint32_t>(job)};
  const std::size_t last_slot = std::bit_ceil(2 * positions.size() + 2) - 1;
  Array<std::uint32_t> table(job, last_slot + 1, none);
  std::size_t steps = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    std::size_t slot = hash_of(positions[v]) & last_slot;
    for (; table[slot] != none; slot = (slot + 1) & last_slot) {
      if (++steps % check_interval == 0) job.check();
      if (positions[out.first[table[slot]]] == positions[v]) break;
    }
    if (table[slot] == none) {
      table[slot] = static_cast<std::uint32_t>(out.first.size());
      out.first.push_back(static_cast<std::uint32_t>(v));
    }
    out.number[v] = table[slot];
  }
  return out;
}

}  // namespace seedmesh
