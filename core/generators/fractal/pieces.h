#pragma once
/// Complete copies: a mesh contains the copies of some rounds, and nodes repeat it for the other rounds.
#include <span>

#include "core/generators/fractal/element.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// How the rounds are divided between the mesh and its nodes so that the file is smallest. There are at most
/// 400 nodes, because each is a draw call.
struct Plan {
  int meshed = 0;              ///< rounds in the mesh; the other rounds are nodes
  double pieces = 0;           ///< number of all copies; above 2^53 the nearest double
  std::uint64_t elements = 0;  ///< triangles or lines stored
  std::uint64_t nodes = 0;
  std::uint64_t bytes = 0;  ///< of the GLB, approximately
};

double pieces_after(const Instructions& instructions, int rounds);

/// Throws Stop if the limit of triangles would be exceeded. The message says which number of rounds is
/// possible.
Plan plan_of(const Instructions& instructions, const Element& element, int rounds, const Job& job);

/// Adds the meshes and nodes of the fractal below node `parent`, scaled by `size`. The first materials of the
/// model must be those of the element. Charges Resource::triangles.
void add_pieces(Model& model, int parent, const Instructions& instructions, const Element& element,
                int rounds, double size, Job& job);

/// Copies that are divided only while their frame is at least `smallest` wide; smaller ones become points.
struct Division {
  int rounds = 0;       ///< at most this number of rounds
  double size = 1;      ///< edge of the unit element
  double smallest = 0;  ///< in the unit of `size`
};
struct DividedCount {
  std::uint64_t elements = 0, points = 0;
};

/// Visits all copies, so it costs about as much as making them. Throws Stop if copies and points exceed the
/// limit of triangles.
DividedCount count_divided(const Instructions& instructions, const Element& element, const Division& division,
                           const Job& job);

/// Adds the remaining copies as meshes, and a mesh of points, in nodes below `parent`. Charges
/// Resource::triangles.
void add_divided(Model& model, int parent, const Instructions& instructions, const Element& element,
                 const Division& division, Job& job);

/// A copy of the mesh, scaled by `edge`, at each position. Spends the triangles.
Mesh scattered(const Mesh& element, std::span<const glm::vec3> positions, double edge, Job& job);

}  // namespace seedmesh::fractal
