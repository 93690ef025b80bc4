#pragma once
/// The area of a city, divided into land and water.
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/rings.h"
#include "core/geom/polygon/planar_graph.h"

namespace seedmesh::city {

/// An edge between land and water, or at the border of the area.
struct OutlineEdge {
  CmPoint a, b;
  bool is_shore = false;
};

struct Region {
  std::vector<CmRing> rings;                        ///< rings of the land, which is to the left of each edge
  std::vector<std::vector<std::uint8_t>> is_shore;  ///< 1 on shores, indexed by ring and edge
  std::vector<OutlineEdge> outline;                 ///< outline of land and water
};

/// Returns the region of an area without water.
Region region_of(const std::vector<CmRing>& area);

/// Cuts polygons of water out of an area: the outer ring counter-clockwise, then holes clockwise. Water and islands
/// below 100 square metres are left out.
Region region_of(const std::vector<CmRing>& area, const std::vector<Rings>& water, Job& job);

/// Returns a position in centimetres just inside of a face: 1.5 cm to the left of the middle of the longest edge of
/// its loop.
glm::dvec2 position_in(const std::vector<CmPoint>& nodes, const std::vector<PlanarEdge>& edges,
                       std::span<const std::uint32_t> loop);

/// Whether a position in centimetres is on land.
bool is_on_land(const Region& region, const glm::dvec2& cm);

/// Returns the number of the outer ring around the part of the land in which a position in centimetres lies. Water
/// separates the parts. Returns nullopt in water and outside of the area.
std::optional<std::size_t> part_of_land(const Region& region, const glm::dvec2& cm);

/// A quantity at a position in metres.
using ValueAt = std::function<double(const glm::dvec2&)>;

/// Returns the polygon where a value is at least 0.5, within the box [low, high] in metres. The method is marching
/// squares on a lattice of at most 300 squares a side. Corners are moved along the lattice to the border, and rings
/// are simplified with a tolerance of 1 m.
Rings contour_of(const ValueAt& value, const glm::dvec2& low, const glm::dvec2& high, Job& job);

}  // namespace seedmesh::city
