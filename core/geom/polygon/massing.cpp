// Bodies of buildings; see massing.h.
#include "core/geom/polygon/massing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "core/base/math.h"
#include "core/geom/polygon/massing_cut.h"
#include "core/geom/polygon/massing_envelope.h"
#include "core/geom/polygon/massing_merge.h"
#include "core/geom/polygon/roof.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// A plan that fills at least this share of its smallest rectangle has the gables of that rectangle.
constexpr double nearly_rectangle = 0.97;
// Radians, of mansard roofs before they are scaled to their height.
constexpr double steep_angle = 1.2, flat_angle = 0.35;
// A corner is visible from the centroid if it turns around it by more than this share of the squared diagonal.
constexpr double visible = 1e-9;
constexpr int rings_of_a_dome = 8;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// A ring of a surface about a vertical axis: the plan scaled about its centroid.
struct Ring {
  double scale = 1, height = 0;  ///< as shares
};

constexpr std::array<Ring, 9> onion_rings{{{1.14, 0.08},
                                           {1.25, 0.2},
                                           {1.22, 0.32},
                                           {1.02, 0.44},
                                           {0.72, 0.55},
                                           {0.42, 0.66},
                                           {0.2, 0.78},
                                           {0.07, 0.9},
                                           {0, 1}}};

class MassMaker {
 public:
  MassMaker(const Plan& plan, const MassOptions& options, const Job& job)
      : plan_(plan), options_(options), job_(job) {}

  /// First among roofs that are closed as they are written. A plan that touches itself in a point has none; then
  /// among those whose triangles fit together.
  Mass make() {
    for (const bool is_strict : {true, false}) {
      is_strict_ = is_strict;
      if (try_all()) break;
    }
    return std::move(mass_);
  }

 private:
  bool try_all() {
    const MassRoof wanted = options_.roof_height > 0 ? options_.roof : MassRoof::flat;
    if (try_roof(wanted)) return true;
    const bool has_axis =
        wanted == MassRoof::pyramidal || wanted == MassRoof::dome || wanted == MassRoof::onion;
    if (has_axis && try_roof(MassRoof::hipped)) return true;
    if (wanted != MassRoof::flat) {
      start(MassRoof::hipped);
      add_envelope(hipped_envelope(plan_, options_));
      if (fits()) return true;
    }
    start(MassRoof::flat);
    add_envelope(level_envelope());
    return fits();
  }

  bool fits() { return is_strict_ ? merge_points(mass_) : is_closed(mass_); }

  void start(MassRoof kind) {
    mass_ = {};
    mass_.made = kind;
  }

  /// False where the roof does not fit the plan.
  bool try_roof(MassRoof kind) {
    start(kind);
    switch (kind) {
      case MassRoof::hipped:
        return add_skeleton(RoofKind::hip) && fits();
      case MassRoof::mansard:
        return add_skeleton(RoofKind::mansard) && fits();
      case MassRoof::pyramidal:
        return add_rings(std::array<Ring, 1>{{{0, 1}}}) && fits();
      case MassRoof::dome:
        return add_rings(dome_rings()) && fits();
      case MassRoof::onion:
        return add_rings(onion_rings) && fits();
      case MassRoof::gabled:
      case MassRoof::gambrel:
        if (follows_plan() && add_skeleton(kind == MassRoof::gabled ? RoofKind::gable : RoofKind::gambrel) &&
            fits())
          return true;
        start(kind);
        break;
      default:
        break;
    }
    add_envelope(kind == MassRoof::flat ? level_envelope() : envelope_of(plan_, options_));
    return fits();
  }

  /// Whether gables follow the wings of the plan, not one ridge.
  bool follows_plan() const {
    if (options_.direction || options_.across) return false;
    const PlanBox box = smallest_box(plan_);
    return area(plan_) < nearly_rectangle * 4 * box.half.x * box.half.y;
  }

  // --- Parts ---

  void face(MassPart part, const dvec3& normal) {
    mass_.faces.push_back({part, normal, static_cast<std::uint32_t>(mass_.triangles.size())});
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mass_.triangles.push_back({a, b, c}); }
  std::uint32_t point(const dvec2& p, double height) {
    mass_.point.emplace_back(p, height);
    return static_cast<std::uint32_t>(mass_.point.size()) - 1;
  }

  /// A wall below the points `top`, whose heights are a concave function along it, over the floor from `a` to `b`.
  void wall(std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> top) {
    const dvec2 along = dvec2(mass_.point[b]) - dvec2(mass_.point[a]);
    face(MassPart::wall, math::unit(dvec3(along.y, -along.x, 0), {1, 0, 0}));
    triangle(a, b, top.back());
    for (std::size_t i = top.size() - 1; i > 0; --i) triangle(a, top[i], top[i - 1]);
  }

  /// The points of the floor, and its triangles facing down.
  std::uint32_t floor() {
    const auto first = static_cast<std::uint32_t>(mass_.point.size());
    for (const PlanRing& ring : plan_.rings) {
      for (const dvec2& p : ring) point(p, options_.base);
    }
    face(MassPart::floor, {0, 0, -1});
    const std::vector<std::uint32_t> corners = triangulate(plan_, ThinTriangles::keep, &job_);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      triangle(first + corners[i], first + corners[i + 2], first + corners[i + 1]);
    return first;
  }

  // --- Roofs of planes over the whole plan ---

  void add_envelope(const Envelope& envelope) {
    CutPlan cut(plan_, job_);
    for (const PlanLine& line : envelope.cuts) cut.cut(line, job_);
    const std::vector<dvec2>& points = cut.points();
    for (const dvec2& p : points) point(p, options_.eaves + std::max(envelope.height(p), 0.0));
    std::vector<std::vector<std::array<std::uint32_t, 3>>> by_plane(envelope.planes.size());
    for (const auto& t : cut.triangles())
      by_plane[envelope.lowest((points[t[0]] + points[t[1]] + points[t[2]]) / 3.0)].push_back(t);
    for (std::size_t i = 0; i < by_plane.size(); ++i) {
      if (by_plane[i].empty()) continue;
      face(MassPart::roof, math::unit(dvec3(-envelope.planes[i].rise, 1), {0, 0, 1}));
      for (const auto& t : by_plane[i]) triangle(t[0], t[1], t[2]);
    }
    const std::vector<std::uint32_t> next = cut.next_on_border();
    const std::uint32_t bottom = floor();
    std::uint32_t first = 0;
    for (const PlanRing& ring : plan_.rings) {
      const auto count = static_cast<std::uint32_t>(ring.size());
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t from = first + i, to = first + (i + 1) % count;
        std::vector<std::uint32_t> top{from};
        while (top.back() != to && next[top.back()] != top.back() && top.size() <= points.size())
          top.push_back(next[top.back()]);
        wall(bottom + from, bottom + to, top);
      }
      first += count;
    }
  }

  // --- Roofs of rings about the centroid ---

  static std::vector<Ring> dome_rings() {
    std::vector<Ring> rings;
    for (int i = 1; i < rings_of_a_dome; ++i) {
      const math::SinCos at = math::sincos(math::pi / 2 * i / rings_of_a_dome);
      rings.push_back({at.cos, at.sin});
    }
    rings.push_back({0, 1});
    return rings;
  }

  bool add_rings(std::span<const Ring> rings) {
    if (plan_.rings.size() != 1) return false;
    const PlanRing& outline = plan_.rings[0];
    const dvec2 middle = centroid_of(outline);
    const auto count = static_cast<std::uint32_t>(outline.size());
    const double least = visible * diagonal_of(plan_) * diagonal_of(plan_);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (cross(outline[(i + 1) % count] - outline[i], middle - outline[i]) <= least) return false;
    }
    const std::uint32_t bottom = floor();
    std::uint32_t below = point(outline[0], options_.eaves);
    for (std::uint32_t i = 1; i < count; ++i) point(outline[i], options_.eaves);
    for (std::uint32_t i = 0; i < count; ++i)
      wall(bottom + i, bottom + (i + 1) % count, std::array{below + i, below + (i + 1) % count});
    for (const Ring& ring : rings) {
      const auto first = static_cast<std::uint32_t>(mass_.point.size());
      const double height = options_.eaves + ring.height * options_.roof_height;
      const bool is_tip = ring.scale == 0;
      if (is_tip) point(middle, height);
      for (std::uint32_t i = 0; i < count && !is_tip; ++i)
        point(middle + (outline[i] - middle) * ring.scale, height);
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t j = (i + 1) % count;
        const std::uint32_t above = is_tip ? first : first + i;
        const dvec3 &a = mass_.point[below + i], &b = mass_.point[below + j];
        face(MassPart::roof, math::unit(glm::cross(b - a, mass_.point[above] - a), {0, 0, 1}));
        if (!is_tip) triangle(below + i, below + j, first + j);
        triangle(below + i, is_tip ? below + j : first + j, above);
      }
      below = first;
    }
    return true;
  }

  // --- Roofs by the straight skeleton ---

  bool add_skeleton(RoofKind kind) {
    RoofOptions wanted;
    wanted.kind = kind;
    wanted.height = options_.roof_height;
    if (kind == RoofKind::mansard || kind == RoofKind::gambrel) {
      wanted.angle = steep_angle;
      wanted.upper_angle = flat_angle;
    }
    const Roof made = roof(plan_, wanted, job_);
    if (!made.warnings.empty() || !(std::abs(made.height - options_.roof_height) <= 1e-6 * made.height))
      return false;
    for (const dvec3& p : made.point) mass_.point.emplace_back(p.x, -p.z, options_.eaves + p.y);
    for (const RoofFace& each : made.faces) {
      if (each.role == RoofRole::base) continue;
      face(each.role == RoofRole::gable ? MassPart::wall : MassPart::roof,
           {each.normal.x, -each.normal.z, each.normal.y});
      add(triangulate(made, each, &job_), 0);
    }
    for (const RoofFace& each : made.faces) {
      if (each.role == RoofRole::base) add_below(made, each);
    }
    return true;
  }

  void add(std::span<const std::uint32_t> corners, std::uint32_t shift) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      triangle(shift + corners[i], shift + corners[i + 1], shift + corners[i + 2]);
  }

  /// The walls below the base of a roof, and the floor.
  void add_below(const Roof& made, const RoofFace& base) {
    const auto shift = static_cast<std::uint32_t>(mass_.point.size());
    for (const dvec3& p : made.point) mass_.point.emplace_back(p.x, -p.z, options_.base);
    face(MassPart::floor, {0, 0, -1});
    add(triangulate(made, base, &job_), shift);
    const auto walls = [&](const std::vector<std::uint32_t>& loop) {
      // The base faces down, so that its loops run against those of the plan.
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t to = loop[i], from = loop[(i + 1) % loop.size()];
        wall(shift + from, shift + to, std::array{from, to});
      }
    };
    walls(base.outline);
    for (const auto& hole : base.holes) walls(hole);
  }

  const Plan& plan_;
  const MassOptions& options_;
  const Job& job_;
  Mass mass_;
  bool is_strict_ = true;
};

}  // namespace

bool is_closed(const Mass& mass) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ahead, back;
  ahead.reserve(3 * mass.triangles.size());
  back.reserve(3 * mass.triangles.size());
  for (const auto& t : mass.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      ahead.emplace_back(t[i], t[(i + 1) % 3]);
      back.emplace_back(t[(i + 1) % 3], t[i]);
    }
  }
  std::sort(ahead.begin(), ahead.end());
  std::sort(back.begin(), back.end());
  return ahead == back && std::adjacent_find(ahead.begin(), ahead.end()) == ahead.end();
}

Mass mass_of(const Plan& plan, const MassOptions& options, const Job& job) {
  return MassMaker(plan, options, job).make();
}

double roof_height_at(const Plan& plan, const MassOptions& options, double angle, const Job& job) {
  const double slope = math::tan(angle);
  switch (options.roof) {
    case MassRoof::flat:
      return 0;
    case MassRoof::hipped:
    case MassRoof::mansard: {
      RoofOptions hip;
      hip.angle = angle;
      const Roof made = roof(plan, hip, job);
      return made.height > 0 ? made.height : slope * smallest_box(plan).half.y;
    }
    case MassRoof::skillion:
      return slope * width_across(plan, options);
    case MassRoof::saltbox:
      return slope * width_across(plan, options) * saltbox_ridge;
    default:
      return slope * width_across(plan, options) / 2;
  }
}

}  // namespace seedmesh
