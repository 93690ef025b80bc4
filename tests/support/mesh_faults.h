#pragma once
/// Checks of mesh quality: defects that a strict reader rejects or that cost performance.
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Counts over one mesh of the output: all its primitives, welded by position with a tolerance of one
/// millionth of the diagonal of their bounding box.
struct MeshMeasures {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint64_t not_finite = 0;       ///< floats that are NaN or infinite
  std::uint64_t negative_zeros = 0;   ///< floats that are -0
  std::uint64_t bad_indices = 0;      ///< indices that are not below the number of vertices
  std::uint64_t zero_area = 0;        ///< triangles below 1e-12 of the primitive's squared diagonal
  std::uint64_t flipped_corners = 0;  ///< corners whose normal faces away from the normal of their triangle
  std::uint64_t not_unit = 0;         ///< normals whose length differs from 1 by more than 0.001
  std::uint64_t unused = 0;           ///< vertices without a triangle or line
  std::uint64_t duplicates = 0;       ///< vertices equal to an earlier one in every attribute
  std::uint64_t duplicate_faces = 0;
  std::uint64_t over_used_edges = 0;     ///< edges of more than two triangles
  std::uint64_t inconsistent_edges = 0;  ///< edges that two triangles traverse in the same direction
  std::uint64_t open_edges = 0;          ///< edges of one triangle; no defect, but closed tubes have none
  std::uint64_t wide_indices = 0;        ///< primitives with 32-bit indices that would fit into 16 bits
  double cache_misses_a_vertex = 0;      ///< for a FIFO cache of 16 entries
  double area = 0, volume = 0;           ///< volume by signed tetrahedra: positive for outward normals
};
MeshMeasures measure(const std::vector<const Mesh*>& primitives);

/// Returns one sentence per defect. Open edges and 32-bit indices are not defects of a Mesh, because finish()
/// narrows the indices later.
std::vector<std::string> faults(const Mesh& mesh);

/// Checks every mesh of the model, with its name in the sentence, and all references between the parts of the
/// model.
std::vector<std::string> faults(const Model& model);

}  // namespace seedmesh
