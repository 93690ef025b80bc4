/// The component split: faces, edges and corners as shapes.

#include "core/base/disjoint_sets.h"
#include "core/generators/building/components.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building::operators {
namespace {

constexpr std::size_t most_masses = 2'000;

/// Faces that share corners as one shape each.
std::vector<ShapeState> sets_of(Derivation& d, const ShapeState& state,
                                const std::vector<ShapeState>& faces) {
  const ShapeState all = merged_faces(d, state, faces);
  const Solid& solid = d.out.solid_of(all.geometry);
  DisjointSets sets(solid.faces.size());
  std::vector<std::uint32_t> first_of(solid.points.size(), none);
  for (std::uint32_t f = 0; f < sets.size(); ++f) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (const std::uint32_t point : points_of(solid, loop)) {
        if (first_of[point] == none) {
          first_of[point] = f;
        } else {
          sets.join(f, first_of[point]);
        }
      }
    }
  }
  std::vector<ShapeState> out;
  for (std::uint32_t f = 0; f < sets.size(); ++f) {
    if (sets.of(f) != f) continue;
    std::vector<ShapeState> own;
    for (std::uint32_t g = 0; g < sets.size(); ++g) {
      if (sets.of(g) == f) own.push_back(faces[g]);
    }
    out.push_back(merged_faces(d, state, own));
  }
  return out;
}

}  // namespace

void comp(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  take_box_of_asset(d, step, state);
  std::vector<Component> all;
  if (dimension(state.size) >= 2) all = components_of(d, state, step.axis);
  std::vector<std::uint8_t> is_taken(all.size(), 0);
  Frame own = site.frame;
  const bool is_body = dimension(state.size) == 3 &&
                       (state.geometry == box_geometry || d.out.solid_of(state.geometry).is_closed);
  if (is_body && d.task.keeps_masses && !site.frame.is_carried && d.out.masses.size() < most_masses)
    d.out.masses.push_back({state.origin, state.size, state.axes, state.geometry});
  own.is_carried |= is_body;
  std::uint32_t place = 0;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = d.grammar.parts[step.first_part + p];
    std::vector<ShapeState> taken;
    std::int32_t number = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_counted = part.condition.is_given || (all[i].classes[part.frame] & part.classes) != 0;
      if (!is_counted) continue;
      const std::int32_t own_number = part.index == -2 ? static_cast<std::int32_t>(i) : number++;
      if (is_taken[i] != 0 || !is_selected(d, part, all[i], own_number, site.frame.shape)) continue;
      is_taken[i] = 1;
      taken.push_back(all[i].state);
    }
    if (taken.empty()) continue;
    if (step.axis == component_faces && part.is_by_set) {
      taken = sets_of(d, state, taken);
    } else if (part.is_merged && step.axis == component_faces) {
      taken.assign(1, merged_faces(d, state, taken));
    }
    for (std::uint32_t i = 0; i < taken.size(); ++i) {
      taken[i].comp_index = i;
      taken[i].comp_total = static_cast<std::uint32_t>(taken.size());
      taken[i].selector = static_cast<std::uint16_t>(part.word);
      own.key = key_at(site.key, place++);
      run_body(d, part.body, taken[i], own);
    }
  }
}

}  // namespace seedmesh::building::operators
