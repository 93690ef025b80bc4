#pragma once
/// Fields by recursive subdivision of a few heights: triangular-edge, diamond-square and square-square
/// (Fournier, Fussell and Carpenter 1982; Miller, "The definition and rendering of terrain maps", 1986;
/// Kogovšek 2014, section 5.2.2).
///
/// Every random deviation is a function of (seed, level, position in the world). Therefore one more round
/// refines the same field, each window can be generated separately, and overlapping windows agree.
#include <array>
#include <optional>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// How the new heights of a square follow from its corners.
enum class SquareRule {
  diamond_square,     ///< centre: mean of 4; sides: mean of their ends and the two adjacent centres
  triangle_midpoint,  ///< centre: mean of the north-west and south-east corner; sides: of their ends
  triangle_random,    ///< random heights of the same range in every round
};

/// How diamond_square treats the border of the world or of a tile.
enum class BorderRule { two_neighbours, three, interpolate, wrap };

struct SquareSubdivision {
  SquareRule rule = SquareRule::diamond_square;
  BorderRule border = BorderRule::two_neighbours;
  int rounds = 0;
  double amplitude = 0;  ///< largest deviation of the first round, in metres
  double falloff = 1;    ///< factor of the deviation from round to round
  /// nw, ne, sw, se; absent: random, within the amplitude
  std::optional<std::array<double, 4>> corners = {};
};

/// Whether the world ends at the border of tile (0, 0) or continues in all directions.
enum class World { bounded, unbounded };
/// Returns the field of `window`. Tile (0, 0) of the world has samples 0 .. 2^rounds in both directions. A
/// bounded world is this tile alone, and `window` must cover it. An unbounded world continues in all
/// directions with the rule two_neighbours and random corners. Cost: about 3 ns for each sample.
Field subdivide(const SquareSubdivision& plan, World world, const Window& window, Rng rng, const Job& job);

struct NestedSubdivision {
  int rounds = 0;
  double amplitude = 0;
  double falloff = 1;
  std::optional<std::array<double, 9>> grid = {};  ///< row by row; absent: random, within the amplitude
};

/// Returns the field of `window` by square-square subdivision of a start grid of three by three heights. Tile
/// (0, 0) has samples 0 .. 2^rounds + 1. An unbounded world has start heights everywhere. Cost: about 1 ns
/// for each sample.
Field subdivide_nested(const NestedSubdivision& plan, const Window& window, Rng rng, const Job& job);

}  // namespace seedmesh::terrain
