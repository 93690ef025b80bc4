/// Operations that cut a shape into pieces along an axis: boxes by arithmetic, solids by planes.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/projections.h"
#include "core/generators/building/slabs.h"

namespace seedmesh::building::operators {
namespace {

constexpr double same_border = 1e-7;  ///< metres: a snap line this near to a border is on it

double shapes_left(const Derivation& d) {
  const std::uint64_t most = d.job.limits().shapes;
  return static_cast<double>(most - std::min(most, d.job.spent(Resource::shapes)));
}

[[noreturn]] void refuse_shapes(const Derivation& d, const Step& step, std::string_view name, double wanted) {
  const std::uint64_t bound = d.job.limits().shapes;
  const std::string count =
      wanted < 1e15 ? std::to_string(static_cast<std::uint64_t>(wanted)) : "more than 10^15";
  Issue issue = issue_in_rules(d.task, IssueKind::limit, step.offset,
                               "this " + std::string(name) + " makes " + count +
                                   " shapes or more; the limit is " + std::to_string(bound) + " in all");
  issue.limit = Limit{Resource::shapes, bound, static_cast<std::uint64_t>(math::to_int64(wanted))};
  d.job.refuse(std::move(issue));
}

void warn_of_no_size(Derivation& d, const Step& step) {
  warn(d, step.offset, "the shape has no size along the axis of this split, so that it makes no pieces");
}

/// Adds the snap lines that cross the inside of the scope, as rising distances from its low end.
void snapped(const Derivation& d, const Step& step, const ShapeState& state, std::vector<double>& lines) {
  if (!step.keeps_to_snaps || d.first_pass == nullptr) return;
  const glm::dvec3 axis = d.out.axes[state.axes][step.axis];
  for (const SnapPlane& plane : d.first_pass->snaps()) {
    const double along = glm::dot(plane.normal, axis);
    if (std::abs(along) < 0.9999) continue;
    const double at = (plane.distance - glm::dot(plane.normal, state.origin)) / along;
    if (at > same_border && at < state.size[step.axis] - same_border) lines.push_back(at);
  }
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end(), [](double a, double b) { return b - a < same_border; }),
              lines.end());
}

/// The pieces of `whole`, in its unit. Sizes are evaluated once, before any piece is made.
std::vector<Cut> cuts_of(Derivation& d, const Step& step, double whole) {
  d.cells.clear();
  const auto fill = [&](auto&& self, std::uint32_t first_part, std::uint32_t count) -> std::uint32_t {
    const auto first = static_cast<std::uint32_t>(d.cells.size());
    d.cells.resize(d.cells.size() + count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Part& part = d.grammar.parts[first_part + i];
      Cell cell;
      cell.part = first_part + i;
      cell.is_group = part.is_group;
      if (part.is_group) {
        cell.first = self(self, part.first_part, part.part_count);
        cell.count = part.part_count;
      } else {
        cell.size = number_of(d, part.size.value);
        cell.measure = part.size.measure;
      }
      d.cells[first + i] = cell;
    }
    return first;
  };
  fill(fill, step.first_part, step.part_count);
  std::vector<Cut> cuts;
  if (!d.spare_cuts.empty()) {
    cuts = std::move(d.spare_cuts.back());
    d.spare_cuts.pop_back();
    cuts.clear();
  }
  double wanted = 0;
  if (!cut(d.cells, step.part_count, whole, {d.task.rounding.value_or(Rounding::nearest), shapes_left(d)},
           cuts, wanted)) {
    refuse_shapes(d, step, "split", wanted);
  }
  return cuts;
}

/// The state with an axis along u or v; `unit` becomes the metres along it that are 1 in the unit of the
/// split.
ShapeState along_texture(Derivation& d, const Step& step, const ShapeState& state, int& axis, double& unit) {
  const bool is_u = step.axis == axis_u;
  int set = 0;
  if (step.argument_count > 2) set = uv_set_at(d, step, 2);
  std::uint32_t place = projection_id(d, state, set, true);
  if (place == 0) place = projection_id(d, state, set, false);
  const glm::dmat3 axes = d.out.axes[state.axes];
  // Without a projection, u and v are the axes of the face: a lot on the ground has v along z.
  const int level = dimension(state.size) == 2 ? flat_axis(state.size) : -1;
  const int own_axis = is_u ? (level == 0 ? 2 : 0) : (level == 1 ? 2 : 1);
  const glm::dvec3 gradient =
      place != 0 ? (is_u ? d.out.projections[place - 1].u : d.out.projections[place - 1].v) : axes[own_axis];
  glm::dvec3 along = gradient;
  if (level >= 0) along -= axes[level] * glm::dot(axes[level], along);
  const double steep = glm::length(along);
  if (!(steep > 1e-9))
    reject(d, step.offset, "u or v is the same all over the shape, so that it cannot be split along it");
  along /= steep;
  unit = step.in_metres ? 1 : 1 / steep;
  for (axis = 0; axis < 3; ++axis) {
    if (glm::dot(axes[axis], along) > 1 - 1e-12) return state;
  }
  ShapeState turned = state;
  glm::dvec3 z = level >= 0 ? axes[level] : glm::cross(along, glm::dvec3(0, 1, 0));
  if (glm::dot(z, z) < 1e-6) z = glm::cross(along, glm::dvec3(1, 0, 0));
  z = math::unit(z - along * glm::dot(z, along), glm::dvec3(0, 0, 1));
  reframe(d, turned, {along, glm::cross(z, along), z});
  axis = 0;
  return turned;
}

/// Runs the successors of the pieces. Each has random numbers of its own.
void run_pieces(Derivation& d, const Step& step, const ShapeState& state, const StepContext& site,
                std::span<const Cut> cuts, int axis) {
  Frame own = site.frame;
  for (std::uint32_t i = 0; i < cuts.size(); ++i) {
    const Cut& each = cuts[i];
    std::optional<ShapeState> piece = slab_of(d, state, axis, each, step.keeps_slab);
    if (!piece) continue;
    piece->split_index = i;
    piece->split_total = static_cast<std::uint32_t>(cuts.size());
    if ((i & 63U) == 0) d.job.check();
    own.key = key_at(site.key, i);
    run_body(d, d.grammar.parts[each.part].body, *piece, own);
  }
}

}  // namespace

void split(Derivation& d, const Step& step, ShapeState& given, const StepContext& site) {
  take_box_of_asset(d, step, given);
  int axis = step.axis;
  double unit = 1;  // metres
  const bool is_texture = step.axis >= axis_u;
  const ShapeState turned = is_texture ? along_texture(d, step, given, axis, unit) : ShapeState{};
  const ShapeState& state = is_texture ? turned : given;
  const double whole = state.size[axis];
  if (!(whole > 0)) {
    warn_of_no_size(d, step);
    return;
  }
  std::vector<Cut> cuts = cuts_of(d, step, whole / unit);
  if (unit != 1) {
    for (Cut& each : cuts) each = {each.start * unit, each.size * unit, each.part};
  }
  std::vector<double> lines;
  snapped(d, step, state, lines);
  std::size_t moved = 1;  // each line moves the nearest border that no line has moved yet
  for (const double line : lines) {
    std::size_t best = 0;
    for (std::size_t i = moved; i < cuts.size(); ++i) {
      if (best == 0 || std::abs(cuts[i].start - line) < std::abs(cuts[best].start - line)) best = i;
    }
    if (best == 0) break;
    const double end = cuts[best].start + cuts[best].size;
    if (line <= cuts[best - 1].start + same_border || line >= end - same_border) continue;
    cuts[best - 1].size = line - cuts[best - 1].start;
    cuts[best] = {line, end - line, cuts[best].part};
    moved = best + 1;
  }
  run_pieces(d, step, state, site, cuts, axis);
  d.spare_cuts.push_back(std::move(cuts));
}

void repeat(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  take_box_of_asset(d, step, state);
  const double whole = state.size[step.axis];
  if (!(whole > 0)) {
    warn_of_no_size(d, step);
    return;
  }
  const Argument& argument = d.grammar.arguments[step.first_argument + 1];
  const double size =
      argument.measure == Measure::relative ? length_of(d, argument, whole) : number_of(d, argument.value);
  if (!(size > 0)) {
    reject(d, step.offset,
           "found a size of " + text_of_number(size) + " for Repeat, expected a number above 0");
  }
  std::vector<double> borders{0};
  snapped(d, step, state, borders);
  borders.push_back(whole);
  std::vector<Cut> cuts;
  double wanted = 0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double span = borders[i + 1] - borders[i];
    const double copies = copies_of(span, size, d.task.rounding.value_or(Rounding::ceil));
    wanted += copies;
    if (wanted > shapes_left(d)) refuse_shapes(d, step, "Repeat", wanted);
    for (double k = 0; k < copies; ++k) {
      const double from = borders[i] + span * (k / copies), to = borders[i] + span * ((k + 1) / copies);
      cuts.push_back({from, to - from, step.first_part});
    }
  }
  run_pieces(d, step, state, site, cuts, step.axis);
}

/// splitArea(x){ 20: A | ~1: B }: the cells of a split whose whole is the area. Bisection finds the position
/// of each cut, because the area below a cut only grows.
void split_area(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  if (dimension(state.size) != 2 || state.has_asset())
    reject(d, step.offset, "found a solid or an edge, expected a face for splitArea");
  const int axis = step.axis;
  const double whole = state.size[axis], all = area_of(d, state);
  if (!(whole > 0)) {
    warn_of_no_size(d, step);
    return;
  }
  std::vector<Cut> cuts = cuts_of(d, step, all);
  if (state.geometry == box_geometry) {
    for (Cut& each : cuts) each = {each.start / all * whole, each.size / all * whole, each.part};
  } else {
    const Solid& solid = d.out.solid_of(state.geometry);
    const auto position_of = [&](double wanted) {
      if (wanted <= 1e-9 * all) return 0.0;
      if (wanted >= all * (1 - 1e-9)) return whole;
      double low = 0, high = 1;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (area_of(clipped(solid, axis, middle, 1), state.size) < wanted ? low : high) = middle;
      }
      d.job.check();
      return 0.5 * (low + high) * whole;
    };
    for (Cut& each : cuts) {
      const double from = position_of(each.start), to = position_of(each.start + each.size);
      each = {from, to - from, each.part};
    }
  }
  run_pieces(d, step, state, site, cuts, axis);
}

}  // namespace seedmesh::building::operators
