#pragma once
/// Objects that stand in a city as copies of shared models: furniture along the streets, trees, landmarks. The
/// front of an object faces local +z, as that of a building.
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/plan.h"
#include "core/schema/child.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

struct CityObject {
  glm::dvec2 position{0};  ///< metres east and north
  double turn = 0;         ///< degrees, counter-clockwise from above
  double scale = 1;
  std::uint32_t model = 0;  ///< index into the models of its kind
  std::uint32_t part = 0;   ///< index of the part of the plan on which it stands
};

/// All objects of one kind. Without requests, it has the built-in models of its name (furniture_models.h).
struct ObjectKind {
  std::string name;
  std::string pointer;            ///< pointer of its requests
  std::span<const Child> models;  ///< models that the request gives
  std::vector<CityObject> objects;

  std::uint32_t model_count() const;
};

/// Whether a request has furniture or trees along streets.
bool has_street_furniture(const CityParams& params);

/// Returns the lamps, trees, benches, bins, signs and parked cars along all streets of level 0 that the request
/// selects. Choices depend on the key of the street, its side, and the number of the position, counted from the end
/// with the smaller key. Cost: linear in the lengths of the streets.
std::vector<ObjectKind> street_furniture(const CityPlan& plan, const CityParams& params, const Job& job);

/// Returns the trees in parks and yards. Choices depend on the key of the block or the lot.
std::vector<ObjectKind> trees_of(const CityPlan& plan, const CityParams& params, const Job& job);

/// A piece of a hedge or fence, metres.
struct BorderPiece {
  glm::dvec2 a{0}, b{0};
  std::uint32_t part = 0;          ///< index of the part of one of its lots
  std::uint32_t other = no_index;  ///< that of the other lot; no_index: none
};

/// Returns the borders between neighbouring lots of which one has a building, without the parts that pass within
/// 0.4 m of a building. Each border occurs once. Cost: n log n in the edges of lots.
std::vector<BorderPiece> lot_borders(const CityPlan& plan, const Job& job);

/// Returns what is open of the fronts of lots beside their buildings, 0.3 m behind the line of the building's front.
/// Pieces below 0.2 m are left out. Cost: linear in the corners of lots.
std::vector<BorderPiece> front_borders(const CityPlan& plan, const Job& job);

/// Shortens the borders of fronts that end in a border between lots, so that they end beside it. Both have `half_width`
/// metres to either side of their lines. Cost: n log n in the pieces.
void end_beside(std::vector<BorderPiece>& fronts, const std::vector<BorderPiece>& between, double half_width);

/// Returns the borders along the other streets of lots with buildings: beside and behind the border of the front,
/// without the parts that pass within 0.4 m of the building. They stand inside of the lot, with `half_width` metres to
/// either side. Pieces below 0.3 m are left out. Cost: n log n in the corners of streets and lots.
std::vector<BorderPiece> side_street_borders(const CityPlan& plan, double half_width, const Job& job);

/// Returns the distance from a position to a ring, metres.
double distance_to_ring(const CmRing& ring, const glm::dvec2& metres);

/// Returns the turn, in degrees, of an object that faces the street. `inward` is the direction from the street to the
/// lot.
double turn_of(const glm::dvec2& inward);

}  // namespace seedmesh::city
