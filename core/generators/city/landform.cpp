#include "core/generators/city/landform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/terrain/plan.h"
#include "core/schema/json.h"
#include "generated/params/city.h"
#include "generated/params/terrain.h"

namespace seedmesh::city {
namespace {

constexpr char terrain_pointer[] = "/terrain/parameters";
constexpr double most = 10'000;  // of a height, m

}  // namespace

Result<Landform> Landform::make(const CityParams& params, const glm::dvec2& low, const glm::dvec2& high,
                                Job& job) {
  Landform landform;
  if (params.maps.height) {
    std::vector<Issue> issues;
    landform.heights_ = FieldMap::read(*params.maps.height, "/maps/height", low, high, job, issues);
    if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
    if (!landform.heights_->is_expression()) {
      landform.base_ = params.maps.height_range[0];
      landform.rise_ = params.maps.height_range[1] - params.maps.height_range[0];
    }
    return landform;
  }
  if (!params.terrain) return landform;
  IssueList errors;
  const TerrainParams terrain = read_terrain(Json::parse(params.terrain->parameters), "", errors);
  const std::uint64_t seed = params.terrain->seed.value_or(job.rng().at("city").at("terrain").key());
  Job own = job.for_child(seed, terrain_pointer);
  Result<terrain::Field> field = terrain::field_of(terrain, own);
  if (!field) {
    Error error = std::move(field).error();
    for (Issue& issue : error.issues) issue.pointer.insert(0, terrain_pointer);
    return error;
  }
  landform.field_ = std::move(*field);
  if (terrain.water_level &&
      *terrain.water_level > static_cast<double>(terrain::range_of(landform.field_, job).low))
    landform.water_level_ = terrain.water_level;
  return landform;
}

double Landform::at(const glm::dvec2& metres) const {
  if (heights_) return std::clamp(base_ + rise_ * heights_->value_at(metres), 0 - most, most);
  if (field_.width == 0) return 0;
  const double x = std::clamp(metres.x / field_.cell + (field_.width - 1) / 2.0, 0.0, field_.width - 1.0);
  const double z = std::clamp((field_.depth - 1) / 2.0 - metres.y / field_.cell, 0.0, field_.depth - 1.0);
  const std::int32_t i = std::min(math::to_int32(x), field_.width - 2);
  const std::int32_t j = std::min(math::to_int32(z), field_.depth - 2);
  const double u = x - i, v = z - j;
  const auto height = [&](std::int32_t east, std::int32_t south) {
    return static_cast<double>(field_.at(i + east, j + south));
  };
  return (height(0, 0) * (1 - u) + height(1, 0) * u) * (1 - v) +
         (height(0, 1) * (1 - u) + height(1, 1) * u) * v;
}

glm::dvec2 Landform::gradient(const glm::dvec2& metres, double reach) const {
  // Least squares of a plane through points on two circles.
  constexpr double half = 0.70710678118654752;
  constexpr std::array<std::array<double, 2>, 4> sides = {{{1, 0}, {half, half}, {0, 1}, {0 - half, half}}};
  glm::dvec2 sum(0);
  for (const double radius : {reach / 2, reach}) {
    for (const auto& side : sides) {
      const glm::dvec2 off = glm::dvec2(side[0], side[1]) * radius;
      sum += off * (at(metres + off) - at(metres - off));
    }
  }
  return sum / (4 * (reach * reach * 1.25));
}

bool Landform::covers(const glm::dvec2& low, const glm::dvec2& high) const {
  if (field_.width == 0) return true;
  const glm::dvec2 half = glm::dvec2(field_.width - 1, field_.depth - 1) * (field_.cell / 2);
  return low.x >= 0 - half.x && low.y >= 0 - half.y && high.x <= half.x && high.y <= half.y;
}

bool is_too_steep(const Landform& landform, const glm::dvec2& a, const glm::dvec2& b, double grade_limit) {
  constexpr double excess = 1.5, deepest = 5;  // m
  const glm::dvec2 along = b - a;
  const double length = std::sqrt(along.x * along.x + along.y * along.y) / 100;
  const double from = landform.at(a / 100.0), to = landform.at(b / 100.0);
  if (std::abs(to - from) > excess * grade_limit * length) return true;
  const std::int32_t count = math::to_int32(length / 10) + 1;
  for (std::int32_t n = 1; n < count; ++n) {
    const double share = static_cast<double>(n) / count;
    if (std::abs(landform.at((a + along * share) / 100.0) - from - (to - from) * share) > deepest)
      return true;
  }
  return false;
}

void check_landform(const CityParams& params, const Job& job, std::vector<Issue>& issues) {
  if (params.maps.height) {
    FieldMap::read(*params.maps.height, "/maps/height", {-1, -1}, {1, 1}, job, issues);
    if (params.terrain) {
      issues.emplace_back(conflict_with({"terrain"}), "/maps/height",
                          "found both `terrain` and `height`; expected one of them");
    }
  }
  if (!params.terrain || params.terrain->generator.empty()) return;
  if (params.terrain->generator != "terrain") {
    issues.emplace_back(IssueKind::invalid_value, "/terrain/generator",
                        "found " + params.terrain->generator + "; expected terrain");
    return;
  }
  const Json parameters = Json::parse(params.terrain->parameters);
  if (parameters.value("shape", "plane") != "plane") {
    issues.emplace_back(IssueKind::not_available, "/terrain/parameters/shape",
                        "found a sphere; the ground of a city is a plane");
  }
  if (parameters.contains("onto")) {
    issues.emplace_back(IssueKind::not_available, "/terrain/parameters/onto",
                        "the ground of a city cannot follow a model");
  }
}

}  // namespace seedmesh::city
