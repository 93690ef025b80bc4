#pragma once
/// KHR_mesh_quantization (Kapoulkine, Khronos registry 2020): attributes of 16 bits, with or without the filters
/// that compress() needs.
#include <vector>

#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// The possible positions of a mesh: origin + step * (0..65535) along each axis. `step` is a power of two and
/// `origin` a multiple of it, so that meshes with equal steps share their grid points.
struct Grid {
  glm::vec3 origin{0};
  float step = 1;
  bool is_exact = false;  ///< positions stay floats; origin is then 0 and step 1
};

struct GridOptions {
  /// In metres: steps are chosen for an extent of at least this, so that tiles of one world share them.
  float least_extent = 0;
  /// Meshes with copies get exact grids, so that the translation of a copy is the position of its origin.
  bool keeps_copies = false;
};

/// Returns one grid for each mesh; meshes that one node or one skin shows get equal grids.
std::vector<Grid> grids_of(const Model& model, const GridOptions& options = {});

/// Computes grids_of() and writes the inverse of the quantization into the model. It changes the transforms
/// of nodes and copies, and the matrices of skins. Where a node has children or is animated, it adds a child
/// node ("trunk_mesh") for the mesh instead.
std::vector<Grid> apply_grids(Model& model, const GridOptions& options = {});

/// `filtered`: for EXT_meshopt_compression, whose readers decode two of the attributes. `plain`: for
/// KHR_mesh_quantization alone.
enum class Encoding { filtered, plain };

/// Quantizes the columns of a part to 16 bits. Filtered: normals and tangents octahedral with 10 bits for each
/// axis, texture coordinates outside 0..1 exponential with steps of 2^-14. Plain: normals and tangents with 16
/// bits for each axis, texture coordinates outside 0..1 as floats. Joins vertices that have become equal, and
/// drops triangles that have become flat. The part may have no triangles afterwards. Where the grid is too coarse
/// to keep the surface closed, positions stay floats in units of the grid's step. Linear time.
void quantize(Part& part, const Grid& grid, Job& job, Encoding encoding = Encoding::filtered);

/// Quantizes all parts that are not packed yet, and drops parts without triangles. `grids`: one for each
/// mesh.
void quantize(Columns& columns, const std::vector<Grid>& grids, Job& job,
              Encoding encoding = Encoding::filtered);

}  // namespace seedmesh::gltf
