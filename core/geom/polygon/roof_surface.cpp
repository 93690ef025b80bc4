#include "core/geom/polygon/roof_surface.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/rng.h"
#include "core/geom/polygon/near_groups.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// The share of the diagonal by which points are moved if a skeleton fails, and the number of attempts.
constexpr double jitter_share = 1e-6;
constexpr int most_attempts = 3;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

Plan jittered(const Plan& plan, int round, double share) {
  if (round == 0) return plan;
  Plan moved = plan;
  const double reach = share * diagonal_of(plan);
  std::uint64_t place = 0;
  for (PlanRing& ring : moved.rings) {
    for (dvec2& p : ring) {
      Rng rng = Rng(static_cast<std::uint64_t>(round)).at(place++);
      const double x = rng.uniform(-reach, reach);
      p += dvec2(x, rng.uniform(-reach, reach));
    }
  }
  return moved;
}

/// One stage over one plan; `node` has the points of the plan in the surface.
class Stages {
 public:
  Stages(const RoofBase& base, const std::vector<RoofStage>& stages, double jitter, const Job& job)
      : stages_(stages), jitter_(jitter), job_(job) {
    std::vector<std::uint32_t> node;
    for (const PlanRing& ring : base.plan.rings) {
      for (const dvec2& p : ring) {
        node.push_back(static_cast<std::uint32_t>(surface.point.size()));
        surface.point.emplace_back(p, base.height);
      }
    }
    is_sound = run(base, node, 0);
  }

  RoofSurface surface;
  bool is_sound = false;

 private:
  bool run(const RoofBase& base, const std::vector<std::uint32_t>& node, std::size_t stage) {
    if (stage == stages_.size()) {
      add_level(base, node);
      return true;
    }
    std::vector<double> speed;
    for (const std::uint32_t edge : base.source) speed.push_back(stages_[stage].speed[edge]);
    StraightSkeleton skeleton;
    for (int round = jitter_ > 0 ? 1 : 0; round <= most_attempts && !skeleton.is_sound; ++round) {
      const Plan moved = jittered(base.plan, round, std::max(jitter_, jitter_share));
      skeleton = straight_skeleton(moved, {speed, stages_[stage].rise}, job_);
    }
    if (!skeleton.is_sound) return false;
    std::vector<std::uint32_t> number = node;
    for (std::size_t i = node.size(); i < skeleton.node.size(); ++i) {
      number.push_back(static_cast<std::uint32_t>(surface.point.size()));
      surface.point.push_back(skeleton.node[i] + dvec3(0, 0, base.height));
    }
    const auto renumber = [&](std::vector<std::uint32_t>& loop) {
      for (std::uint32_t& i : loop) i = number[i];
    };
    for (SkeletonFace& face : skeleton.faces) {
      const auto [from, to] = edge_of(base.plan, face.edge);
      RoofSurface::Face added;
      added.edge = base.source[face.edge];
      added.speed = face.is_step ? 0 : speed[face.edge];
      added.direction = (to - from) / glm::length(to - from);
      if (face.is_step) added.direction = step_direction(skeleton, face);
      added.outline = std::move(face.outline);
      added.holes = std::move(face.holes);
      renumber(added.outline);
      for (auto& hole : added.holes) renumber(hole);
      surface.faces.push_back(std::move(added));
    }
    return go_on(base, skeleton, number, stage);
  }

  static dvec2 step_direction(const StraightSkeleton& skeleton, const SkeletonFace& face) {
    dvec2 widest{1, 0};
    double best = 0;
    const dvec2 first(skeleton.node[face.outline[0]]);
    double twice = 0;
    for (const std::uint32_t node : face.outline) {
      const dvec2 apart = dvec2(skeleton.node[node]) - first;
      if (glm::length(apart) <= best) continue;
      best = glm::length(apart);
      widest = apart / best;
    }
    const auto flat = [&](std::size_t i) {
      const dvec3 p = skeleton.node[face.outline[i % face.outline.size()]];
      return dvec2(glm::dot(widest, dvec2(p) - first), p.z);
    };
    for (std::size_t i = 0; i < face.outline.size(); ++i) twice += cross(flat(i), flat(i + 1));
    return twice < 0 ? -widest : widest;
  }

  /// Runs the next stage on the rest of this one.
  bool go_on(const RoofBase& base, const StraightSkeleton& skeleton, const std::vector<std::uint32_t>& number,
             std::size_t stage) {
    struct Left {
      RoofBase base;
      std::vector<std::uint32_t> node;
    };
    std::vector<Left> parts;
    const auto add = [&](Left& left, const SkeletonFront& front, const PlanRing& ring) {
      left.base.plan.rings.push_back(ring);
      for (std::size_t i = 0; i < front.node.size(); ++i) {
        left.node.push_back(number[front.node[i]]);
        left.base.source.push_back(base.source[front.edge[i]]);
      }
    };
    std::vector<std::pair<PlanRing, const SkeletonFront*>> holes;
    for (const SkeletonFront& front : skeleton.fronts) {
      PlanRing ring;
      for (const std::uint32_t node : front.node) ring.emplace_back(skeleton.node[node]);
      if (signed_area(ring) <= 0) {
        holes.emplace_back(std::move(ring), &front);
        continue;
      }
      parts.emplace_back();
      parts.back().base.height = base.height + stages_[stage].rise;
      add(parts.back(), front, ring);
    }
    for (const auto& [ring, front] : holes) {
      const auto owner = std::find_if(parts.begin(), parts.end(), [&, first = ring[0]](const Left& left) {
        return contains(Plan{{left.base.plan.rings[0]}}, first);
      });
      if (owner == parts.end()) return false;
      add(*owner, *front, ring);
    }
    return std::all_of(parts.begin(), parts.end(),
                       [&](const Left& left) { return run(left.base, left.node, stage + 1); });
  }

  void add_level(const RoofBase& base, const std::vector<std::uint32_t>& node) {
    RoofSurface::Face level;
    std::size_t first = 0;
    for (const PlanRing& ring : base.plan.rings) {
      const auto at = node.begin() + static_cast<std::ptrdiff_t>(first);
      std::vector<std::uint32_t> loop(at, at + static_cast<std::ptrdiff_t>(ring.size()));
      if (first == 0) {
        level.outline = std::move(loop);
      } else {
        level.holes.push_back(std::move(loop));
      }
      first += ring.size();
    }
    surface.faces.push_back(std::move(level));
  }

  const std::vector<RoofStage>& stages_;
  const double jitter_;
  const Job& job_;
};

}  // namespace

std::optional<RoofSurface> sloped_surface(const RoofBase& base, const std::vector<RoofStage>& stages,
                                          double jitter, const Job& job) {
  Stages made(base, stages, jitter, job);
  if (!made.is_sound) return std::nullopt;
  return std::move(made.surface);
}

std::optional<RoofSurface> fan_surface(const RoofBase& base, const dvec3& apex) {
  if (base.plan.rings.size() != 1) return std::nullopt;
  const PlanRing& ring = base.plan.rings[0];
  const double least = 1e-6 * diagonal_of(base.plan);
  RoofSurface surface;
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (const dvec2& p : ring) surface.point.emplace_back(p, base.height);
  surface.point.push_back(apex);
  for (std::uint32_t i = 0; i < count; ++i) {
    const dvec2 a = ring[i], b = ring[(i + 1) % count], along = (b - a) / glm::length(b - a);
    const double reach = cross(along, dvec2(apex) - a);
    if (!(reach > least)) return std::nullopt;
    surface.faces.push_back(
        {base.source[i], reach / (apex.z - base.height), along, {i, (i + 1) % count, count}, {}});
  }
  return surface;
}

RoofSurface plane_surface(const RoofBase& base, const RoofPlane& plane) {
  RoofSurface surface;
  const dvec2 up{-plane.direction.y, plane.direction.x};
  std::vector<std::uint32_t> below, above;
  std::vector<dvec3> high;
  for (const PlanRing& ring : base.plan.rings) {
    for (const dvec2& p : ring) {
      const double height = glm::dot(up, p - plane.at) * plane.tangent;
      below.push_back(static_cast<std::uint32_t>(surface.point.size()));
      surface.point.emplace_back(p, plane.is_bare ? height : base.height);
      high.emplace_back(p, height);
    }
  }
  above = below;
  for (std::size_t i = 0; i < below.size() && !plane.is_bare; ++i) {
    if (high[i].z - base.height < 1e-9 * diagonal_of(base.plan)) continue;
    above[i] = static_cast<std::uint32_t>(surface.point.size());
    surface.point.push_back(high[i]);
  }
  RoofSurface::Face slope;
  slope.edge = plane.edge;
  slope.speed = plane.tangent > 0 ? 1 / plane.tangent : 0;
  if (!(plane.tangent > 0)) slope.edge = RoofSurface::none;
  slope.direction = plane.direction;
  std::uint32_t first = 0;
  for (const PlanRing& ring : base.plan.rings) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    std::vector<std::uint32_t> loop;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % count;
      loop.push_back(above[a]);
      RoofSurface::Face wall{base.source[a], 0, {1, 0}, {below[a], below[b]}, {}};
      if (above[b] != below[b]) wall.outline.push_back(above[b]);
      if (above[a] != below[a]) wall.outline.push_back(above[a]);
      const dvec2 along = ring[(i + 1) % count] - ring[i];
      wall.direction = along / glm::length(along);
      if (wall.outline.size() > 2) surface.faces.push_back(std::move(wall));
    }
    if (first == 0) {
      slope.outline = std::move(loop);
    } else {
      slope.holes.push_back(std::move(loop));
    }
    first += count;
  }
  surface.faces.insert(surface.faces.begin(), std::move(slope));
  return surface;
}

void weld(RoofSurface& surface, double reach, const Job& job) {
  const std::vector<std::uint32_t> same = near_groups(surface.point, reach, job);
  const auto renumber = [&](std::vector<std::uint32_t>& loop) {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t i : loop) {
      if (kept.empty() || kept.back() != same[i]) kept.push_back(same[i]);
    }
    while (kept.size() > 1 && kept.back() == kept.front()) kept.pop_back();
    loop = std::move(kept);
  };
  for (RoofSurface::Face& face : surface.faces) {
    renumber(face.outline);
    for (auto& hole : face.holes) renumber(hole);
    std::erase_if(face.holes, [](const auto& hole) { return hole.size() < 3; });
  }
  std::erase_if(surface.faces, [](const RoofSurface::Face& face) { return face.outline.size() < 3; });
}

std::vector<std::vector<std::uint32_t>> lower_rings(const RoofSurface& surface, const RoofBase& base) {
  std::map<std::uint32_t, std::uint32_t> next;
  const auto walk = [&](const std::vector<std::uint32_t>& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      if (surface.point[a].z == base.height && surface.point[b].z == base.height) next[a] = b;
    }
  };
  for (const RoofSurface::Face& face : surface.faces) {
    if (face.edge == RoofSurface::none && surface.point[face.outline[0]].z == base.height) continue;
    walk(face.outline);
    for (const auto& hole : face.holes) walk(hole);
  }
  std::vector<std::vector<std::uint32_t>> rings;
  std::uint32_t first = 0;
  for (const PlanRing& ring : base.plan.rings) {
    std::vector<std::uint32_t> loop;
    std::uint32_t at = first;
    while (at < first + ring.size() && !next.count(at)) ++at;
    first += static_cast<std::uint32_t>(ring.size());
    if (at >= first) continue;
    for (std::uint32_t to = at; next.count(to) && loop.size() <= next.size();) {
      loop.push_back(to);
      to = next[to];
      if (to == at) break;
    }
    if (loop.size() > 2) rings.push_back(std::move(loop));
  }
  return rings;
}

// rise / (rise + (way - rise / steep) * flat) = share, solved for the rise.
double break_at(double share, double depth, double steep, double flat) {
  share = std::min(share, 1.0);
  return share * depth * flat / (1 - share + share * flat / steep);
}

double height_of(const RoofSurface& surface) {
  double highest = surface.point.empty() ? 0 : surface.point[0].z;
  for (const dvec3& p : surface.point) highest = std::max(highest, p.z);
  return highest;
}

}  // namespace seedmesh
