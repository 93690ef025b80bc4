#pragma once
/// KHR_mesh_quantization (Kapoulkine, Khronos registry 2020): attributes in 16 bits, ready for compress().
#include <vector>

#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Where the positions of a mesh may lie: origin + step * (0..65535) along each axis. `step` is a power of
/// two and `origin` a multiple of it, so that meshes with one step have the same points.
struct Grid {
  glm::vec3 origin{0};
  float step = 1;
};

/// A grid for each mesh of the model, the same for all that one node or one skin shows.
std::vector<Grid> grids_of(const Model& model);

/// Turns the columns of one part to 16 bits, as below; no triangle may be left of it.
void quantize(Part& part, const Grid& grid, Job& job);

/// The same grids as grids_of(). Moves them into the
/// model: into the transforms of nodes and copies, into the matrices of skins, or into a new child
/// ("trunk_mesh") of a node that has children or is animated.
std::vector<Grid> lay_grids(Model& model);

/// Turns the columns to 16 bits, with the filters of EXT_meshopt_compression: normals and tangents
/// octahedral with 10 bits an axis, texture coordinates outside 0..1 exponential with steps of 2^-14.
/// Vertices that became equal are joined, triangles whose corners became one point or one line go, and so do
/// parts without any triangle left. Where a grid is so coarse for a part that its surface cannot be kept
/// closed, as in a wood that is one mesh, positions stay floats, counted in steps of the grid. Parts that are
/// packed are so already. Linear time.
void quantize(Columns& columns, const std::vector<Grid>& grids, Job& job);

}  // namespace seedmesh::gltf
