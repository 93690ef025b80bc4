#pragma once
/// The plan of a city: the street graph and the partition of the area that is cut along it. Points are whole
/// centimetres, x east and y north; lengths and areas are metres unless a name says otherwise.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/network.h"
#include "core/geom/polygon/cm_point.h"
#include "core/geom/polygon/planar_graph.h"

namespace seedmesh::city {

/// The cross section of a class of streets.
struct CrossSection {
  std::string name;
  double width = 0;     ///< of the carriageway
  double sidewalk = 0;  ///< of each side
  int lanes = 0;
};

/// The planar graph of streets and of the border of the area. Edges are never removed ones.
struct StreetGraph {
  std::vector<CmPoint> nodes;
  std::vector<PlanarEdge> edges;  ///< the tag is an EdgeClass
  PlanarArms arms;
  std::vector<std::uint64_t> node_key, edge_key;  ///< identities by position
  std::vector<std::uint8_t> is_border;            ///< by node: on the border of the area

  bool is_street(std::uint32_t edge) const {
    return edges[edge].tag != static_cast<std::uint32_t>(EdgeClass::border);
  }
  std::uint32_t degree(std::uint32_t node) const {
    std::uint32_t count = 0;
    for (const std::uint32_t half : arms.of(node)) count += is_street(half / 2) ? 1U : 0U;
    return count;
  }
};

enum class PartKind : std::uint8_t { carriageway, junction, sidewalk, verge, park, square, lot };
const char* name_of(PartKind kind);

constexpr std::uint32_t no_index = 0xFFFFFFFFU;

/// A polygon of the partition: the outer ring counter-clockwise, then holes clockwise. Neighbours have the same
/// corners along their common borders.
struct Part {
  PartKind kind = PartKind::verge;
  std::uint32_t street = no_index, node = no_index, block = no_index;  ///< what it belongs to
  std::vector<CmRing> rings;
};

/// A house that stands on a lot.
struct House {
  std::uint32_t rule = 0;
  std::uint64_t seed = 0;
  int floors = 1;
  double width = 0, depth = 0;  ///< along and across the front, metres
  glm::dvec2 position{0};       ///< of its centre, metres east and north
  double turn = 0;              ///< degrees, counter-clockwise from above
};

struct Lot {
  std::uint64_t key = 0;
  std::uint32_t part = 0;  ///< into CityPlan::parts
  double area = 0, frontage = 0;
  std::uint32_t street = no_index;  ///< of its front: an edge of the graph
  bool is_corner = false;
  double density = 0;
  CmRing corners;  ///< without the corners of neighbours in between
  CmPoint front_start, front_end;
  std::optional<House> house;
};

struct Block {
  std::uint64_t key = 0;
  std::vector<CmRing> rings;
  std::vector<std::uint32_t> streets;  ///< edges around it, rising
};

/// Memory of a plan, which consists of many small lists, charged to the request by estimate.
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
    if (budget_) budget_->give_back(bytes_);
  }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_;
};

struct CityPlan {
  std::vector<CmRing> area;
  std::vector<CrossSection> classes;  ///< by EdgeClass
  StreetGraph graph;
  std::vector<Part> parts;
  std::vector<Block> blocks;
  std::vector<Lot> lots;
  std::vector<MemoryCharge> charges;

  const CrossSection& class_of(std::uint32_t edge) const { return classes[graph.edges[edge].tag]; }
};

/// The area of the rings in square metres; holes count negative.
double area_of(const std::vector<CmRing>& rings);

}  // namespace seedmesh::city
