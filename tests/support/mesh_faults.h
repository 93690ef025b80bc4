#pragma once
/// Hygiene of a mesh in words: what a strict reader would refuse or pay for. Tests expect no word at all.
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Counts over one mesh of the answer: all its primitives, welded together by position at a millionth of
/// their diagonal.
struct MeshMeasures {
  std::uint64_t triangles = 0, vertices = 0;
  std::uint64_t not_finite = 0;       ///< floats that are NaN or infinite
  std::uint64_t negative_zeros = 0;   ///< floats that are -0
  std::uint64_t bad_indices = 0;      ///< beyond the vertices
  std::uint64_t zero_area = 0;        ///< triangles below 1e-12 of the primitive's squared diagonal
  std::uint64_t flipped_corners = 0;  ///< whose normal looks to the other side than their triangle
  std::uint64_t not_unit = 0;         ///< normals off unit length by more than 0.001
  std::uint64_t unused = 0;           ///< vertices that no triangle or line names
  std::uint64_t duplicates = 0;       ///< vertices equal to an earlier one in every attribute
  std::uint64_t duplicate_faces = 0;
  std::uint64_t over_used_edges = 0;     ///< in more than two triangles
  std::uint64_t inconsistent_edges = 0;  ///< in two triangles that run along them the same way
  std::uint64_t open_edges = 0;          ///< in one triangle; no fault, but a closed tube has none
  std::uint64_t wide_indices = 0;        ///< primitives whose indices could be of 16 bit but are not
  double cache_misses_a_vertex = 0;      ///< with a first-in-first-out cache of 16 entries
  double area = 0, volume = 0;  ///< volume by signed tetrahedra: positive for closed meshes turned outside
};
MeshMeasures measure(const std::vector<const Mesh*>& primitives);

/// A sentence for each fault. Neither open edges nor indices of 32 bit (finish() narrows them) are faults of
/// a Mesh.
std::vector<std::string> faults(const Mesh& mesh);

/// The same for every mesh of the model, with its name, and for all references between the parts of the
/// model.
std::vector<std::string> faults(const Model& model);

}  // namespace seedmesh
