#include "core/generators/tree/grown_vigour.h"

#include <algorithm>

namespace seedmesh::tree {
namespace {

/// A side branch, a side bud or the bud at the end of an axis.
struct Claim {
  std::uint32_t axis = 0;  ///< axis on which it is
  std::uint32_t index = 0;
  bool is_bud = false;
  double mean = 0;  ///< light by internode
  double light = 0;
};

/// The claims of all axes, those of one axis together and the brightest first.
Array<Claim> ranked_claims(const GrownPlant& plant, Job& job) {
  Array<Claim> claims(job);
  for (std::uint32_t i = 0; i < plant.nodes.size(); ++i) {
    const GrownNode& node = plant.nodes[i];
    if (node.parent == Limbs::none || node.continues) continue;
    claims.push_back({plant.nodes[node.parent].axis, i, false, node.light / node.count, node.light});
  }
  for (std::uint32_t i = 0; i < plant.buds.size(); ++i) {
    const GrownBud& bud = plant.buds[i];
    claims.push_back({plant.nodes[bud.node].axis, i, true, bud.light, bud.light});
  }
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) {
    if (a.axis != b.axis) return a.axis < b.axis;
    if (a.mean != b.mean) return a.mean > b.mean;
    if (a.is_bud != b.is_bud) return a.is_bud;
    return a.index < b.index;
  });
  return claims;
}

double weight_of(std::size_t rank, std::size_t count, const TreeGrown& grown) {
  const double share = count < 2 ? 0 : static_cast<double>(rank) / static_cast<double>(count - 1);
  const double fallen = std::min(1.0, share / grown.priority_share);
  return 1 + (grown.priority_least - 1) * fallen;
}

}  // namespace

void gather_light(GrownPlant& plant, int first_young) {
  for (GrownNode& node : plant.nodes) {
    node.main_light = node.side_light = 0;
    node.count = 1;
    node.young = node.born >= first_young ? 1 : 0;
  }
  for (const GrownBud& bud : plant.buds) {
    GrownNode& node = plant.nodes[bud.node];
    (bud.ends_axis ? node.main_light : node.side_light) += bud.light;
  }
  for (std::size_t i = plant.nodes.size(); i-- > 0;) {
    GrownNode& node = plant.nodes[i];
    node.light = node.main_light + node.side_light;
    if (node.parent == Limbs::none) continue;
    GrownNode& parent = plant.nodes[node.parent];
    (node.continues ? parent.main_light : parent.side_light) += node.light;
    parent.count += node.count;
    parent.young += node.young;
  }
}

double lambda_in(const TreeGrown& grown, double year) {
  const double from = grown.lambda_years[0], until = std::max(from, grown.lambda_years[1]);
  if (year <= from) return grown.lambda;
  if (year >= until) return grown.lambda_old;
  return grown.lambda + (grown.lambda_old - grown.lambda) * (year - from) / (until - from);
}

void divide_by_lambda(GrownPlant& plant, double alpha, double lambda) {
  const auto share = [&](const GrownNode& node, bool is_main, double light) {
    const double main = lambda * node.main_light, side = (1 - lambda) * node.side_light;
    if (!(main + side > 0)) return 0.0;
    return node.vigour * (is_main ? lambda : 1 - lambda) * light / (main + side);
  };
  for (GrownNode& node : plant.nodes) {
    node.vigour = node.parent == Limbs::none ? alpha * node.light
                                             : share(plant.nodes[node.parent], node.continues, node.light);
  }
  for (GrownBud& bud : plant.buds) bud.vigour = share(plant.nodes[bud.node], bud.ends_axis, bud.light);
}

void divide_by_priority(GrownPlant& plant, const TreeGrown& grown, Job& job) {
  Array<Claim> claims = ranked_claims(plant, job);
  // Axes are numbered in the order in which they begin, so an axis has its vigour before its claims are met.
  Array<double> vigour(job, plant.axes, 0.0);
  for (GrownNode& node : plant.nodes) {
    if (node.parent == Limbs::none) vigour[node.axis] = grown.alpha * node.light;
  }
  for (std::size_t first = 0; first < claims.size();) {
    std::size_t last = first;
    double sum = 0;
    while (last < claims.size() && claims[last].axis == claims[first].axis) ++last;
    for (std::size_t i = first; i < last; ++i) {
      claims[i].light *= weight_of(i - first, last - first, grown);
      sum += claims[i].light;
    }
    const double of_axis = vigour[claims[first].axis];
    for (std::size_t i = first; i < last; ++i) {
      const Claim& claim = claims[i];
      const double own = sum > 0 ? of_axis * claim.light / sum : 0;
      if (claim.is_bud) {
        plant.buds[claim.index].vigour = own;
      } else {
        vigour[plant.nodes[claim.index].axis] = own;
      }
    }
    first = last;
  }
  for (GrownNode& node : plant.nodes) node.vigour = vigour[node.axis];
}

}  // namespace seedmesh::tree
