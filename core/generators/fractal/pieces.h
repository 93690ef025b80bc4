#pragma once
/// Every copy whole: one mesh of some rounds, shown by as many nodes as the other rounds make of it.
#include <span>

#include "core/generators/fractal/element.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// How the rounds are shared between one mesh and its nodes, so that the file is smallest. Nodes are at most
/// 400, because each of them is drawn on its own.
struct Plan {
  int meshed = 0;              ///< rounds that are made into the mesh; the rest are nodes
  double pieces = 0;           ///< copies in all; beyond 2^53 the nearest double
  std::uint64_t elements = 0;  ///< triangles or lines stored
  std::uint64_t nodes = 0;
  std::uint64_t bytes = 0;  ///< of the GLB, about
};

double pieces_after(const Instructions& instructions, int rounds);

/// Refuses (Stop) what would pass the limit of triangles or bytes, and says what would not.
Plan plan_of(const Instructions& instructions, const Element& element, int rounds, const Job& job);

/// Adds the meshes and nodes of the fractal to `model`, below node `parent`, scaled by `size`. Materials of
/// the element stand at the front of the model's. Spends what is stored.
void add_pieces(Model& model, int parent, const Instructions& instructions, const Element& element,
                int rounds, double size, Job& job);

/// A copy of the mesh at each place, `edge` long. Spends what it makes.
Mesh scattered(const Mesh& element, std::span<const glm::vec3> places, double edge, Job& job);

}  // namespace seedmesh::fractal
