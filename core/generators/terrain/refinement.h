#pragma once
/// The division of the squares of a grid around a point.
///
/// Squares within the radius are halved until their sides are at most the step. With each doubling of the
/// distance, squares are halved once less, so that all triangles appear equally large. This is the principle
/// of a geometry clipmap (Losasso and Hoppe, "Geometry clipmaps", 2004). Where neighbours differ, the finer
/// one has no more vertices on the common edge than the coarser one.
#include <cstdint>

#include "core/base/job.h"
#include "core/generators/terrain/field.h"

namespace seedmesh {
struct TerrainRefine;
}

namespace seedmesh::terrain {

/// Positions are in metres to the east and south of the north-west sample.
struct Refinement {
  double east = 0, south = 0;  ///< position of the point
  double radius = 0, step = 1, relief = 1;
  double cell = 1;
  std::int32_t width = 0, depth = 0;  ///< samples of the field
  int halvings = 0;                   ///< number of halvings within the radius

  /// Distance beyond which nothing is divided.
  double reach() const;
  /// Returns how often a square is halved; 0 outside of the field.
  int level(std::int32_t i, std::int32_t j) const;
  /// Returns the window of squares outside of which all levels are 0.
  Window squares() const;
};

/// `width`, `depth` and `cell` are those of the field.
Refinement refinement_of(const TerrainRefine& given, std::int32_t width, std::int32_t depth, double cell);

/// Returns the number of triangles of the divided squares, less those of the same squares undivided. Stops counting
/// above `most`. Cost: about 5 ns for each square of the window.
std::uint64_t added_triangles(const Refinement& refinement, std::uint64_t most);

/// Refuses a point outside the field, a step that is not smaller than that of the grid, and more triangles
/// than the limit. `others` is the number of triangles of the grid, which count toward the limit.
void refuse_refinement(const Refinement& refinement, std::uint64_t others, const Job& job);

}  // namespace seedmesh::terrain
