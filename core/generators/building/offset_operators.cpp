/// Moves the border of a face.

#include "core/generators/building/evaluate.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building::operators {
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
      if (word == "border") {
        Plan ring = moved.empty() ? plan : moved[0].plan;
        ring.rings.emplace_back(plan.rings[0].rbegin(), plan.rings[0].rend());
        if (!moved.empty()) add_plan(solid, ring, plane, face_is_border);
      }
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
