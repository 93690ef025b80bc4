#pragma once
/// Organs to meshes: copies of small meshes for leaves, petals and fruits.
#include <optional>
#include <span>
#include <vector>

#include "core/geom/plant/foliage_shade.h"
#include "core/geom/plant/limbs.h"
#include "core/geom/plant/wind.h"
#include "core/model/model.h"

namespace seedmesh {

/// All organs of one surface and one colour index, as one mesh.
struct Foliage {
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  Mesh mesh;
};

/// The same as transforms of one mesh.
struct FoliageInstances {
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  std::vector<Transform> transforms;
};

struct FoliageOptions {
  /// By Organ::surface; borrowed. Each has positions, normals and wide indices, and may have uv[0], tangents
  /// and colours.
  std::span<const Mesh> surfaces;
  /// The diagonal of the whole model. Organs smaller than 1/5000 of it are left out: readers that weld
  /// vertices at 1e-6 of the diagonal would make points of their triangles.
  float model_size = 0;
  /// If set, normals are mixed with the direction away from this point, so that a crown is lit as one body.
  /// They stay on the side of their faces, since renderers turn the normals of back faces around.
  std::optional<glm::vec3> crown;
  float crown_share = 0.75F;
  /// With `crown`: for surfaces whose sides have vertices of their own. The normals of both sides turn to the light,
  /// as far as they stay on the side of their faces. The light comes from the mean of the directions straight up
  /// (weight 0.6) and away from `crown` (0.4). The directions away are those of an ellipsoid with these half axes.
  bool outward = false;
  glm::vec3 crown_axes{1};
  /// Organs differ in brightness by up to this share, by a hash of their key, as vertex colours; 0: no
  /// colours.
  float tint = 0;
  /// If not null, the vertex colours of surfaces without colours, instead of `tint`.
  const FoliageShade* shade = nullptr;
  /// For each joint of the limbs, what moves it: Mesh::bone gets that of Organ::limb_joint.
  std::span<const std::uint16_t> bones = {};
  /// If not null, wind weights are added (wind.h).
  const WindField* wind = nullptr;
  /// Add tangents along uv[0], which surfaces then have, as add_tangents() would.
  bool tangents = false;
};

/// Returns one Foliage for each surface and colour in use, both rising. Organs that coincide with an earlier one of
/// their surface, and organs without extent, are left out. A surface's tangents are transformed with it. Spends
/// Resource::triangles before it allocates. Runs on job.threads(); the result does not depend on their number. Cost:
/// 3 ns a vertex on one thread, divided by the number of threads; twice that with a crown.
std::vector<Foliage> place_organs(const Organs& organs, const FoliageOptions& options, Job& job);

/// Returns the same organs as transforms, for formats where nodes share a mesh.
std::vector<FoliageInstances> organ_transforms(const Organs& organs, const FoliageOptions& options, Job& job);

}  // namespace seedmesh
