#pragma once
/// Places on the ground before any rule is asked: by distance, by chance, in rows, along paths. East is x,
/// south is z; a place is (x, z) in metres.
///
/// Every place has a key of its own from where it lies in its pattern, from which all that is drawn for it
/// follows. So nothing that is drawn for one place depends on which others are kept.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/base/array.h"

namespace seedmesh::scene {

struct Extent {
  glm::dvec2 min{0}, max{0};
  glm::dvec2 size() const { return max - min; }
  bool holds(const glm::dvec2& p) const {
    return p.x >= min.x && p.y >= min.y && p.x <= max.x && p.y <= max.y;
  }
};

constexpr std::uint32_t no_position = 0xFFFFFFFFU;

/// One place, and later what stands there.
struct Stand {
  glm::dvec2 at{0};
  std::uint64_t key = 0;
  std::uint32_t position = no_position;  ///< which of the explicit positions it is
  float scale = 1;
  float turn = 0;  ///< radians, counter-clockwise seen from above
};

/// Places in `part` of `whole`, no two nearer than `distance`, so dense that hardly one more would fit
/// (about 0.65 of them on a square of that side). Coordinates may be rounded to 32 bit and still keep the
/// distance.
///
/// Darts are thrown at the cells of a grid whose diagonal is the distance, one dart a cell and round, cells
/// three apart at once: these never bear on each other, so that neither order nor threads matter (after
/// Wei, "Parallel Poisson disk sampling", 2008, whose phase groups these are; on the full grid alone).
/// Throws Stop where there would be more places than the limit on shapes. Below 1 microsecond a place.
Array<Stand> poisson_disk(const Extent& whole, const Extent& part, double distance, Rng rng, const Job& job);
/// Its refusal alone, as of the two patterns below.
void refuse_poisson_disk(const Extent& whole, const Extent& part, double distance, const Job& job);

/// Places first .. first + count - 1 of an endless series.
struct Stretch {
  std::uint64_t first = 0;
  std::size_t count = 0;
};

/// Places by chance.
Array<Stand> scattered(const Extent& part, Stretch stretch, Rng rng, const Job& job);

struct ClusterPlan {
  std::size_t clusters = 1;
  double radius = 1;
};
/// Places round the middles of clusters, which lie by chance (Thomas 1949).
Array<Stand> clustered(const Extent& part, const ClusterPlan& plan, Stretch stretch, Rng rng, const Job& job);

struct RowPlan {
  glm::dvec2 spacing{1};  ///< along a row, and from row to row
  double angle = 0;       ///< radians, counter-clockwise from east seen from above
  double stagger = 0;
  double jitter = 0;
};
/// A grid through the middle of `part` that covers it.
Array<Stand> in_rows(const Extent& part, const RowPlan& plan, Rng rng, const Job& job);
void refuse_rows(const Extent& part, const RowPlan& plan, const Job& job);

struct WayPlan {
  double distance = 1;
  double offset = 0;
  bool left = true, right = true;  ///< with an offset of 0 both are one
  double jitter = 0;
};
/// Along a line through `points`. Stands look along it.
Array<Stand> along(std::span<const glm::dvec2> points, const WayPlan& plan, Rng rng, const Job& job);
void refuse_along(std::span<const glm::dvec2> points, const WayPlan& plan, const Job& job);

/// Those whose mark is not 0 stay, in their order.
void keep(Array<Stand>& stands, const Array<std::uint8_t>& marks);

/// Of more than `most` stands those with the lowest numbers stay, which are by chance.
void thin_out(Array<Stand>& stands, std::size_t most, const Job& job);

}  // namespace seedmesh::scene
