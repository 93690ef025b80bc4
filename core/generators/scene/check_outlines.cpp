// Errors of buildings and areas that the schema cannot express; see buildings.h.
#include "core/generators/scene/buildings.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

// The most points of an outline, and the most work for all of them: the sum of the squared numbers of points.
constexpr std::size_t most_points = 5000;
constexpr double most_work = 2e9;

using Rings = std::vector<std::vector<std::array<double, 2>>>;

std::size_t points_of(const Rings& rings) {
  std::size_t points = 0;
  for (const auto& ring : rings) points += ring.size();
  return points;
}

void check_rings(const Rings& rings, const std::string& pointer, const Job& job, std::vector<Issue>& issues) {
  const std::size_t points = points_of(rings);
  if (points > most_points) {
    issues.emplace_back(
        IssueKind::out_of_range, pointer,
        "found " + std::to_string(points) + " points; expected at most " + std::to_string(most_points));
    return;
  }
  for (const PlanDefect& defect : defects_of(plan_of_rings(rings), &job)) {
    issues.emplace_back(IssueKind::invalid_value, pointer + "/" + std::to_string(defect.ring),
                        defect.message);
  }
}

void check_building(const SceneBuilding& building, const std::string& pointer, const Job& job,
                    std::vector<Issue>& issues) {
  check_rings(building.footprint, pointer + "/footprint", job, issues);
  const auto number = [](double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.ends_with('.') ? text.substr(0, text.size() - 1) : text;
  };
  if (!(building.base < building.height)) {
    issues.emplace_back(
        IssueKind::out_of_range, pointer + "/base",
        "found " + number(building.base) + "; expected less than the height, " + number(building.height));
    return;
  }
  const SceneRoof& roof = building.roof;
  const auto conflict = [&](bool is_given, const char* name, const char* other, const char* message) {
    if (is_given) issues.emplace_back(conflict_with({other}), pointer + "/roof/" + name, message);
  };
  if (roof.shape == SceneShape::flat) {
    const char* message = "has no effect on a flat roof";
    conflict(roof.height.has_value(), "height", "shape", message);
    conflict(roof.angle.has_value(), "angle", "shape", message);
    conflict(roof.direction.has_value(), "direction", "shape", message);
    conflict(roof.orientation == SceneOrientation::across, "orientation", "shape", message);
    return;
  }
  conflict(roof.height && roof.angle, "angle", "height",
           "found both `height` and `angle`; expected one of them");
  conflict(roof.direction && roof.orientation == SceneOrientation::across, "orientation", "direction",
           "found both `direction` and `orientation`; expected one of them");
  if (roof.height && *roof.height > building.height - building.base + 1e-6) {
    issues.emplace_back(IssueKind::out_of_range, pointer + "/roof/height",
                        "found " + number(*roof.height) + "; expected at most the height of the building, " +
                            number(building.height - building.base));
  }
}

}  // namespace

void check_outlines(const SceneParams& params, const Job& job, std::vector<Issue>& issues) {
  double work = 0;
  const auto is_too_much = [&](const Rings& rings, const std::string& pointer) {
    const double points = static_cast<double>(points_of(rings));
    work += points * points;
    if (work > most_work) {
      issues.emplace_back(IssueKind::out_of_range, pointer,
                          "the outlines up to this one have too many points together");
    }
    return work > most_work;
  };
  for (std::size_t i = 0; i < params.buildings.size(); ++i) {
    const std::string pointer = "/buildings/" + std::to_string(i);
    if (is_too_much(params.buildings[i].footprint, pointer)) return;
    check_building(params.buildings[i], pointer, job, issues);
  }
  for (std::size_t i = 0; i < params.areas.size(); ++i) {
    const std::string pointer = "/areas/" + std::to_string(i) + "/outline";
    if (is_too_much(params.areas[i].outline, pointer)) return;
    check_rings(params.areas[i].outline, pointer, job, issues);
  }
  if (!params.areas.empty() && params.terrain)
    issues.emplace_back(conflict_with({"terrain"}), "/areas", "found a terrain; areas lie on level ground");
}

}  // namespace seedmesh::scene
