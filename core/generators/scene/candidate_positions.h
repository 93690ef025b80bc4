#pragma once
/// Candidate positions on the ground, before any rule applies: by distance, at random, in rows, along paths.
/// A position is (x, z) in metres; x points east, z points south.
///
/// The position in the pattern determines the key of a placement, and the key determines all its random
/// values. These values therefore never depend on which other placements are kept.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "core/base/array.h"

namespace seedmesh::scene {

struct Extent {
  glm::dvec2 min{0}, max{0};
  glm::dvec2 size() const { return max - min; }
  bool contains(const glm::dvec2& p) const {
    return p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y;
  }
};

constexpr std::uint32_t no_position = 0xFFFFFFFFU;

/// A candidate position, and later the placement at it.
struct Placement {
  glm::dvec2 at{0};
  std::uint64_t key = 0;
  std::uint32_t position = no_position;  ///< index into the explicit positions of the layer
  float scale = 1;
  float turn = 0;  ///< radians, counter-clockwise seen from above
};

/// Returns the issue for a pattern with more positions than the limit on shapes. `what`: "a distance of 1 m
/// gives".
Issue shapes_issue(const std::string& what, double needed, const Job& job);

/// Returns positions in `part` of `whole` with a minimum distance of `distance`. The pattern is nearly
/// saturated: about 0.67 positions in a square of side `distance`. The distance is also kept after rounding of
/// coordinates to 32 bits.
///
/// The method is dart throwing: random candidates are tried in the cells of a grid, in three rounds. The
/// diagonal of a cell is the distance. Candidates are in the parts of a cell that no earlier position covers.
/// Cells that are processed together lie three apart and cannot conflict, so the result does not depend on
/// order or threads. Sources: Wei, "Parallel Poisson disk sampling", 2008, with its phase groups on the full
/// grid; White, Cline and Egbert, "Poisson disk point sets by hierarchical dart throwing", 2007. Throws Stop
/// where the number of positions exceeds the limit on shapes. Cost: about 0.4 microseconds for each position.
Array<Placement> poisson_disk(const Extent& whole, const Extent& part, double distance, Rng rng,
                              const Job& job);
/// Throws the Stop of poisson_disk() without computing positions. refuse_rows() and refuse_along() do the
/// same for in_rows() and along().
void refuse_poisson_disk(const Extent& whole, const Extent& part, double distance, const Job& job);

/// Elements first to first + count - 1 of an infinite series.
struct SeriesRange {
  std::uint64_t first = 0;
  std::size_t count = 0;
};

/// Returns uniformly distributed random positions.
Array<Placement> scattered(const Extent& part, SeriesRange range, Rng rng, const Job& job);

struct ClusterPlan {
  std::size_t clusters = 1;
  double radius = 1;
};
/// Returns positions around random cluster centres (Thomas 1949).
Array<Placement> clustered(const Extent& part, const ClusterPlan& plan, SeriesRange range, Rng rng,
                           const Job& job);

struct RowPlan {
  glm::dvec2 spacing{1};  ///< spacing along a row, and between rows, in metres
  double angle = 0;       ///< radians, counter-clockwise from east seen from above
  double stagger = 0;
  double jitter = 0;
};
/// Returns a grid through the centre of `part` that covers it.
Array<Placement> in_rows(const Extent& part, const RowPlan& plan, Rng rng, const Job& job);
void refuse_rows(const Extent& part, const RowPlan& plan, const Job& job);

struct PathPlan {
  double distance = 1;
  double offset = 0;
  bool left = true, right = true;  ///< with an offset of 0 the two sides coincide
  double jitter = 0;
};
/// Returns positions along the polyline `points`. Placements face along the line.
Array<Placement> along(std::span<const glm::dvec2> points, const PathPlan& plan, Rng rng, const Job& job);
void refuse_along(std::span<const glm::dvec2> points, const PathPlan& plan, const Job& job);

/// Keeps the placements whose mark is not 0, in their order.
void keep(Array<Placement>& placements, const Array<std::uint8_t>& marks);

/// Keeps `most` placements, chosen at random by their keys.
void thin_out(Array<Placement>& placements, std::size_t most, const Job& job);

}  // namespace seedmesh::scene
