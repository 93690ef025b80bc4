#pragma once
/// Makes the copies of a fractal. A mesh contains the copies of the first rounds (iterations). Nodes repeat
/// the mesh for the other rounds.
#include <span>

#include "core/generators/fractal/element.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// The division of rounds into mesh and nodes that gives the smallest file. Nodes need similarity maps, no arrangement
/// and no kept originals (Instructions::keeps). There are at most 400 nodes, because each is a draw call.
struct Plan {
  int meshed = 0;              ///< rounds in the mesh; the other rounds are nodes
  double pieces = 0;           ///< number of all copies; above 2^53 the nearest double
  std::uint64_t elements = 0;  ///< triangles or lines stored
  std::uint64_t nodes = 0;
  std::uint64_t bytes = 0;  ///< bytes of the GLB, approximately
};

/// Returns the number of copies after this number of rounds.
double pieces_after(const Instructions& instructions, int rounds);

/// Throws Stop if the limit of triangles would be exceeded. The message gives the largest number of rounds within the
/// limit.
Plan plan_of(const Instructions& instructions, const Element& element, int rounds, const Job& job);

/// The copies that add_pieces() makes.
struct Copies {
  int rounds = 0;
  double size = 1;  ///< length of one unit of the element, in metres
};

/// Adds the meshes and nodes of the fractal below node `parent`. The first materials of the model must be those of the
/// element. Spends Resource::triangles.
void add_pieces(Model& model, int parent, const Instructions& instructions, const Element& element,
                const Copies& copies, Job& job);

/// Copies are divided while the largest stretch of their map times `size` is at least `smallest`. Smaller copies become
/// points.
struct Division {
  int rounds = 0;       ///< largest number of rounds
  double size = 1;      ///< edge of the unit element
  double smallest = 0;  ///< least size of copies that are divided, in the unit of `size`
};
struct DividedCount {
  std::uint64_t elements = 0, points = 0;
};

/// Visits all copies, so it costs about as much as making them. Throws Stop if triangles, lines and points together
/// exceed the limit of triangles.
DividedCount count_divided(const Instructions& instructions, const Element& element, const Division& division,
                           const Job& job);

/// Adds the copies of count_divided() as meshes and the points as one mesh, in nodes below `parent`. Spends
/// Resource::triangles.
void add_divided(Model& model, int parent, const Instructions& instructions, const Element& element,
                 const Division& division, Job& job);

/// Returns a copy of the mesh, scaled by `edge`, at each position. Spends Resource::triangles.
Mesh scattered(const Mesh& element, std::span<const glm::vec3> positions, double edge, Job& job);

}  // namespace seedmesh::fractal
