#include "core/generators/tree/roots.h"

#include <cmath>

namespace seedmesh::tree {
namespace {

constexpr int pieces = 8;
constexpr double tip_share = 0.08;

}  // namespace

void grow_roots(const TreeRoots& roots, const Chances& chances, std::uint32_t foot, SkeletonWriter& writer) {
  const double trunk = writer.radius(foot);
  for (int i = 0; i < roots.count; ++i) {
    const Rng rng = chances.trunk.at("root").at(static_cast<std::uint64_t>(i));
    const double length = roots.length * trunk * Rng(rng.at("length")).uniform(0.7, 1.0);
    double around = 360.0 * (i + Rng(rng.at("around")).uniform(-0.3, 0.3)) / roots.count;
    glm::dvec3 at{0};
    SkeletonWriter::Joint joint;
    joint.parent = foot;
    joint.order = 1;
    for (int k = 1; k <= pieces; ++k) {
      const double share = static_cast<double>(k) / pieces, before = static_cast<double>(k - 1) / pieces;
      around += spread(rng.at("turn").at(static_cast<std::uint64_t>(k)), 14);
      const math::SinCos heading = math::quick_sincos_degrees(around);
      at += glm::dvec3{heading.cos, 0, heading.sin} * (length / pieces);
      at.y = -roots.depth * length * share * share;
      const auto radius = [&](double s) {
        return trunk * roots.thickness * (1 - (1 - tip_share) * std::sqrt(s));
      };
      joint.position = at;
      joint.base_radius = radius(before);
      joint.radius = radius(share);
      joint.starts_limb = k == 1;
      joint.key = rng.at(static_cast<std::uint64_t>(k)).key();
      joint.parent = writer.add(joint);
    }
  }
}

}  // namespace seedmesh::tree
