/// Moves the border of a face.

#include <algorithm>

#include "core/generators/building/evaluate.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building::operators {
namespace {

PlanRing reversed(const PlanRing& ring) { return {ring.rbegin(), ring.rend()}; }

/// Adds the region between a plan and a larger one: a face around the plan, and one along each courtyard. They face
/// down, so that their signed areas and that of the larger plan sum up to that of the plan.
void add_outer_border(Solid& solid, const Plan& plan, const Plan& larger, const FacePlane& plane) {
  std::vector<Plan> borders(plan.rings.size());
  borders[0].rings = {larger.rings[0], reversed(plan.rings[0])};
  for (std::size_t i = 1; i < plan.rings.size(); ++i) borders[i].rings = {reversed(plan.rings[i])};
  std::vector<std::size_t> owners;  // of the courtyards that are left; 0: one that the outline has closed
  for (std::size_t k = 1; k < larger.rings.size(); ++k) {
    std::size_t owner = plan.rings.size() - 1;
    while (owner > 0 && !contains(borders[owner], larger.rings[k][0])) --owner;
    owners.push_back(owner);
  }
  for (std::size_t k = 0; k < owners.size(); ++k) borders[owners[k]].rings.push_back(larger.rings[k + 1]);
  for (Plan& border : borders) {
    for (PlanRing& ring : border.rings) std::reverse(ring.begin(), ring.end());
    add_plan(solid, border, plane, face_is_border);
  }
}

}  // namespace

/// offset(d), offset(d, inside), offset(d, border): faces with moved borders, the region between, or both.
void offset(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const double distance = number_of(d, a[0].value);
  const std::string word = step.argument_count > 1 ? d.grammar.words[a[1].word] : "all";
  if (word != "all" && word != "inside" && word != "border")
    reject(d, step.offset, "found " + lang::in_quotes(word) + ", expected all, inside or border");
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for offset");
  if (distance == 0) return;
  const FacePlane plane(state.size);
  Solid solid;
  for (const Plan& plan : plans_of(flat_solid(d, state), state.size, plane)) {
    std::vector<DerivedPlan> moved;
    if (distance < 0) {
      const std::vector<double> all(edge_count(plan), -distance);
      Setback made = seedmesh::setback(plan, all, d.job);
      moved = std::move(made.remainder);
      if (word != "inside") {
        for (const PlanStrip& strip : made.strips) add_plan(solid, strip.plan, plane, face_is_border);
      }
    } else {
      moved = seedmesh::offset(plan, distance, d.job);
      if (word != "inside" && !moved.empty()) add_outer_border(solid, plan, moved[0].plan, plane);
    }
    if (word == "border") continue;
    for (const DerivedPlan& each : moved) add_plan(solid, each.plan, plane, face_is_inside);
  }
  if (solid.faces.empty() && word == "inside" && d.grammar.is_cityengine) {
    // As in CityEngine since 2022.1.
    warn(d, step.offset, "the offset leaves nothing inside; the face stays as it was");
    return;
  }
  if (solid.faces.empty()) {
    state.size = glm::dvec3(0);
    state.geometry = box_geometry;
    return;
  }
  take_solid(d, state, std::move(solid));
}
}  // namespace seedmesh::building::operators
