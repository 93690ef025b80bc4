#include "core/geom/polygon/roof.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <span>

#include "core/base/math.h"
#include "core/geom/polygon/roof_surface.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// The steep part of a two-slope roof takes this share of the way inwards unless its height is given.
constexpr double steep_share = 0.3;
constexpr double plain_thickness = 0.12;
/// Shares of the diagonal: nearer points become one, and points of the plan are moved by up to the jitter first.
struct Attempt {
  double weld = 2e-6, jitter = 0;
};
// Until a roof is closed. Near-parallel edges make slopes that are thin or end almost at the same point.
constexpr Attempt attempts[] = {{2e-6, 0},    {2e-5, 0},    {2e-4, 0},    {2e-7, 0},    {1e-3, 0},
                                {2e-6, 1e-5}, {2e-5, 1e-4}, {2e-6, 1e-4}, {2e-6, 1e-3}, {2e-5, 1e-3}};
/// The edges of plans in the attempts before the last one. Spikes that need more are too thin for a roof.
constexpr std::size_t most_edges = 8'000;
// The distance of the underside of the cover below the slopes, or above them at a wall, so that no faces coincide.
constexpr double sunk = 0.02;
constexpr double lifted = 0.002;
// Angles nearer to the vertical are vertical.
constexpr double upright = 1e-6;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

class RoofMaker {
 public:
  RoofMaker(const Plan& plan, const RoofOptions& options, const Attempt& attempt, const Job& job)
      : plan_(plan), options_(options), attempt_(attempt), job_(job), count_(edge_count(plan)) {
    base_.plan = plan;
    for (std::uint32_t i = 0; i < count_; ++i) base_.source.push_back(i);
  }

  Roof make(const std::vector<PlanDefect>& defects) {
    drop_ = 0;
    outward_.assign(count_, 0);
    std::optional<RoofSurface> body;
    if (!defects.empty())
      roof_.warnings.push_back("no roof can be made over this outline: " + defects[0].message);
    switch (defects.empty() ? options_.kind : RoofKind::flat) {
      case RoofKind::flat:
        break;
      case RoofKind::shed:
        body = shed();
        break;
      case RoofKind::pyramid:
        body = pyramid();
        break;
      default:
        body = slopes();
        break;
    }
    if (body) {
      add_body(*body);
      roof_.height = height_of(*body);
    } else {
      is_flat_ = true;
      outward_.assign(count_, options_.overhang);
      drop_ = 0;
      RoofPlane level;
      level.is_bare = true;
      body = plane_surface(base_, level);
      add_faces(*body, false, 0);
    }
    const bool has_cover = options_.overhang > 0 || options_.verge > 0 || options_.thickness > 0;
    if (has_cover && defects.empty()) add_cover();
    return std::move(roof_);
  }

  /// Whether the roof has the requested slopes.
  bool has_slopes() const { return !is_flat_; }

 private:
  double tangent_of(double angle) const { return math::tan(angle); }

  // --- Bodies ---

  std::optional<RoofSurface> slopes() {
    const bool has_ends = options_.kind == RoofKind::gable || options_.kind == RoofKind::gambrel;
    const bool is_double = options_.kind == RoofKind::mansard || options_.kind == RoofKind::gambrel;
    is_end_.assign(count_, false);
    if (has_ends) {
      for (const std::uint32_t edge : options_.gables.empty() ? gable_edges(plan_, job_) : options_.gables) {
        if (edge < count_) is_end_[edge] = true;
      }
    }
    stages_ = {stage_of(options_.angle)};
    if (is_double) {
      double rise = options_.break_height;
      if (!(rise > 0) || options_.height) {
        const auto once = sloped_surface(base_, {stage_of(math::pi / 4)}, attempt_.jitter, job_);
        if (!once) return std::nullopt;
        const double way = height_of(*once), steep = tangent_of(options_.angle);
        rise = rise > 0 ? break_at(rise / *options_.height, way, steep, tangent_of(options_.upper_angle))
                        : steep_share * way * steep;
      }
      stages_[0].rise = rise;
      stages_.push_back(stage_of(options_.upper_angle));
    }
    std::optional<RoofSurface> body;
    if (options_.height) {
      body = sloped_surface(base_, stages_, attempt_.jitter, job_);
      if (!body || !(height_of(*body) > 0)) return std::nullopt;
      const double factor = *options_.height / height_of(*body);
      for (RoofStage& stage : stages_) {
        for (double& speed : stage.speed) speed /= factor;
        stage.rise *= factor;
      }
    }
    if (options_.flat_top) cut_at(*options_.flat_top);
    body = sloped_surface(base_, stages_, attempt_.jitter, job_);
    if (!body) return body;
    const double first_tangent = options_.height ? 1 / slowest_speed() : tangent_of(options_.angle);
    lean_outwards(first_tangent);
    return body;
  }

  double slowest_speed() const {
    double speed = 1e300;
    for (const double each : stages_[0].speed) {
      if (each > 0) speed = std::min(speed, each);
    }
    return speed;
  }

  RoofStage stage_of(double angle) const {
    RoofStage stage;
    for (std::uint32_t i = 0; i < count_; ++i) {
      const double own = options_.edge_angles.size() == count_ ? options_.edge_angles[i] : angle;
      const bool is_upright = is_end_[i] || own > math::pi / 2 - upright;
      stage.speed.push_back(is_upright ? 0 : 1 / tangent_of(own));
    }
    return stage;
  }

  void cut_at(double height) {
    double so_far = 0;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      if (so_far + stages_[i].rise >= height) {
        stages_[i].rise = height - so_far;
        stages_.resize(i + 1);
        return;
      }
      so_far += stages_[i].rise;
    }
  }

  /// The distance of the cover beyond each edge: slopes continue downwards, ends horizontally.
  void lean_outwards(double tangent) {
    drop_ = options_.overhang * tangent / std::sqrt(1 + tangent * tangent);
    for (std::uint32_t i = 0; i < count_; ++i) {
      const double speed = stages_[0].speed[i];
      outward_[i] = speed > 0 ? drop_ * speed : options_.verge;
    }
  }

  std::optional<RoofSurface> pyramid() {
    for (const dvec2 middle : {average(), centroid_of(plan_.rings[0])}) {
      const auto [a, b] = edge_of(plan_, 0);
      const double reach = cross((b - a) / glm::length(b - a), middle - a);
      const double height = options_.height ? *options_.height : reach * tangent_of(options_.angle);
      apex_ = {middle, height};
      auto body = height > 0 ? fan_surface(base_, apex_) : std::nullopt;
      if (!body) continue;
      const double tangent = height / std::max(reach, 1e-300);
      drop_ = options_.overhang * tangent / std::sqrt(1 + tangent * tangent);
      for (std::uint32_t i = 0; i < count_; ++i) outward_[i] = drop_ * body->faces[i].speed;
      is_fan_ = true;
      return body;
    }
    roof_.warnings.emplace_back("no point sees the whole plan, so the pyramid is a hip roof");
    is_end_.assign(count_, false);
    return slopes();
  }

  dvec2 average() const {
    dvec2 sum{0};
    for (const dvec2& p : plan_.rings[0]) sum += p;
    return sum / static_cast<double>(plan_.rings[0].size());
  }

  std::optional<RoofSurface> shed() {
    const auto [a, b] = edge_of(plan_, std::min(options_.low_edge, count_ - 1));
    plane_.direction = (b - a) / glm::length(b - a);
    plane_.edge = std::min(options_.low_edge, count_ - 1);
    const dvec2 up{-plane_.direction.y, plane_.direction.x};
    double low = 0, high = 0;
    for (const dvec2& p : plan_.rings[0]) {
      low = std::min(low, glm::dot(up, p - a));
      high = std::max(high, glm::dot(up, p - a));
    }
    plane_.at = a + up * low;
    plane_.tangent = options_.height ? *options_.height / (high - low) : tangent_of(options_.angle);
    const double slope = std::sqrt(1 + plane_.tangent * plane_.tangent);
    for (std::uint32_t i = 0; i < count_; ++i) {
      const auto [from, to] = edge_of(plan_, i);
      const double turn = glm::dot(plane_.direction, (to - from) / glm::length(to - from));
      outward_[i] = std::abs(turn) > 0.7 ? options_.overhang / slope : options_.verge;
    }
    is_plane_ = true;
    return plane_surface(base_, plane_);
  }

  // --- The cover ---

  void add_cover() {
    const double thickness = options_.thickness > 0 ? options_.thickness : plain_thickness;
    RoofBase wide = base_;
    if (std::any_of(outward_.begin(), outward_.end(), [](double d) { return d > 0; })) {
      std::vector<DerivedPlan> plans = outset(plan_, outward_, job_);
      if (plans.size() == 1) {
        wide.plan = std::move(plans[0].plan);
        wide.source = std::move(plans[0].source);
      }
    }
    wide.height = -drop_;
    std::optional<RoofSurface> surface;
    if (is_flat_ || is_plane_) {
      plane_.is_bare = true;
      surface = plane_surface(wide, plane_);
    } else if (is_fan_) {
      surface = fan_surface(wide, apex_);
    } else {
      std::vector<RoofStage> stages = stages_;
      stages[0].rise += drop_;
      surface = sloped_surface(wide, stages, attempt_.jitter, job_);
    }
    if (!surface) {
      roof_.warnings.emplace_back("the roof cannot have an overhang, so it ends at the walls");
      return;
    }
    weld(*surface, attempt_.weld * diagonal_of(plan_), job_);
    std::erase_if(surface->faces, [](const RoofSurface::Face& face) {
      return face.speed == 0 && face.edge != RoofSurface::none;
    });
    add_shell(*surface, thickness);
    roof_.height = std::max(roof_.height, height_of(*surface) + thickness);
  }

  /// The surface twice, the lower one facing down, and the edge between them.
  void add_shell(const RoofSurface& surface, double thickness) {
    const auto bottom = static_cast<std::uint32_t>(roof_.point.size());
    const auto shift = static_cast<std::uint32_t>(surface.point.size());
    const bool ends_at_wall =
        std::any_of(outward_.begin(), outward_.end(), [](double d) { return !(d > sunk); });
    const double low = ends_at_wall ? std::min(lifted, 0.1 * thickness) : -std::min(sunk, thickness);
    for (const double lift : {low, thickness}) {
      for (const dvec3& p : surface.point) roof_.point.push_back(raised(dvec2(p), p.z + lift));
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> border;
    const auto walk = [&](const std::vector<std::uint32_t>& loop, std::uint32_t edge) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        if (border.erase({b, a}) == 0) border.emplace(std::pair{a, b}, edge);
      }
    };
    for (const RoofSurface::Face& face : surface.faces) {
      walk(face.outline, face.edge);
      for (const auto& hole : face.holes) walk(hole, face.edge);
      RoofFace top = roof_face(face, true);
      RoofFace below = top;
      for (auto* loop : loops_of(top)) {
        for (std::uint32_t& i : *loop) i += bottom + shift;
      }
      for (auto* loop : loops_of(below)) {
        for (std::uint32_t& i : *loop) i += bottom;
        std::reverse(loop->begin(), loop->end());
      }
      below.role = RoofRole::soffit;
      below.normal = -below.normal;
      below.along = -below.along;
      roof_.faces.push_back(std::move(top));
      roof_.faces.push_back(std::move(below));
    }
    for (const auto& [ends, edge] : border) {
      const auto [a, b] = ends;
      const dvec2 along = dvec2(surface.point[b]) - dvec2(surface.point[a]);
      RoofFace side;
      side.role = RoofRole::fascia;
      side.is_cover = true;
      side.edge = edge;
      side.outline = {bottom + a, bottom + b, bottom + shift + b, bottom + shift + a};
      side.along = math::unit(raised(along, 0), {1, 0, 0});
      side.normal = glm::cross(side.along, dvec3(0, 1, 0));
      roof_.faces.push_back(std::move(side));
    }
  }

  // --- Faces ---

  static std::vector<std::vector<std::uint32_t>*> loops_of(RoofFace& face) {
    std::vector<std::vector<std::uint32_t>*> loops{&face.outline};
    for (auto& hole : face.holes) loops.push_back(&hole);
    return loops;
  }

  static RoofFace roof_face(const RoofSurface::Face& face, bool is_cover) {
    RoofFace made;
    const bool is_level = face.edge == RoofSurface::none;
    made.role = face.speed == 0 && !is_level ? RoofRole::gable : RoofRole::slope;
    made.is_cover = is_cover;
    made.edge = is_level ? RoofFace::none : face.edge;
    made.outline = face.outline;
    made.holes = face.holes;
    if (is_level) return made;
    made.along = raised(face.direction, 0);
    const dvec2 inwards{-face.direction.y, face.direction.x};
    made.normal = math::unit(glm::cross(made.along, raised(inwards * face.speed, 1)), {0, 1, 0});
    return made;
  }

  void add_body(RoofSurface& surface) {
    weld(surface, attempt_.weld * diagonal_of(plan_), job_);
    const auto first = static_cast<std::uint32_t>(roof_.point.size());
    add_faces(surface, false, first);
    RoofFace base;
    base.role = RoofRole::base;
    base.normal = {0, -1, 0};
    // The base has the points of the lower border of the surface, where it meets the walls.
    std::vector<std::vector<std::uint32_t>> rings = lower_rings(surface, base_);
    for (auto& ring : rings) {
      std::reverse(ring.begin(), ring.end());
      for (std::uint32_t& i : ring) i += first;
    }
    if (rings.empty()) return;
    base.outline = std::move(rings[0]);
    base.holes.assign(std::make_move_iterator(rings.begin() + 1), std::make_move_iterator(rings.end()));
    roof_.faces.push_back(std::move(base));
  }

  void add_faces(const RoofSurface& surface, bool is_cover, std::uint32_t first) {
    for (const dvec3& p : surface.point) roof_.point.push_back(raised(dvec2(p), p.z));
    for (const RoofSurface::Face& face : surface.faces) {
      RoofFace made = roof_face(face, is_cover);
      for (auto* loop : loops_of(made)) {
        for (std::uint32_t& i : *loop) i += first;
      }
      roof_.faces.push_back(std::move(made));
    }
  }

  const Plan& plan_;
  const RoofOptions& options_;
  const Attempt attempt_;
  const Job& job_;
  std::uint32_t count_;
  RoofBase base_;
  Roof roof_;
  std::vector<RoofStage> stages_;
  std::vector<bool> is_end_;
  std::vector<double> outward_;  ///< of the cover, by edge
  double drop_ = 0;              ///< of the cover below the walls' end
  bool is_fan_ = false, is_plane_ = false, is_flat_ = false;
  dvec3 apex_{0};
  RoofPlane plane_;
};

}  // namespace

Roof roof(const Plan& plan, const RoofOptions& options, const Job& job) {
  const std::vector<PlanDefect> defects = defects_of(plan, &job);
  if (!defects.empty() || options.kind == RoofKind::flat)
    return RoofMaker(plan, options, attempts[0], job).make(defects);
  std::optional<Roof> bare;  // closed except for its cover
  double without_slopes = -1;
  const std::size_t most = 1 + most_edges / edge_count(plan);
  for (const Attempt& attempt : std::span(attempts).first(std::min(most, std::size(attempts)))) {
    if (attempt.jitter == without_slopes) continue;  // slopes do not depend on the weld
    RoofMaker maker(plan, options, attempt, job);
    Roof made = maker.make(defects);
    if (!maker.has_slopes()) without_slopes = attempt.jitter;
    if (!maker.has_slopes() || !is_closed(made, false, job)) continue;
    if (is_closed(made, true, job)) return made;
    if (!bare) bare = std::move(made);
  }
  if (bare) {
    std::erase_if(bare->faces, [](const RoofFace& face) { return face.is_cover; });
    bare->warnings.emplace_back("the roof cannot have an overhang, so it ends at the walls");
    return *std::move(bare);
  }
  RoofOptions level = options;
  level.kind = RoofKind::flat;
  Roof made = RoofMaker(plan, level, attempts[0], job).make(defects);
  made.warnings.emplace_back("no roof of this kind can be made over this plan, so the roof is flat");
  return made;
}

}  // namespace seedmesh
