#pragma once
/// Buildings that the request gives by their footprints. Streets and houses do not overlap them.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/generators/city/plan.h"
#include "core/generators/city/rings.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// One polygon of a feature.
struct GivenFootprint {
  std::string pointer;  ///< pointer of its feature
  Rings rings;          ///< the outer one first
  double height = 0;    ///< height of its walls, metres
};

/// Returns the polygons of the given footprints. Issues: geometries that cannot be read, properties of a wrong type or
/// out of range, and rings that cross themselves.
std::vector<GivenFootprint> given_footprints(const CityParams& params, std::vector<Issue>& issues);

/// Returns a landmark for each footprint: a request of the generator building with the footprint, upright walls and a
/// flat roof.
std::vector<Landmark> landmarks_of(const std::vector<GivenFootprint>& footprints);

/// Finds footprints near a position.
class FootprintIndex {
 public:
  static constexpr double most_reach = 30;  ///< m

  explicit FootprintIndex(const std::vector<GivenFootprint>& footprints);

  bool is_empty() const { return rings_.empty(); }
  /// Whether a position in metres is in a footprint or nearer to one than `reach`, which is at most `most_reach`.
  bool is_near(const glm::dvec2& metres, double reach) const;
  /// Whether a rectangle, given by its corners in centimetres, meets a footprint.
  bool meets(const std::array<CmPoint, 4>& corners) const;

 private:
  using Cell = std::array<std::int32_t, 2>;
  static Cell cell_of(const glm::dvec2& metres);

  std::vector<Rings> rings_;
  std::map<Cell, std::vector<std::uint32_t>> cells_;  ///< footprints within `most_reach` of a cell
};

}  // namespace seedmesh::city
