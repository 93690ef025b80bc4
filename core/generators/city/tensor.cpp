#include "core/generators/city/tensor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/landform.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double weak = 0.05;  // weight of the grid below all fields, where they cancel or end

/// Of a direction: the square of the complex number, so that opposite directions are alike.
dvec2 doubled(const dvec2& d) {
  const double squared = glm::dot(d, d);
  if (squared == 0) return {0, 0};
  return {(d.x * d.x - d.y * d.y) / squared, 2 * d.x * d.y / squared};
}

}  // namespace

TensorField::TensorField(const CityStreets& streets, const Region& region, const Landform* landform,
                         std::vector<Issue>& issues)
    : landform_(landform) {
  const auto grid_of = [](double degrees) {
    const math::SinCos turn = math::sincos_degrees(2 * degrees);
    return dvec2(turn.cos, turn.sin);
  };
  bases_.push_back({Shape::grid, {0, 0}, grid_of(streets.angle), weak, 0, {}});
  if (streets.pattern == CityPattern::slope) bases_.push_back({Shape::height, {0, 0}, {1, 0}, 1, 0, {}});
  for (std::size_t i = 0; i < streets.tensor.fields.size(); ++i) {
    const CityTensorField& field = streets.tensor.fields[i];
    Base base;
    base.position = {field.position[0] * 100, field.position[1] * 100};
    base.weight = field.weight;
    base.size = field.size * 100;
    if (field.field_type == CityFieldType::grid) base.grid = grid_of(field.angle);
    if (field.field_type == CityFieldType::radial) base.shape = Shape::radial;
    if (field.field_type == CityFieldType::height) base.shape = Shape::height;
    if (field.field_type == CityFieldType::polyline) {
      base.shape = Shape::line;
      CmRing line;
      for (const auto& p : field.points) line.push_back(rounded_cm({p[0] * 100, p[1] * 100}));
      base.lines = {line};
      if (line.size() < 2)
        issues.push_back({IssueKind::missing, "/streets/tensor/fields/" + std::to_string(i) + "/points",
                          "found " + std::to_string(line.size()) + " points, expected at least 2"});
    }
    if (field.field_type == CityFieldType::boundary) {
      base.shape = Shape::line;
      const bool has_shore = std::any_of(region.outline.begin(), region.outline.end(),
                                         [](const OutlineEdge& edge) { return edge.is_shore; });
      for (const OutlineEdge& edge : region.outline) {
        if (edge.is_shore == has_shore) base.lines.push_back({edge.a, edge.b});
      }
    }
    bases_.push_back(std::move(base));
  }
}

dvec2 TensorField::tensor_of(const Base& base, const dvec2& cm, double& squared_distance) const {
  const dvec2 off = cm - base.position;
  squared_distance = glm::dot(off, off);
  if (base.shape == Shape::grid) return base.grid;
  if (base.shape == Shape::radial) return doubled(off);
  if (base.shape == Shape::height) {
    if (!landform_) return {0, 0};
    // Along the contour; full weight from a slope of 1:10.
    const dvec2 rise = landform_->gradient(cm / 100.0);
    return doubled({0 - rise.y, rise.x}) * std::min(1.0, std::sqrt(glm::dot(rise, rise)) * 10);
  }
  squared_distance = 1e300;
  dvec2 along{0};
  for (const CmRing& line : base.lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const dvec2 a = in_cm(line[i - 1]), b = in_cm(line[i]);
      const double distance = distance_to_segment(cm, a, b);
      if (distance * distance >= squared_distance) continue;
      squared_distance = distance * distance;
      along = b - a;
    }
  }
  return doubled(along);
}

dvec2 TensorField::tensor_at(const dvec2& cm) const {
  dvec2 sum{0};
  for (const Base& base : bases_) {
    double squared_distance = 0;
    const dvec2 tensor = tensor_of(base, cm, squared_distance);
    const double decay = base.size > 0 ? math::exp(0 - squared_distance / (base.size * base.size)) : 1;
    sum += tensor * (base.weight * decay);
  }
  return sum;
}

dvec2 TensorField::direction_at(const dvec2& cm) const {
  const dvec2 tensor = tensor_at(cm);
  const double length = std::sqrt(glm::dot(tensor, tensor));
  if (length < 1e-9) return {0, 0};
  // Half of the angle, by the formulas of half angles.
  const double cosine = std::sqrt(std::max(0.0, (1 + tensor.x / length) / 2));
  const double sine = std::sqrt(std::max(0.0, (1 - tensor.x / length) / 2));
  return {cosine, tensor.y < 0 ? 0 - sine : sine};
}

}  // namespace seedmesh::city
