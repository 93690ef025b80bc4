#pragma once
/// Fields as meshes. All have +Y up, the middle of the field at the origin of X and Z, heights as they are,
/// and texture coordinates 0..1 with the north-western corner at (0, 0).
#include <functional>

#include "core/generators/terrain/field.h"
#include "core/generators/terrain/triangulation.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

/// Which normals a mesh has.
enum class Shading {
  smooth,  ///< of the field, leaning back where one would look behind a triangle
  upright  ///< all straight up, with tangents to the east: a normal map says the rest
};

/// The samples of `part` as two triangles a square, cut along the diagonal that is closer to level; in an
/// order that a vertex cache of 16 likes; its indices have 16 bits where they can. `colors`: empty, or of all
/// samples. Spends triangles. About 10 ns a sample.
Mesh grid_mesh(const Field& field, const Window& part, const Array<glm::u8vec4>& colors, Shading shading,
               Job& job);

/// How far apart the samples are that a coarse mesh has its slopes from.
struct Coarse {
  Shading shading = Shading::smooth;
  std::int32_t reach = 1;  ///< samples to either side
  Window part = {};        ///< on whose border it is 1 nevertheless, so that neighbours look alike there
  bool ordered = false;    ///< the triangles are in an order that a vertex cache likes, samples by first use
};

/// The colour of a sample, by its number in the field; empty: there are none.
using ColorOf = std::function<glm::u8vec4(std::uint32_t sample)>;

/// A reduced mesh. Lets go of `color_of` as soon as all colours are there. About 50 ns a triangle.
Mesh reduced_mesh(const Field& field, Triangulation plan, ColorOf color_of, const Coarse& coarse, Job& job);

/// Walls down from the border, looking outwards. `samples` are those of the border that the mesh has, in any
/// order. `depth` below each sample, or down to the level `floor` with a floor below, which closes the mesh.
struct WallPlan {
  double depth = 0;
  bool closed = false;
  float floor = 0;
};
Mesh walls(const Field& field, const Array<std::uint32_t>& samples, const WallPlan& plan, Job& job);

/// All samples of the border.
Array<std::uint32_t> border_samples(const Field& field, const Job& job);

/// A flat sheet over the whole field.
Mesh sheet(const Field& field, float level, Job& job);

}  // namespace seedmesh::terrain
