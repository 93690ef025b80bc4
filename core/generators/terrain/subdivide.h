#pragma once
/// Fields by recursive subdivision of a few heights: triangular-edge, diamond-square and square-square
/// (Fournier, Fussell and Carpenter 1982; Miller, "The definition and rendering of terrain maps", 1986;
/// Kogovšek 2014, section 5.2.2).
///
/// Every random deviation is a function of (seed, level, place in the world), so that one more round refines
/// the same field, any window can be made by itself, and two windows agree wherever they overlap.
#include <array>
#include <cstdint>
#include <optional>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// How the new heights of a square follow from its corners.
enum class SquareRule {
  diamond_square,     ///< centre: mean of 4; sides: mean of their ends and the two centres beside
  triangle_midpoint,  ///< centre: mean of the north-western and south-eastern corner; sides: of their ends
  triangle_random,    ///< nothing but chance, of the same size in every round
};

/// What diamond_square does on the border of the whole, or of a tile.
enum class BorderRule { two_neighbours, three, interpolate, wrap };

struct SquareSubdivision {
  SquareRule rule = SquareRule::diamond_square;
  BorderRule border = BorderRule::two_neighbours;
  int rounds = 0;
  double amplitude = 0;                               ///< greatest deviation of the first round
  double falloff = 1;                                 ///< of the deviation, from round to round
  std::optional<std::array<double, 4>> corners = {};  ///< nw, ne, sw, se; none: drawn, within the amplitude
};

/// Tile (0, 0) of the world is samples 0 .. 2^rounds in both directions. A bounded world is that tile alone,
/// and `window` must be all of it; an unbounded one goes on in all directions under the two_neighbours rule,
/// its corners drawn. Cost: about 3 ns a sample.
enum class World { bounded, unbounded };
Field subdivide(const SquareSubdivision& plan, World world, const Window& window, Rng rng, const Job& job);

struct NestedSubdivision {
  int rounds = 0;
  double amplitude = 0;
  double falloff = 1;
  std::optional<std::array<double, 9>> grid = {};  ///< row by row; none: drawn, within the amplitude
};

/// Square-square. Samples of the world are counted so that tile (0, 0) has 0 .. 2^rounds + 1. Of a start grid
/// of three by three; an unbounded world has start heights everywhere. Cost: about 1 ns a sample.
Field subdivide_nested(const NestedSubdivision& plan, const Window& window, Rng rng, const Job& job);

}  // namespace seedmesh::terrain
