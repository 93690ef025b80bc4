/// Operations that put a roof on a face.
#include <algorithm>

#include "core/base/math.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/face_plans.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operators.h"
#include "core/geom/polygon/roof.h"

namespace seedmesh::building::operators {
namespace {

struct RoofName {
  std::string_view name;
  RoofKind kind;
};
constexpr RoofName roof_names[] = {
    {"hip", RoofKind::hip},         {"hipped", RoofKind::hip},      {"gable", RoofKind::gable},
    {"gabled", RoofKind::gable},    {"pyramid", RoofKind::pyramid}, {"shed", RoofKind::shed},
    {"mansard", RoofKind::mansard}, {"gambrel", RoofKind::gambrel}, {"flat", RoofKind::flat},
};

/// The names of an operation of its own and of the word in Roof("...").
RoofKind kind_of_roof(const Derivation& d, const Step& step) {
  switch (step.op) {
    case Op::roof_gable:
      return RoofKind::gable;
    case Op::roof_pyramid:
      return RoofKind::pyramid;
    case Op::roof_shed:
      return RoofKind::shed;
    case Op::roof_mansard:
      return RoofKind::mansard;
    case Op::roof_gambrel:
      return RoofKind::gambrel;
    case Op::roof_hip:
      return RoofKind::hip;
    default:
      break;
  }
  const std::string& word = d.grammar.words[d.grammar.arguments[step.first_argument].word];
  const auto* const found = std::ranges::find(roof_names, std::string_view(word), &RoofName::name);
  if (found == std::end(roof_names)) {
    reject(d, step.offset,
           "found the roof " + lang::in_quotes(word) +
               ", expected hip, gable, pyramid, shed, mansard, gambrel or flat");
  }
  return found->kind;
}

double angle_of(Derivation& d, const Argument& argument) {
  const double degrees = number_of(d, argument.value);
  if (!(degrees > 0 && degrees < 90)) {
    reject(
        d, argument.value.offset,
        "found a roof angle of " + text_of_number(degrees) + ", expected an angle between 0 and 90 degrees");
  }
  return math::radians(degrees);
}

/// Reads (angle or height), then for mansard and gambrel (upper angle, break height), for shed (edge), then
/// (overhang) and for gable and gambrel (verge).
RoofOptions options_of(Derivation& d, const Step& step) {
  RoofOptions options;
  options.kind = kind_of_roof(d, step);
  const Argument* a = &d.grammar.arguments[step.first_argument];
  std::uint32_t at = step.op == Op::roof ? 1 : 0;
  if (at < step.argument_count) {
    if (a[at].measure == Measure::height) {
      options.height = number_of(d, a[at].value);
      if (!(*options.height > 0)) {
        reject(d, a[at].value.offset,
               "found a roof height of " + text_of_number(*options.height) + " m, expected a height above 0");
      }
    } else {
      options.angle = angle_of(d, a[at]);
    }
    ++at;
  }
  const auto next = [&] { return at < step.argument_count ? number_of(d, a[at++].value) : 0; };
  const auto next_length = [&] {
    const double length = next();
    if (length < 0)
      reject(d, step.offset, "found a length of " + text_of_number(length) + " m, expected 0 or more");
    return length;
  };
  if (options.kind == RoofKind::mansard || options.kind == RoofKind::gambrel) {
    if (at < step.argument_count) options.upper_angle = angle_of(d, a[at++]);
    options.break_height = next_length();
    if (options.height && options.break_height >= *options.height) {
      reject(d, step.offset,
             "the slope breaks at " + text_of_number(options.break_height) +
                 " m, expected below the height of the roof, " + text_of_number(*options.height) + " m");
    }
  }
  if (options.kind == RoofKind::shed)
    options.low_edge = static_cast<std::uint32_t>(std::clamp(next(), 0.0, 1e6));
  options.overhang = next_length();
  if (options.kind == RoofKind::gable || options.kind == RoofKind::gambrel) options.verge = next_length();
  while (at < step.argument_count) {
    if (number_of(d, a[at++].value) != 0)
      warn(d, step.offset, "even ridges, and the choice of the ridge by an edge, have no effect");
  }
  return options;
}

void add_roof(Solid& solid, const Roof& roof, const FacePlane& plane) {
  const auto base = static_cast<std::uint32_t>(solid.points.size());
  for (const glm::dvec3& p : roof.point) solid.points.push_back(plane.raised({p.x, -p.z}, p.y));
  const auto add_loop = [&](const std::vector<std::uint32_t>& corners) {
    solid.loops.push_back(
        {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(corners.size())});
    for (const std::uint32_t corner : corners) solid.corners.push_back(base + corner);
  };
  const bool has_cover = std::ranges::any_of(roof.faces, &RoofFace::is_cover);
  for (const RoofFace& each : roof.faces) {
    const std::uint8_t tag = has_cover && !each.is_cover ? face_is_covered : std::uint8_t{0};
    solid.faces.push_back({static_cast<std::uint32_t>(solid.loops.size()),
                           static_cast<std::uint32_t>(1 + each.holes.size()), false, tag});
    add_loop(each.outline);
    for (const auto& hole : each.holes) add_loop(hole);
  }
}

/// Replaces a volume by its underside, the footprint that a roof of 2006 stands on. False: it has none.
bool take_underside(Derivation& d, ShapeState& state) {
  constexpr double level = 1e-9;
  if (state.geometry != box_geometry) {
    const Solid& whole = d.out.solid_of(state.geometry);
    Solid under;
    for (const Face& face : whole.faces) {
      const auto first_loop = static_cast<std::uint32_t>(under.loops.size());
      bool is_under = true;
      for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
        const Loop& loop = whole.loops[l];
        under.loops.push_back({static_cast<std::uint32_t>(under.corners.size()), loop.count});
        for (std::uint32_t i = loop.count; i-- > 0;) {
          const glm::dvec3& p = whole.points[whole.corners[loop.first + i]];
          is_under &= p.y < level;
          under.corners.push_back(static_cast<std::uint32_t>(under.points.size()));
          under.points.emplace_back(p.x * state.size.x, 0, p.z * state.size.z);
        }
      }
      if (is_under) {
        under.faces.push_back({first_loop, face.loop_count});
        continue;
      }
      under.corners.resize(under.loops[first_loop].first);
      under.points.resize(under.corners.size());
      under.loops.resize(first_loop);
    }
    if (under.faces.empty()) return false;
    take_solid(d, state, std::move(under));
  }
  state.size.y = 0;
  return true;
}

}  // namespace

void roof(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  // In the chain of 2006, S(1r,h,1r) walls T(0,h,0) Roof(...), the scope still has the height of the walls.
  const bool is_volume = step.op == Op::roof && dimension(state.size) == 3 && !state.has_asset();
  const RoofOptions options = options_of(d, step);
  if (is_volume && !take_underside(d, state))
    reject(d, step.offset, "found a volume without a level underside, expected one that a roof can stand on");
  if (dimension(state.size) != 2 || state.has_asset()) {
    reject(d, step.offset,
           "found a shape of " + std::to_string(dimension(state.size)) +
               " dimensions, expected a face for a roof; take the top with comp(f)");
  }
  const FacePlane plane(state.size);
  Solid solid;
  solid.is_closed = true;
  for (Plan& plan : plans_of(flat_solid(d, state), state.size, plane)) {
    remove_repeated_points(plan);
    if (plan.rings.empty()) continue;
    RoofOptions own = options;
    if (own.low_edge >= edge_count(plan)) own.low_edge = 0;
    const std::shared_ptr<const Roof> made = d.task.roofs->roof(plan, own, d.job);
    for (const std::string& warning : made->warnings) warn(d, step.offset, warning);
    add_roof(solid, *made, plane);
  }
  if (solid.faces.empty()) return warn(d, step.offset, "the face is too narrow for a roof and stays flat");
  take_solid(d, state, std::move(solid));
  state.roof_up = static_cast<std::uint8_t>(plane.w);
}

/// Roof("hipped", 30){ A }: the roof is a shape of its own.
void roof_2006(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  ShapeState made = state;
  roof(d, step, made, site);
  Frame own = site.frame;
  own.key = site.key;
  run_body(d, d.grammar.parts[step.first_part].body, made, own);
}

}  // namespace seedmesh::building::operators
