#include "core/generators/city/tunnel_clearance.h"

#include <algorithm>

namespace seedmesh::city {

using glm::dvec2;

TunnelClearance::TunnelClearance(const Landform* landform, const std::vector<SeparatedStreet>& bridges)
    : landform_(landform) {
  if (!landform) return;
  for (const SeparatedStreet& each : bridges) {
    if (each.level <= 0) tunnels_.push_back(&each);
  }
}

bool TunnelClearance::is_above(const dvec2& from, const dvec2& to) const {
  constexpr double beside = 1500, least_depth = 14;  // cm, m
  const auto ground = [&](const dvec2& cm) { return landform_->at(cm / 100.0); };
  for (const SeparatedStreet* tunnel : tunnels_) {
    const CmRing& line = tunnel->line;
    const double floor = std::max(ground(in_cm(line.front())), ground(in_cm(line.back())));
    if (std::min(ground(from), ground(to)) > floor + least_depth) continue;
    for (std::size_t k = 1; k < line.size(); ++k) {
      if (segments_meet(rounded_cm(from), rounded_cm(to), line[k - 1], line[k]) ||
          distance_to_segment(to, in_cm(line[k - 1]), in_cm(line[k])) < beside)
        return true;
    }
  }
  return false;
}

}  // namespace seedmesh::city
