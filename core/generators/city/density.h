#pragma once
/// FieldMap: a scalar field over the area, given by an expression over x and y, by the brightness of an image, or by
/// polygons.
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/array.h"
#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/rings.h"
#include "core/lang/expression.h"
#include "core/schema/geojson.h"

namespace seedmesh::city {

/// The value of a map in a request.
using MapValue = std::variant<std::string, GeoJson>;

/// Immutable; threads may share it.
class FieldMap {
 public:
  /// Reads an expression, a PNG data URI or polygons. An image covers the box [low, high] in metres, with its first
  /// row in the north. Polygons have the value 1 inside. Returns nullopt and adds an issue at `pointer` if the text
  /// or the image cannot be read.
  static std::optional<FieldMap> read(const MapValue& value, const std::string& pointer,
                                      const glm::dvec2& low, const glm::dvec2& high, const Job& job,
                                      std::vector<Issue>& issues);

  /// Returns the value at a position in metres, between 0 and 1; 0 where the expression has no finite value.
  double at(const glm::dvec2& metres) const;

  /// Like at(), but the value is not limited to 0..1. Used for heights.
  double value_at(const glm::dvec2& metres) const;

  /// Whether the map is an expression, whose values have no limits.
  bool is_expression() const { return width_ == 0 && !has_polygons_; }

  /// Returns the polygons, if the map consists of polygons.
  const std::vector<Rings>& polygons() const { return polygons_; }

 private:
  static std::optional<FieldMap> read_text(const std::string& text, const std::string& pointer,
                                           std::vector<Issue>& issues);

  lang::Program program_;
  lang::Expression expression_;
  glm::dvec2 low_{0}, size_{1};
  std::uint32_t width_ = 0, height_ = 0;  ///< size of the image in pixels; 0 for expressions and polygons
  Array<float> pixels_;
  std::vector<Rings> polygons_;
  bool has_polygons_ = false;
};

}  // namespace seedmesh::city
