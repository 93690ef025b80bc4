#include "core/generators/city/dead_ends.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/math.h"
#include "core/generators/city/vectors.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

std::uint64_t point_key(const CmPoint& p) {
  return key_at(key_at(0xCE11, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

/// Joins a loose end to a road ahead of it or beside it.
bool join(Network& network, const GrowthInput& input, const TunnelClearance& tunnels, std::uint32_t node) {
  const double reach = input.streets.length * 150;  // cm
  const NetworkEdge edge = network.edges()[network.arms(node)[0]];
  const CmPoint before = network.nodes()[edge.from == node ? edge.to : edge.from];
  const dvec2 from = in_cm(network.nodes()[node]), back = from - in_cm(before);
  const dvec2 ahead = back / std::sqrt(back.x * back.x + back.y * back.y);
  for (const double turn : {0.0, 20.0, -20.0, 40.0, -40.0, 65.0, -65.0, 90.0, -90.0}) {
    const dvec2 direction = rotated(ahead, turn), far = from + direction * reach;
    if (tunnels.is_above(from, far) || (input.footprints && input.is_blocked(from, far, 1e9))) continue;
    if (network.build_to_road(node, direction, reach, EdgeClass::minor).state == PieceState::joined)
      return true;
  }
  return false;
}

/// Removes a street back to its last junction.
void remove_from(Network& network, std::uint32_t node) {
  while (network.arms(node).size() == 1) {
    const std::uint32_t arm = network.arms(node)[0];
    const NetworkEdge edge = network.edges()[arm];
    if (edge.kind != EdgeClass::minor) return;
    network.remove_edge(arm);
    node = edge.from == node ? edge.to : edge.from;
  }
}

}  // namespace

void settle_dead_ends(Network& network, const GrowthInput& input, const TunnelClearance& tunnels,
                      const Rng& rng) {
  std::vector<std::uint32_t> order(network.nodes().size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return network.nodes()[a] != network.nodes()[b] ? network.nodes()[a] < network.nodes()[b] : a < b;
  });
  for (const std::uint32_t n : order) {
    if (network.arms(n).size() != 1 || network.edges()[network.arms(n)[0]].kind != EdgeClass::minor) continue;
    Rng draw = rng.at(point_key(network.nodes()[n]));
    if (draw.unit() < input.streets.dead_ends) continue;
    if (!join(network, input, tunnels, n)) remove_from(network, n);
  }
}

}  // namespace seedmesh::city
