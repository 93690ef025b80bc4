#pragma once
/// The plan of a city: the street graph and the partition of the area that is cut along it. Points are whole
/// centimetres, x east and y north; lengths are metres and areas square metres, unless a name states another unit.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/grades.h"
#include "core/generators/city/landform.h"
#include "core/generators/city/network.h"
#include "core/generators/city/region.h"
#include "core/geom/polygon/cm_point.h"
#include "core/geom/polygon/planar_graph.h"
#include "core/schema/child.h"

namespace seedmesh::city {

/// The cross section of a class of streets.
struct CrossSection {
  std::string name;
  double width = 0;                         ///< width of the carriageway
  std::array<double, 2> sidewalk = {0, 0};  ///< left and right
  int lanes = 0;
  double grade_limit = 0.12;                ///< rise over run
  std::optional<double> tree_spacing = {};  ///< 0: no trees; nullopt: that of the furniture
  /// Whether a wall stands on the right side of its streets, in place of the sidewalk.
  bool has_wall = false;
  friend bool operator==(const CrossSection&, const CrossSection&) = default;
};

/// A piece of street between two points; the kind is an EdgeClass, or the tag of a given street.
struct StreetPiece {
  CmPoint a, b;
  std::uint32_t kind = 0;
};

/// The line of a grade-separated street (SeparatedStreet), before its ends have become nodes.
struct SeparatedLine {
  CmRing line;
  std::uint32_t kind = 0;
  int level = 1;
};

/// A grade-separated street: a bridge (`level` above 0) or a tunnel (below 0). It is no part of the planar graph.
struct SeparatedStreet {
  std::uint32_t from = 0, to = 0;  ///< nodes
  std::uint32_t tag = 0;
  int level = 1;
  CmRing line;
  std::uint64_t key = 0;
};

/// The planar graph of streets and of the border of the area. It contains no removed edges (PlanarEdge::is_removed).
struct StreetGraph {
  std::vector<CmPoint> nodes;
  std::vector<PlanarEdge> edges;  ///< the tag is an EdgeClass, or from first_given on that of a given street
  PlanarArms arms;
  std::vector<std::uint64_t> node_key, edge_key;  ///< keys that follow from positions alone
  std::vector<std::uint8_t> is_border;  ///< 1 on the border of the area or on a shore, indexed by node
  std::vector<SeparatedStreet> separated;
  std::vector<CmPoint> ring_nodes;  ///< nodes of roundabouts, sorted
  bool has_branches = false;        ///< at least one minor street could have branches at its end
  std::vector<std::uint32_t>
      separated_ends;  ///< number of ends of `separated` at each node; empty if there are none

  bool is_street(std::uint32_t edge) const { return is_street_tag(edges[edge].tag); }
  /// Whether a node is on the border of the area itself.
  bool is_at_area_border(std::uint32_t node) const {
    for (const std::uint32_t half : arms.of(node)) {
      if (edges[half / 2].tag == static_cast<std::uint32_t>(EdgeClass::border)) return true;
    }
    return false;
  }
  bool is_on_ring(std::uint32_t node) const {
    return std::binary_search(ring_nodes.begin(), ring_nodes.end(), nodes[node]);
  }
  /// Returns the number of ends of streets of all levels at a node.
  std::uint32_t street_ends(std::uint32_t node) const {
    return degree(node) + (separated_ends.empty() ? 0 : separated_ends[node]);
  }
  /// Returns the number of ends of streets of level 0 at a node.
  std::uint32_t degree(std::uint32_t node) const {
    std::uint32_t count = 0;
    for (const std::uint32_t half : arms.of(node)) count += is_street(half / 2) ? 1U : 0U;
    return count;
  }
};

enum class PartKind : std::uint8_t { carriageway, junction, sidewalk, verge, park, square, lot, water };
const char* name_of(PartKind kind);

constexpr std::uint32_t no_index = 0xFFFFFFFFU;

/// A polygon of the partition: the outer ring counter-clockwise, then holes clockwise. Neighbours have the same
/// corners along their common borders.
struct Part {
  PartKind kind = PartKind::verge;
  /// The street, node or block that it belongs to.
  std::uint32_t street = no_index, node = no_index, block = no_index;
  std::vector<CmRing> rings;
  bool is_wall = false;  ///< a verge that a town wall fills
};

/// Whether a part is a carriageway, a junction, a sidewalk, or a town wall in place of a sidewalk.
inline bool is_street_space(const Part& part) {
  return part.kind == PartKind::carriageway || part.kind == PartKind::junction ||
         part.kind == PartKind::sidewalk || part.is_wall;
}

/// A quarter of a town of wards. Its outline runs along the middle of the streets around it.
struct Ward {
  CmRing ring;
  std::string zone;
};
/// Zones without minor streets. The square has no lots, and the citadel is one lot.
constexpr const char *zone_square = "square", *zone_citadel = "citadel";

/// A zone of the request: the area where its map is 0.5 or more.
struct NamedZone {
  std::string name;
  FieldMap map;
};

/// The rectangle below a building.
struct Footing {
  glm::dvec2 position{0};       ///< position of its centre, metres east and north
  double turn = 0;              ///< degrees, counter-clockwise from above
  double width = 0, depth = 0;  ///< sides along and across the front, metres
  std::uint32_t part = 0;       ///< index into CityPlan::parts
};

/// A model at a given position.
struct Landmark {
  Child request;  ///< request with its seed
  std::string pointer;
  glm::dvec2 position{0};  ///< metres east and north
  double turn = 0;         ///< degrees, counter-clockwise from above
  double radius = 15;      ///< metres around `position` in which no tree of a park stands
  bool is_block_whole = false, is_on_square = false, replaces_house = true;
  bool is_given = false;      ///< a footprint of the request
  bool is_too_large = false;  ///< whether it is too large for its lot, which then has no building in the plan
  /// Indices of the lot and of the part below it; no_index: none.
  std::uint32_t lot = no_index, part = no_index;
};

/// A house that stands on a lot.
struct House {
  std::uint32_t rule = 0;
  std::uint64_t seed = 0;
  int floors = 1;
  double width = 0, depth = 0;  ///< sides along and across the front, metres
  glm::dvec2 position{0};       ///< position of its centre, metres east and north
  double turn = 0;              ///< degrees, counter-clockwise from above
};

struct Lot {
  std::uint64_t key = 0;
  std::uint32_t part = 0;  ///< index into CityPlan::parts
  double area = 0, frontage = 0;
  std::uint32_t street = no_index;  ///< street of its front: an edge of the graph
  bool is_corner = false, is_inner = false;
  double density = 0;
  std::string zone;  ///< empty without zones
  CmRing corners;    ///< its corners without those that neighbours add
  CmPoint front_start, front_end;
  std::optional<House> house;
  std::uint32_t landmark = no_index;  ///< index into CityPlan::landmarks; such lots have no house

  bool is_built() const { return house.has_value() || landmark != no_index; }
  /// Returns the rectangle of the house. The lot must have a house.
  Footing footing() const { return {house->position, house->turn, house->width, house->depth, part}; }
};

struct Block {
  std::uint64_t key = 0;
  std::vector<CmRing> rings;
  std::vector<std::uint32_t> streets;  ///< edges around it, rising
};

/// Charges the estimated memory of a plan, which consists of many small lists, to the budget of the request, as long
/// as this object exists.
class MemoryCharge {
 public:
  MemoryCharge(const Job& job, std::uint64_t bytes) : budget_(job.budget()), bytes_(bytes) {
    budget_->take(bytes);
  }
  MemoryCharge(MemoryCharge&& other) noexcept
      : budget_(std::move(other.budget_)), bytes_(std::exchange(other.bytes_, 0)) {}
  MemoryCharge& operator=(MemoryCharge&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  MemoryCharge(const MemoryCharge&) = delete;
  MemoryCharge& operator=(const MemoryCharge&) = delete;
  ~MemoryCharge() {
    if (budget_) budget_->release(bytes_);
  }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_;
};

struct CityPlan {
  std::vector<CmRing> area;
  Region region;                      ///< the same, divided into land and water
  std::vector<CrossSection> classes;  ///< cross sections by EdgeClass, then those of given streets
  std::vector<Ward> wards;            ///< empty unless the method is wards
  std::vector<CmPoint> gates;         ///< nodes where streets pass a town wall
  std::vector<NamedZone> zones;
  std::vector<Landmark> landmarks;
  StreetGraph graph;
  /// For each edge, the start and end of its straight kerbs, first the left and then the right one. Both points are
  /// equal where there is no straight kerb.
  std::vector<std::array<CmPoint, 4>> kerbs;
  /// For each half-edge, the distance in metres that the corners at its start reach along it.
  std::vector<double> corner_reaches;
  std::shared_ptr<const Landform> landform;  ///< never null after plan_of()
  StreetHeights heights;
  std::vector<Part> parts;
  std::vector<Block> blocks;
  std::vector<Lot> lots;
  std::vector<MemoryCharge> charges;

  const CrossSection& class_of(std::uint32_t edge) const { return classes[graph.edges[edge].tag]; }
};

/// Returns the area of the rings in square metres; holes count negative.
double area_of(const std::vector<CmRing>& rings);

}  // namespace seedmesh::city
