#pragma once
/// The natural ground of a city: the height field of a terrain, a map, or level ground at height 0. Positions
/// are metres east and north.
#include <optional>
#include <utility>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/density.h"
#include "core/generators/terrain/field.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Immutable; threads may share it.
class Landform {
 public:
  /// Level ground at height 0.
  Landform() = default;

  /// Returns the ground of a request, whose area has the box [low, high] in metres. Issues: those of the terrain, below
  /// /terrain/parameters, and of the map at /maps/height.
  static Result<Landform> make(const CityParams& params, const glm::dvec2& low, const glm::dvec2& high,
                               Job& job);

  /// Ground that another generator made, with its centre at the origin. Field::margin has to be 0.
  explicit Landform(terrain::Field field) : field_(std::move(field)) {}

  bool is_level() const { return !heights_ && field_.width == 0; }
  bool has_expression() const { return heights_ && heights_->is_expression(); }

  /// Returns the height of the natural ground; beyond the border of a terrain, that of its border.
  double at(const glm::dvec2& metres) const;

  /// Returns the rise per metre to the east and to the north of a plane through the ground within a reach (m).
  glm::dvec2 gradient(const glm::dvec2& metres, double reach) const;

  /// Returns the height of the water of a terrain that is partly below it.
  const std::optional<double>& water_level() const { return water_level_; }

  /// Whether the rectangle [low, high], in metres, lies within the terrain.
  bool covers(const glm::dvec2& low, const glm::dvec2& high) const;

 private:
  terrain::Field field_;
  std::optional<FieldMap> heights_;
  double base_ = 0, rise_ = 1;  ///< metres: height at the value 0 of `heights_`, and the rise to the value 1
  std::optional<double> water_level_;
};

/// Whether the ground along a segment (cm) is too steep. Between its ends it may be at most 1.5 times as steep
/// as `grade_limit`, and at most 5 m above or below the straight line.
bool is_too_steep(const Landform& landform, const glm::dvec2& a, const glm::dvec2& b, double grade_limit);

/// Adds the errors of the ground of a request that the schema cannot express.
void check_landform(const CityParams& params, const Job& job, std::vector<Issue>& issues);

}  // namespace seedmesh::city
