#pragma once
/// Figures of a fractal without its mesh.
#include <optional>

#include "core/generators/fractal/instructions.h"
#include "core/generators/fractal/lattice.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// The figures, in the frame of the unit element. Numbers above 2^53 are the nearest doubles.
struct Measure {
  double pieces = 0;
  std::optional<double> points;  ///< number of pieces that are replaced by points
  std::optional<double>
      dimension;  ///< similarity dimension: the solution of Moran's equation, sum of scale^D = 1
  std::optional<double> exposed_quads, surface_area, volume, genus, non_manifold_edges;
  std::optional<double> length;  ///< length of all segments, or of the outline of a plate
  std::optional<double> area;    ///< area of one side of a plate, or inside the snowflake, or below the curve
  std::optional<Box> bounds;
};

/// Uses closed forms for maps of a lattice that stay inside their block, and for named instructions whose
/// copies touch at most along edges. Cells of other lattices are counted, up to 2^27 cells; so are genus and
/// edges of all lattices. Throws Stop only for the deadline, a cancellation and the limit of memory.
Measure measure(const FractalParams& params, const Instructions& instructions, int rounds, const Job& job);

/// Returns the figures if pieces are divided down to FractalParams::smallest. Their areas, lengths and bounds have no
/// closed form. Throws Stop if there are too many (count_divided).
Measure measure_divided(const FractalParams& params, const Instructions& instructions, int rounds, Job& job);

/// Returns the number of exposed squares in closed form; nullopt if copies leave their block.
std::optional<double> exposed_quads(const Lattice& lattice, int rounds);

}  // namespace seedmesh::fractal
