#pragma once
/// Places of organs reckoned many at once: positions, normals and tangents, lane by lane the same bits as one
/// by one.
#include <span>

#include "core/geom/organ_tangents.h"
#include "core/geom/organs.h"

namespace seedmesh {

/// One lane an organ.
constexpr std::size_t organ_lanes = 16;
struct OrganLanes3 {
  float x[organ_lanes], y[organ_lanes], z[organ_lanes];
};
struct OrganLanes4 {
  OrganLanes3 xyz;
  float w[organ_lanes];
};

/// What normals that follow a crown have of a unit vector across each of their faces: those with less get as
/// much as is wanted.
constexpr float organ_least_over = 0.1F, organ_wanted_over = 0.15F;

class OrganBlock {
 public:
  /// Surfaces of more vertices or corners, and those with tangents, are placed one by one.
  static constexpr std::size_t most_vertices = 96, most_corners = 512;
  static bool takes(const Mesh& surface) {
    return surface.position.size() <= most_vertices && surface.index.wide.size() <= most_corners &&
           surface.tangent.empty() && !surface.normal.empty();
  }

  /// `sides`: of each vertex of the surface, or empty where no tangents are wanted; borrowed.
  OrganBlock(const Mesh& surface, const FoliageOptions& options, std::span<const PictureSides> sides)
      : surface_(surface), options_(options), sides_(sides) {}

  /// The organs of one block, by their numbers in `organs`; 1..organ_lanes of them.
  /// False: one has a vector without a direction, and must be placed by itself as all must.
  bool reckon(const Array<Organ>& organs, std::span<const std::uint32_t> numbers);

  /// Writes the vertices of the first `count` lanes, one organ behind another. `tangent`: null where none are
  /// wanted.
  void write(std::size_t count, glm::vec3* position, glm::vec3* normal, glm::vec4* tangent) const;

 private:
  void face_outward(std::uint32_t* faults);

  const Mesh& surface_;
  const FoliageOptions& options_;
  std::span<const PictureSides> sides_;
  OrganLanes3 place_, scale_;
  float quat_[4][organ_lanes];  ///< x y z w
  OrganLanes3 position_[most_vertices], normal_[most_vertices];
  OrganLanes4 tangent_[most_vertices];
};

}  // namespace seedmesh
