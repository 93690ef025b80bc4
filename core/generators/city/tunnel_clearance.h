#pragma once
/// Keeps minor streets off ground that is low above a tunnel.
#include <glm/vec2.hpp>
#include <vector>

#include "core/generators/city/landform.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

class TunnelClearance {
 public:
  /// Keeps references to the landform and the bridges. On level ground (null) there are no tunnels to keep off.
  TunnelClearance(const Landform* landform, const std::vector<SeparatedStreet>& bridges);

  const std::vector<const SeparatedStreet*>& tunnels() const { return tunnels_; }

  /// Whether a street between two positions (cm) would pass a tunnel that is not deep below the ground there.
  bool is_above(const glm::dvec2& from, const glm::dvec2& to) const;

 private:
  const Landform* landform_;
  std::vector<const SeparatedStreet*> tunnels_;
};

}  // namespace seedmesh::city
