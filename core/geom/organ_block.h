#pragma once
/// Places of organs reckoned many at once: positions and normals, lane by lane the same bits as one by one.
#include <span>

#include "core/geom/organs.h"

namespace seedmesh {

/// One lane an organ.
constexpr std::size_t organ_lanes = 16;
struct OrganLanes3 {
  float x[organ_lanes], y[organ_lanes], z[organ_lanes];
  glm::vec3 at(std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

class OrganBlock {
 public:
  /// Surfaces of more vertices or corners, and those with tangents, are placed one by one.
  static constexpr std::size_t most_vertices = 96, most_corners = 512;
  static bool takes(const Mesh& surface) {
    return surface.position.size() <= most_vertices && surface.index.wide.size() <= most_corners &&
           surface.tangent.empty() && !surface.normal.empty();
  }

  OrganBlock(const Mesh& surface, const FoliageOptions& options) : surface_(surface), options_(options) {}

  /// The organs of one block, by their numbers in `organs`; 1..organ_lanes of them.
  /// False: one has a vector without a direction, and must be placed by itself as all must.
  bool reckon(const Array<Organ>& organs, std::span<const std::uint32_t> numbers);

  /// Writes the vertices of the first `count` lanes, one organ behind another.
  void write(std::size_t count, glm::vec3* position, glm::vec3* normal) const;

 private:
  const Mesh& surface_;
  const FoliageOptions& options_;
  OrganLanes3 place_, scale_;
  float quat_[4][organ_lanes];  ///< x y z w
  OrganLanes3 position_[most_vertices], normal_[most_vertices];
};

}  // namespace seedmesh
