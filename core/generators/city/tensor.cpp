#include "core/generators/city/tensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/landform.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double weak = 0.05;  // weight of the grid below all fields, where they cancel or end
constexpr double noise_spacings = 2,
                 greatest_turn = 40;  // of an organic pattern: spacings of major streets, degrees

/// Of a direction: the square of the complex number, so that opposite directions are alike.
dvec2 doubled(const dvec2& d) {
  const double squared = glm::dot(d, d);
  if (squared == 0) return {0, 0};
  return {(d.x * d.x - d.y * d.y) / squared, 2 * d.x * d.y / squared};
}

/// The reach within which the ground decides a slope, m: a field that is smooth over distances of major streets has
/// streamlines that keep their spacing.
double slope_reach(const CityStreets& streets) { return std::max(10.0, streets.major_spacing / 4); }

dvec2 grid_of(double degrees) {
  const math::SinCos turn = math::sincos_degrees(2 * degrees);
  return {turn.cos, turn.sin};
}

}  // namespace

CityPattern second_pattern_of(const CityStreets& streets) {
  if (streets.second_pattern) {
    // Both have the same values in the same order.
    return static_cast<CityPattern>(*streets.second_pattern);
  }
  return streets.pattern == CityPattern::raster ? CityPattern::organic : CityPattern::raster;
}

TensorField::Base TensorField::base_of(CityPattern pattern, const CityStreets& streets) {
  Base base;
  base.grid = grid_of(streets.angle);
  base.position = {streets.centre[0] * 100, streets.centre[1] * 100};
  if (pattern == CityPattern::radial) base.shape = Shape::radial;
  if (pattern == CityPattern::slope) base.shape = Shape::height;
  if (pattern == CityPattern::organic) base.shape = Shape::noise;
  return base;
}

TensorField::TensorField(const CityStreets& streets, const FieldMap& blend, const Landform* landform, Rng rng)
    : landform_(landform), blend_(&blend), slope_reach_(slope_reach(streets)), rng_(rng) {
  bases_.push_back({Shape::grid, {0, 0}, grid_of(streets.angle), weak, 0, {}});
  bases_.push_back(base_of(streets.pattern, streets));
  bases_.push_back(base_of(second_pattern_of(streets), streets));
  bases_.back().is_second = true;
  noise_size_ = streets.major_spacing * noise_spacings * 100;
}

TensorField::TensorField(const CityStreets& streets, const Landform* landform)
    : landform_(landform), slope_reach_(slope_reach(streets)) {
  bases_.push_back({Shape::grid, {0, 0}, grid_of(streets.angle), weak, 0, {}});
  bases_.push_back({Shape::height, {0, 0}, {1, 0}, 1, 0, {}});
}

TensorField::TensorField(const CityStreets& streets, const Region& region, const Landform* landform,
                         std::vector<Issue>& issues)
    : landform_(landform), slope_reach_(slope_reach(streets)) {
  bases_.push_back({Shape::grid, {0, 0}, grid_of(streets.angle), weak, 0, {}});
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
      if (line.size() < 2) {
        issues.emplace_back(missing_for({"type"}), "/streets/tensor/fields/" + std::to_string(i) + "/points",
                            "found " + std::to_string(line.size()) + " points, expected at least 2");
      }
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

StreetFields fields_of(const CityStreets& streets, const FieldGround& ground, Rng rng,
                       std::vector<Issue>& issues) {
  const bool grows = streets.method == CityMethod::growth;
  StreetFields fields;
  if (ground.blend) {
    fields.majors = std::make_shared<TensorField>(streets, *ground.blend, ground.landform, rng);
  } else if (streets.method == CityMethod::tensor) {
    fields.majors = std::make_shared<TensorField>(streets, ground.region, ground.landform, issues);
  } else if (grows && streets.pattern == CityPattern::slope) {
    fields.majors = std::make_shared<TensorField>(streets, ground.landform);
  }
  const bool follows_slope =
      streets.minor_pattern ? *streets.minor_pattern == CityMinorPattern::slope
                            : streets.method == CityMethod::wards && streets.pattern == CityPattern::slope;
  if (follows_slope) {
    fields.minors = std::make_shared<TensorField>(streets, ground.landform);
  } else if (!streets.minor_pattern) {
    fields.minors = fields.majors;
  }
  return fields;
}

dvec2 TensorField::tensor_of(const Base& base, const dvec2& cm, double& squared_distance) const {
  const dvec2 off = cm - base.position;
  squared_distance = glm::dot(off, off);
  if (base.shape == Shape::grid) return base.grid;
  if (base.shape == Shape::radial) return doubled(off);
  if (base.shape == Shape::noise) {
    const dvec2 turn = grid_of(greatest_turn * noise_at(cm));
    return {base.grid.x * turn.x - base.grid.y * turn.y, base.grid.x * turn.y + base.grid.y * turn.x};
  }
  if (base.shape == Shape::height) {
    if (!landform_) return {0, 0};
    // Along the contour; full weight from a slope of 1:10.
    const dvec2 rise = landform_->gradient(cm / 100.0, slope_reach_);
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

double TensorField::noise_at(const dvec2& cm) const {
  const dvec2 at = cm / noise_size_;
  const std::int32_t column = math::to_int32(std::floor(at.x)), row = math::to_int32(std::floor(at.y));
  const auto value = [&](std::int32_t dx, std::int32_t dy) {
    return rng_.at(static_cast<std::uint32_t>(column + dx))
        .at(static_cast<std::uint32_t>(row + dy))
        .uniform(-1, 1);
  };
  const auto eased = [](double t) { return t * t * (3 - 2 * t); };
  const double s = eased(at.x - column), t = eased(at.y - row);
  const double low = value(0, 0) * (1 - s) + value(1, 0) * s, high = value(0, 1) * (1 - s) + value(1, 1) * s;
  return low * (1 - t) + high * t;
}

double TensorField::organic_share_at(const dvec2& cm) const {
  if (!blend_) return 0;
  double share = 0;
  const double second = blend_->at(cm / 100.0);
  for (const Base& base : bases_) {
    if (base.shape == Shape::noise) share += base.is_second ? second : 1 - second;
  }
  return share;
}

dvec2 TensorField::tensor_at(const dvec2& cm) const {
  dvec2 sum{0};
  if (blend_) {
    const double second = blend_->at(cm / 100.0);
    const std::array<double, 3> weights = {weak, 1 - second, second};
    double unused = 0;
    for (std::size_t i = 0; i < bases_.size(); ++i) {
      if (weights[i] > 0) sum += tensor_of(bases_[i], cm, unused) * weights[i];
    }
    return sum;
  }
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
