#pragma once
/// Meshes of fields. +Y is up, the centre of the field is at the origin of X and Z, and heights are
/// unchanged. Texture coordinates are 0..1, with the north-west corner at (0, 0).
#include <functional>

#include "core/generators/terrain/field.h"
#include "core/generators/terrain/triangulation.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

/// The normals of a mesh.
enum class Shading {
  smooth,  ///< normals of the field, adjusted to face the front of all adjacent triangles
  upright  ///< all up, with tangents to the east; a normal map adds the slopes
};

/// Triangulates the samples of `part`: two triangles for each square, split along the diagonal with the
/// smaller height difference, in the order of a vertex cache of 16. Indices have 16 bits where possible.
/// `colors` is empty or has all samples. Spends triangles. Cost: about 10 ns for each sample.
Mesh grid_mesh(const Field& field, const Window& part, const Array<glm::u8vec4>& colors, Shading shading,
               Job& job);

/// Distance of the samples from which a coarse mesh takes its slopes.
struct CoarseShading {
  Shading shading = Shading::smooth;
  std::int32_t reach = 1;  ///< samples to either side
  Window part = {};        ///< window on whose border the reach is 1, so that neighbours agree
  bool ordered = false;    ///< triangles and samples are already in vertex cache order
};

/// Returns the colour of a sample by its index in the field; empty without colours.
using ColorOf = std::function<glm::u8vec4(std::uint32_t sample)>;

/// Returns a reduced mesh. Releases `color_of` after the last colour. Cost: about 50 ns for each triangle.
Mesh reduced_mesh(const Field& field, Triangulation plan, ColorOf color_of, const CoarseShading& coarse,
                  Job& job);

/// Turns normals upward until none faces away from a triangle of its vertex. The mesh must have 32-bit
/// indices.
void turn_normals_up(Mesh& mesh, const Job& job);

/// The lower ends of walls(). Walls are `depth` metres high. If `closed`, they end at the height `floor`
/// instead, and a floor closes the mesh.
struct WallPlan {
  double depth = 0;
  bool closed = false;
  float floor = 0;
};
/// Returns walls below the border that face outwards. `samples` are the border samples of the mesh, in any
/// order. Walls reach `depth` below each sample, or down to the level `floor` with a floor that closes the
/// mesh.
Mesh walls(const Field& field, const Array<std::uint32_t>& samples, const WallPlan& plan, Job& job);

/// Returns all samples of the border.
Array<std::uint32_t> border_samples(const Field& field, const Job& job);

/// Returns a flat sheet over the whole field.
Mesh sheet(const Field& field, float level, Job& job);

}  // namespace seedmesh::terrain
