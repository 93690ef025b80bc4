/// What is made of a face: roofs, offsets, setbacks, and plans in the shape of L, U and O.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/deriver.h"
#include "core/geom/roof.h"

namespace seedmesh::building {
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

/// The plane of a flat scope: plan x along `u`, plan y along `v`, up along `w`; right-handed in this order.
struct Plane {
  int u, v, w;
  explicit Plane(const glm::dvec3& size)
      : u((flat_axis(size) + 1) % 3), v((flat_axis(size) + 2) % 3), w(flat_axis(size)) {}
  glm::dvec2 flat(const glm::dvec3& p) const { return {p[u], p[v]}; }
  glm::dvec3 raised(const glm::dvec2& p, double height) const {
    glm::dvec3 out(0);
    out[u] = p.x;
    out[v] = p.y;
    out[w] = height;
    return out;
  }
};

/// Each face of a flat solid as a plan, in metres of its scope.
std::vector<seedmesh::Plan> plans_of(const Solid& solid, const glm::dvec3& size, const Plane& plane) {
  std::vector<seedmesh::Plan> plans;
  for (const Face& face : solid.faces) {
    std::vector<PlanRing> rings;
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      PlanRing& ring = rings.emplace_back();
      const Loop& loop = solid.loops[l];
      for (std::uint32_t i = 0; i < loop.count; ++i)
        ring.push_back(plane.flat(solid.points[solid.corners[loop.first + i]] * size));
    }
    plans.push_back(read_plan(std::move(rings)));
  }
  return plans;
}

/// Adds a plan as a face; its points are in metres until the solid is fitted.
void add_plan(Solid& solid, const seedmesh::Plan& plan, const Plane& plane, std::uint8_t tag) {
  Face face{static_cast<std::uint32_t>(solid.loops.size()), static_cast<std::uint32_t>(plan.rings.size()),
            false, tag};
  for (const PlanRing& ring : plan.rings) {
    solid.loops.push_back(
        {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(ring.size())});
    for (const glm::dvec2& p : ring) {
      solid.corners.push_back(static_cast<std::uint32_t>(solid.points.size()));
      solid.points.push_back(plane.raised(p, 0));
    }
  }
  solid.faces.push_back(face);
}

void add_roof(Solid& solid, const Roof& roof, const Plane& plane) {
  const auto base = static_cast<std::uint32_t>(solid.points.size());
  for (const glm::dvec3& p : roof.point) solid.points.push_back(plane.raised({p.x, -p.z}, p.y));
  const auto add_loop = [&](const std::vector<std::uint32_t>& corners) {
    solid.loops.push_back(
        {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(corners.size())});
    for (const std::uint32_t corner : corners) solid.corners.push_back(base + corner);
  };
  for (const RoofFace& each : roof.faces) {
    solid.faces.push_back({static_cast<std::uint32_t>(solid.loops.size()),
                           static_cast<std::uint32_t>(1 + each.holes.size()), false, 0});
    add_loop(each.outline);
    for (const auto& hole : each.holes) add_loop(hole);
  }
}

/// Which way an edge looks, outwards in the plane: a lot's front is +z, a facade's top is +y.
std::uint32_t classes_of_edge(const glm::dvec2& a, const glm::dvec2& b, const Plane& plane) {
  const glm::dvec2 outward(b.y - a.y, a.x - b.x);
  const glm::dvec3 n = plane.raised(outward, 0);
  const glm::dvec3 m = glm::abs(n);
  if (m.y >= m.x && m.y >= m.z) return n.y > 0 ? face_top | face_all : face_bottom | face_all;
  if (m.z >= m.x) return (n.z > 0 ? face_front : face_back) | face_side | face_all;
  return (n.x > 0 ? face_right : face_left) | face_side | face_all;
}

/// The band between the chosen edges and where they moved, as one ring; none where they are no single run.
std::optional<seedmesh::Plan> band_of(const seedmesh::Plan& whole, const Setback& setback,
                                      std::span<const double> distances) {
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
  if (runs == 0) return seedmesh::Plan{{outer, PlanRing(inner.rbegin(), inner.rend())}};
  if (runs != 1) return std::nullopt;
  std::size_t length = 0;
  while (length < count && is_chosen(first + length)) ++length;
  PlanRing ring;
  for (std::size_t i = 0; i <= length; ++i) ring.push_back(outer[(first + i) % count]);
  // The images of the run's edges, from the last back to the first.
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
  return seedmesh::Plan{{ring}};
}

}  // namespace

/// A solid in metres becomes the geometry of the state, and its box the scope.
void Deriver::take_solid(State& state, Solid solid) {
  glm::dvec3 low, extent;
  fit(solid, low, extent);
  state.origin += out_.axes[state.axes] * low;
  state.size = extent;
  state.geometry = add_solid(std::move(solid));
}

/// The underside of a volume in its place: the footprint that a roof of 2006 stands on. False: it has none.
bool Deriver::take_underside(State& state) {
  constexpr double level = 1e-9;
  if (state.geometry != box_geometry) {
    const Solid& whole = out_.solid_of(state.geometry);
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
    take_solid(state, std::move(under));
  }
  state.size.y = 0;
  return true;
}

void Deriver::roof_over(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  std::uint32_t at = 0;
  RoofOptions options;
  switch (step.op) {
    case Op::roof_gable:
      options.kind = RoofKind::gable;
      break;
    case Op::roof_pyramid:
      options.kind = RoofKind::pyramid;
      break;
    case Op::roof_shed:
      options.kind = RoofKind::shed;
      break;
    case Op::roof_mansard:
      options.kind = RoofKind::mansard;
      break;
    case Op::roof_gambrel:
      options.kind = RoofKind::gambrel;
      break;
    case Op::roof: {
      const std::string& word = grammar_.words[a[at++].word];
      const auto* const found = std::ranges::find(roof_names, std::string_view(word), &RoofName::name);
      if (found == std::end(roof_names))
        reject(step.offset, "there is no roof \"" + word +
                                "\", expected hip, gable, pyramid, shed, mansard, gambrel or flat");
      options.kind = found->kind;
      break;
    }
    default:
      options.kind = RoofKind::hip;
  }
  const bool is_asset = (state.geometry & asset_bit) != 0;
  // In the chain of 2006, S(1r,h,1r) walls T(0,h,0) Roof(...), the scope still has the height of the walls.
  if (step.op == Op::roof && dimension(state.size) == 3 && !is_asset && !take_underside(state))
    reject(step.offset, "a roof stands on the underside of a volume, and this one has no level one");
  if (dimension(state.size) != 2 || is_asset)
    reject(step.offset, "a roof stands on a face, found a shape of " + std::to_string(dimension(state.size)) +
                            " dimensions; take the top with comp(f)");
  const auto angle = [&](const Argument& argument) {
    const double degrees = number(argument.value);
    if (!(degrees > 0 && degrees < 90))
      reject(argument.value.offset,
             "the angle of a roof lies between 0 and 90 degrees, found " + text_of_number(degrees));
    return math::radians(degrees);
  };
  if (at < step.argument_count) {
    if (a[at].measure == Measure::height) {
      options.height = number(a[at].value);
      if (!(*options.height > 0)) reject(a[at].value.offset, "the height of a roof is above 0");
    } else {
      options.angle = angle(a[at]);
    }
    ++at;
  }
  const auto next = [&](double otherwise) {
    return at < step.argument_count ? number(a[at++].value) : otherwise;
  };
  const auto length_of = [&](double otherwise) {
    const double length = next(otherwise);
    if (length < 0) reject(step.offset, "an overhang is not below 0");
    return length;
  };
  if (options.kind == RoofKind::mansard || options.kind == RoofKind::gambrel) {
    if (at < step.argument_count) options.upper_angle = angle(a[at++]);
    options.break_height = length_of(0);
    if (options.height && options.break_height >= *options.height)
      reject(step.offset, "the slope breaks at " + text_of_number(options.break_height) +
                              " m, expected below the height of the roof, " +
                              text_of_number(*options.height) + " m");
  }
  if (options.kind == RoofKind::shed) {
    options.low_edge = static_cast<std::uint32_t>(std::clamp(next(0), 0.0, 1e6));
  }
  options.overhang = length_of(0);
  if (options.kind == RoofKind::gable || options.kind == RoofKind::gambrel) options.verge = length_of(0);
  const Plane plane(state.size);
  Solid solid;
  solid.is_closed = true;
  for (const seedmesh::Plan& plan : plans_of(flat_solid(state), state.size, plane)) {
    RoofOptions own = options;
    if (own.low_edge >= edge_count(plan)) own.low_edge = 0;
    const Roof made = seedmesh::roof(plan, own, job_);
    for (const std::string& warning : made.warnings) warn(step.offset, warning);
    add_roof(solid, made, plane);
  }
  take_solid(state, std::move(solid));
  state.roof_up = static_cast<std::uint8_t>(plane.w);
}

/// offset(d), offset(d, inside), offset(d, border): the faces moved, or what lies between.
void Deriver::offset_face(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  const double distance = number(a[0].value);
  const std::string word = step.argument_count > 1 ? grammar_.words[a[1].word] : "all";
  if (word != "all" && word != "inside" && word != "border")
    reject(step.offset, "found \"" + word + "\", expected all, inside or border");
  if (dimension(state.size) != 2 || (state.geometry & asset_bit) != 0)
    reject(step.offset, "offset takes a face");
  if (distance == 0) return;
  const Plane plane(state.size);
  Solid solid;
  for (const seedmesh::Plan& plan : plans_of(flat_solid(state), state.size, plane)) {
    std::vector<DerivedPlan> moved;
    if (distance < 0) {
      const std::vector<double> all(edge_count(plan), -distance);
      Setback made = setback(plan, all, job_);
      moved = std::move(made.remainder);
      if (word != "inside") {
        for (const PlanStrip& strip : made.strips) add_plan(solid, strip.plan, plane, face_is_border);
      }
    } else {
      moved = seedmesh::offset(plan, distance, job_);
      if (word == "border") {
        seedmesh::Plan ring = moved.empty() ? plan : moved[0].plan;
        ring.rings.emplace_back(plan.rings[0].rbegin(), plan.rings[0].rend());
        if (!moved.empty()) add_plan(solid, ring, plane, face_is_border);
      }
    }
    if (word == "border") continue;
    for (const DerivedPlan& each : moved) add_plan(solid, each.plan, plane, face_is_inside);
  }
  if (solid.faces.empty()) {
    state.size = glm::dvec3(0);
    state.geometry = box_geometry;
    return;
  }
  take_solid(state, std::move(solid));
}

/// Edges that a selector takes move inwards; strips go to their selectors, the rest to `remainder`.
void Deriver::set_back(const Step& step, const State& state, const Frame& frame, std::uint64_t key) {
  if (dimension(state.size) != 2 || (state.geometry & asset_bit) != 0)
    reject(step.offset, "setback and its like take a face");
  const Argument* a = &grammar_.arguments[step.first_argument];
  std::array<double, 4> widths{};
  for (std::uint32_t i = 0; i < 4; ++i) {
    widths[i] = i < step.argument_count ? length(a[i], 1) : 0;
    if (widths[i] < 0) reject(step.offset, "a width is not below 0");
  }
  const Plane plane(state.size);
  Frame own = frame;
  std::uint32_t place = 0;
  const auto run = [&](const Part& part, const seedmesh::Plan& plan) {
    Solid solid;
    add_plan(solid, plan, plane, 0);
    State piece = state;
    take_solid(piece, std::move(solid));
    if (dimension(piece.size) != 2) return;
    own.key = key_at(key, place++);
    run_body(part.body, piece, own);
  };
  const std::span<const Part> parts(grammar_.parts.data() + step.first_part, step.part_count);
  const std::vector<seedmesh::Plan> plans = plans_of(flat_solid(state), state.size, plane);
  for (const seedmesh::Plan& plan : plans) {
    const std::uint32_t edges = edge_count(plan);
    std::vector<double> distances(edges, 0.0);
    std::vector<const Part*> part_of(edges, nullptr);
    for (std::uint32_t e = 0; e < edges; ++e) {
      const auto [from, to] = edge_of(plan, e);
      const std::uint32_t classes = classes_of_edge(from, to, plane);
      if (step.op == Op::setback) {
        for (const Part& part : parts) {
          if (part.is_remainder || (part.classes & classes) == 0) continue;
          distances[e] = widths[0];
          part_of[e] = &part;
          break;
        }
      } else {
        const bool front = (classes & (face_front | face_bottom)) != 0,
                   back = (classes & (face_back | face_top)) != 0;
        const bool left = (classes & face_left) != 0;
        // front, left (L); front, right, left (U); front, right, back, left (O)
        if (step.op == Op::shape_l)
          distances[e] = front ? widths[0] : left ? widths[1] : 0;
        else if (step.op == Op::shape_u)
          distances[e] = front ? widths[0] : back ? 0 : left ? widths[2] : widths[1];
        else
          distances[e] = front ? widths[0] : back ? widths[2] : left ? widths[3] : widths[1];
      }
    }
    const Setback made = seedmesh::setback(plan, distances, job_);
    for (const Part& part : parts) {
      if (part.is_remainder) {
        for (const DerivedPlan& each : made.remainder) run(part, each.plan);
      } else if (step.op == Op::setback) {
        for (const PlanStrip& strip : made.strips) {
          if (part_of[strip.edge] == &part) run(part, strip.plan);
        }
      } else if (const auto band = band_of(plan, made, distances)) {
        run(part, *band);
      } else {
        for (const PlanStrip& strip : made.strips) run(part, strip.plan);
      }
    }
  }
}

}  // namespace seedmesh::building
