/// Operations that move chosen edges of a face inwards: setbacks, and plans in the shape of L, U and O.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/generators/building/components.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building::operators {
namespace {

constexpr int area_steps = 50;  ///< of the bisection for an area

/// The classes of an edge by the direction that it faces in the plane: the front of a lot is +z, the top of a
/// facade is +y.
std::uint32_t classes_of_edge(const glm::dvec2& a, const glm::dvec2& b, const FacePlane& plane) {
  const glm::dvec2 outward(b.y - a.y, a.x - b.x);
  const glm::dvec3 n = plane.raised(outward, 0);
  const glm::dvec3 m = glm::abs(n);
  if (m.y >= m.x && m.y >= m.z) return n.y > 0 ? face_top | face_all : face_bottom | face_all;
  if (m.z >= m.x) return (n.z > 0 ? face_front : face_back) | face_side | face_all;
  return (n.x > 0 ? face_right : face_left) | face_side | face_all;
}

/// The region between the chosen edges and their new positions as one ring; none unless the edges follow each
/// other.
std::optional<Plan> band_of(const Plan& whole, const Setback& setback, std::span<const double> distances) {
  if (whole.rings.size() != 1 || setback.remainder.size() != 1 || setback.remainder[0].plan.rings.size() != 1)
    return std::nullopt;
  const PlanRing &outer = whole.rings[0], &inner = setback.remainder[0].plan.rings[0];
  const std::size_t count = outer.size();
  const auto is_chosen = [&](std::size_t edge) { return distances[edge % count] > 0; };
  std::size_t first = count, runs = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_chosen(i) || is_chosen(i + count - 1)) continue;
    first = i;
    ++runs;
  }
  if (runs == 0) return Plan{{outer, PlanRing(inner.rbegin(), inner.rend())}};
  if (runs != 1) return std::nullopt;
  std::size_t length = 0;
  while (length < count && is_chosen(first + length)) ++length;
  PlanRing ring;
  for (std::size_t i = 0; i <= length; ++i) ring.push_back(outer[(first + i) % count]);
  // The moved edges of the run, from the last back to the first.
  const std::vector<std::uint32_t>& source = setback.remainder[0].source;
  std::size_t last = inner.size();
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (is_chosen(source[i]) && !is_chosen(source[(i + 1) % inner.size()])) last = i;
  }
  if (last == inner.size()) return std::nullopt;
  std::size_t at = last;
  ring.push_back(inner[(at + 1) % inner.size()]);
  while (is_chosen(source[at])) {
    ring.push_back(inner[at]);
    at = (at + inner.size() - 1) % inner.size();
    if (at == last) break;
  }
  return Plan{{ring}};
}

bool has_selectors(const Step& step) {
  return step.op == Op::setback || step.op == Op::setback_per_edge || step.op == Op::setback_to_area;
}

/// The distances of all edges of all faces, through their rings: one number, an array, or an expression that is evaluated for each
/// edge as a shape.
std::vector<double> edge_distances(Derivation& d, const Step& step, const ShapeState& state,
                                   const StepContext& site, std::uint32_t edges) {
  const Argument& argument = argument_at(d, step, 0);
  std::vector<double> out(edges, 0.0);
  const auto positive = [&](double distance) {
    if (distance < 0) {
      reject(d, argument.value.offset,
             "found a distance of " + text_of_number(distance) + " m, expected 0 or more");
    }
    return distance;
  };
  if (step.op == Op::setback_per_edge) {
    const std::vector<Component> components = components_of(d, state, component_face_edges);
    for (std::uint32_t e = 0; e < edges && e < components.size(); ++e) {
      ShapeState own = components[e].state;
      own.comp_index = e;
      own.comp_total = edges;
      look_at(d, own, site.frame.shape);
      out[e] = positive(number_of(d, argument.value));
    }
    look_at(d, state, site.frame.shape);
    return out;
  }
  const Rng random = d.random;
  const lang::TaggedValue value = evaluate(d, argument.value);
  if (is_array(value)) {
    const Evaluation at{d, argument.value.offset};
    const ValueArray array = array_in(at, value);
    for (std::uint32_t e = 0; e < edges && e < array.values.size(); ++e)
      out[e] = positive(number_in(at, array.values[e]));
    return out;
  }
  d.random = random;  // a number is evaluated once
  out.assign(edges, positive(length_of(d, argument, 1)));
  return out;
}

/// The widths of shapeL (front, left), shapeU (front, right, left) and shapeO (front, right, back, left) for an edge.
double wing_of(const Step& step, std::uint32_t classes, const std::array<double, 4>& widths) {
  const bool front = (classes & (face_front | face_bottom)) != 0,
             back = (classes & (face_back | face_top)) != 0;
  const bool left = (classes & face_left) != 0;
  if (step.op == Op::shape_l) return front ? widths[0] : left ? widths[1] : 0;
  if (step.op == Op::shape_u) return front ? widths[0] : back ? 0 : left ? widths[2] : widths[1];
  return front ? widths[0] : back ? widths[2] : left ? widths[3] : widths[1];
}

/// A face with the distance and the selector of each edge.
struct Moved {
  Plan plan;
  std::vector<double> distances;
  std::vector<const Part*> part_of;
};

double remaining_area(const std::vector<Moved>& faces, double distance, const Job& job) {
  double sum = 0;
  for (const Moved& face : faces) {
    std::vector<double> distances(face.distances.size(), 0.0);
    for (std::size_t e = 0; e < distances.size(); ++e)
      distances[e] = face.part_of[e] != nullptr ? distance : 0;
    for (const DerivedPlan& rest : seedmesh::setback(face.plan, distances, job).remainder)
      sum += area(rest.plan);
  }
  return sum;
}

/// The one distance that leaves this area, by bisection: the area only falls.
void set_for_area(Derivation& d, const Step& step, const ShapeState& state, std::vector<Moved>& faces) {
  const Argument& argument = argument_at(d, step, 0);
  const double all = area_of(d, state);
  const double wanted = length_of(d, argument, all);
  if (!(wanted >= 0)) {
    reject(d, argument.value.offset,
           "found an area of " + text_of_number(wanted) + " m2, expected 0 or more");
  }
  double low = 0, high = std::max({state.size.x, state.size.y, state.size.z});
  if (wanted >= all) high = 0;
  for (int i = 0; i < area_steps && high > 0; ++i) {
    const double middle = 0.5 * (low + high);
    (remaining_area(faces, middle, d.job) > wanted ? low : high) = middle;
    d.job.check();
  }
  for (Moved& face : faces) {
    for (std::size_t e = 0; e < face.distances.size(); ++e)
      face.distances[e] = face.part_of[e] != nullptr ? high : 0;
  }
}

std::vector<Moved> moved_faces(Derivation& d, const Step& step, const ShapeState& state,
                               const StepContext& site, const FacePlane& plane) {
  const std::span<const Part> parts(d.grammar.parts.data() + step.first_part, step.part_count);
  std::vector<Moved> faces;
  std::uint32_t edges = 0;
  for (Plan& plan : plans_of(flat_solid(d, state), state.size, plane)) {
    edges += edge_count(plan);
    faces.push_back({std::move(plan), {}, {}});
  }
  std::array<double, 4> widths{};
  std::vector<double> given(edges, 0.0);
  if (!has_selectors(step)) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      widths[i] = i < step.argument_count ? length_of(d, argument_at(d, step, i), 1) : 0;
      if (widths[i] < 0)
        reject(d, step.offset, "found a width of " + text_of_number(widths[i]) + " m, expected 0 or more");
    }
  } else if (step.op != Op::setback_to_area) {
    given = edge_distances(d, step, state, site, edges);
  }
  const bool has_conditions =
      std::ranges::any_of(parts, [](const Part& part) { return part.condition.is_given; });
  const std::vector<Component> components =
      has_conditions ? components_of(d, state, component_face_edges) : std::vector<Component>{};
  std::vector<std::int32_t> numbers(parts.size(), 0);
  std::uint32_t number = 0;
  for (Moved& face : faces) {
    for (std::uint32_t e = 0; e < edge_count(face.plan); ++e, ++number) {
      const auto [from, to] = edge_of(face.plan, e);
      Component edge;
      edge.state = number < components.size() ? components[number].state : state;
      edge.classes[0] = edge.classes[1] = classes_of_edge(from, to, plane);
      const Part* taken = nullptr;
      for (std::size_t p = 0; p < parts.size() && has_selectors(step); ++p) {
        if (parts[p].is_remainder) continue;
        if (!parts[p].condition.is_given && (edge.classes[0] & parts[p].classes) == 0) continue;
        const std::int32_t own = parts[p].index == -2 ? static_cast<std::int32_t>(number) : numbers[p]++;
        if (taken == nullptr && is_selected(d, parts[p], edge, own, site.frame.shape)) taken = &parts[p];
      }
      face.part_of.push_back(taken);
      face.distances.push_back(has_selectors(step) ? (taken != nullptr ? given[number] : 0)
                                                   : wing_of(step, edge.classes[0], widths));
    }
  }
  look_at(d, state, site.frame.shape);
  if (step.op == Op::setback_to_area) set_for_area(d, step, state, faces);
  return faces;
}

}  // namespace

/// Edges that a selector takes move inwards. Strips go to their selectors, the rest to `remainder`.
void setback(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for this operation");
  const FacePlane plane(state.size);
  Frame own = site.frame;
  std::uint32_t place = 0;
  const auto run = [&](const Part& part, const std::vector<Plan>& plans) {
    Solid solid;
    for (const Plan& plan : plans) add_plan(solid, plan, plane, 0);
    if (solid.faces.empty()) return;
    ShapeState piece = state;
    take_solid(d, piece, std::move(solid));
    if (dimension(piece.size) != 2) return;
    piece.selector = static_cast<std::uint16_t>(part.word);
    own.key = key_at(site.key, place++);
    run_body(d, part.body, piece, own);
  };
  const std::span<const Part> parts(d.grammar.parts.data() + step.first_part, step.part_count);
  const std::vector<Moved> faces = moved_faces(d, step, state, site, plane);
  std::vector<Setback> made;
  made.reserve(faces.size());
  for (const Moved& face : faces) made.push_back(seedmesh::setback(face.plan, face.distances, d.job));
  for (const Part& part : parts) {
    std::vector<Plan> merged;
    const auto give = [&](const Plan& plan) {
      if (part.is_merged) {
        merged.push_back(plan);
      } else {
        run(part, {plan});
      }
    };
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const std::optional<Plan> band = has_selectors(step) || part.is_remainder
                                           ? std::nullopt
                                           : band_of(faces[f].plan, made[f], faces[f].distances);
      if (part.is_remainder) {
        for (const DerivedPlan& each : made[f].remainder) give(each.plan);
      } else if (band) {
        give(*band);
      } else {
        for (const PlanStrip& strip : made[f].strips) {
          if (!has_selectors(step) || faces[f].part_of[strip.edge] == &part) give(strip.plan);
        }
      }
    }
    if (part.is_merged) run(part, merged);
  }
}

}  // namespace seedmesh::building::operators
