#pragma once
/// Leaves -> Mesh: one small shape set on every organ of a plant, as one mesh.
#include <span>
#include <vector>

#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// A leaf in its own frame: attached at the origin, 1 long along +y, 1 wide across x (from -0.5 to 0.5), its
/// upper side toward +z. uv (0,0) is the top left of a picture of it, tip up.
struct LeafTemplate {
  std::vector<glm::vec3> position, normal;
  std::vector<glm::vec2> uv;
  std::vector<std::uint32_t> index;
};

enum class LeafForm {
  kite,    ///< two triangles folded along the midrib
  blade,   ///< eight triangles: ovate, folded and bent
  twig,    ///< nine kites, alternately to both sides of an axis that is not drawn
  needle,  ///< twelve narrow triangles round the axis: a shoot of a conifer
  card,    ///< a square in the plane, for pictures with alpha
  cross,   ///< two squares that cross at right angles
};
LeafTemplate leaf_template(LeafForm form);

struct FoliageOptions {
  double density = 1;  ///< share of the leaves that are drawn; these are larger, so that the area is kept
  float size = 1;      ///< factor of every leaf
  float crown = 0;     ///< 0: normals of the leaves, 1: away from the middle of the crown; between: mixed
  float tint = 0;      ///< leaves differ in brightness by up to this share, as vertex colours; 0: no colours
};

/// Scales, turns and places the shape: Organ::scale is width, length and depth. Normals are of unit length.
/// Spends Resource::triangles before it allocates. Runs on job.threads(), with one result.
Mesh foliage(std::span<const Organ> leaves, const LeafTemplate& shape, const FoliageOptions& options,
             Job& job);

}  // namespace seedmesh
