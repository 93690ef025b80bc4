#pragma once
/// What can be told of a fractal without its mesh.
#include <cstdint>
#include <optional>

#include "core/generators/fractal/instructions.h"
#include "core/generators/fractal/lattice.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// Numbers beyond 2^53 are the nearest doubles. In the frame of the unit element.
struct Measure {
  double pieces = 0;
  std::optional<double> dimension;  ///< of self-similarity: the root of Moran's equation, sum of scale^D = 1
  std::optional<double> exposed_quads, surface_area, volume, genus, non_manifold_edges;
  std::optional<Box> bounds;
};

/// In closed form where there is one: maps of a lattice that stay inside their block, and named instructions
/// whose copies touch along edges at most. Otherwise lattices are counted cell by cell, as far as 2^27 cells;
/// genus and edges always are. Throws Stop for nothing but time and memory.
Measure measure(const FractalParams& params, const Instructions& instructions, int rounds, const Job& job);

/// Exposed squares of a lattice whose copies stay inside their block, in closed form; nullopt for others.
std::optional<double> exposed_quads(const Lattice& lattice, int rounds);

}  // namespace seedmesh::fractal
