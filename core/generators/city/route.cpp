#include "core/generators/city/route.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/city/vectors.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double shortest_dead_end = 1500;  // of a piece that ends at the border, cm
constexpr double least_border_sine = 0.72;  // of the angle between a street and the border
constexpr double least_bridge = 500;        // cm
constexpr double least_rest = 310;          // of a given street at the outline, cm
constexpr double at_start = 3;              // hits nearer than this are those of the start, cm

/// Whether a position on edge `i` of a ring is so near to a corner that the kerbs of a street there would pass it.
bool is_near_bend(const CmRing& ring, std::size_t i, const dvec2& p) {
  constexpr double near = 1500, least_turn = 0.35;  // cm, sine
  const std::size_t count = ring.size();
  for (const std::size_t k : {i, (i + 1) % count}) {
    const dvec2 corner = in_cm(ring[k]);
    if (length_of(p - corner) > near) continue;
    const dvec2 u = corner - in_cm(ring[(k + count - 1) % count]), v = in_cm(ring[(k + 1) % count]) - corner;
    if (std::abs(u.x * v.y - u.y * v.x) > least_turn * length_of(u) * length_of(v) ||
        u.x * v.x + u.y * v.y < 0)
      return true;
  }
  return false;
}

bool is_steep(const OutlineHit& hit) { return hit.sine >= least_border_sine; }

/// The ends of a bridge, and the unit vector from `a` to `b`.
struct Banks {
  CmPoint a, b;
  dvec2 along{0};
};

/// The bridge through `middle`, which is in the water, along a unit vector.
std::optional<Banks> bridge_at(const Region& region, const dvec2& middle, const dvec2& along, double most) {
  const std::vector<OutlineHit> ahead = hits_of(region, middle, middle + along * most);
  if (ahead.empty() || !ahead[0].is_shore || !is_steep(ahead[0])) return std::nullopt;
  const std::vector<OutlineHit> back = hits_of(region, middle, middle - along * most);
  if (back.empty() || !back[0].is_shore || !is_steep(back[0])) return std::nullopt;
  const double length = (ahead[0].share + back[0].share) * most;
  if (length > most || length < least_bridge) return std::nullopt;
  return Banks{rounded_cm(middle - along * (back[0].share * most)),
               rounded_cm(middle + along * (ahead[0].share * most)), along};
}

/// Follows a line and notes what can be built.
class Follower {
 public:
  Follower(const Region& region, std::uint32_t kind, double bridge_length)
      : region_(region), kind_(kind), most_(bridge_length) {}

  Route follow(const std::vector<CmPoint>& line) {
    ahead_.assign(line.rbegin(), line.rend());
    kept_ = {ahead_.back()};
    ahead_.pop_back();
    while (!ahead_.empty()) {
      const CmPoint &at = kept_.back(), &next = ahead_.back();
      const std::vector<OutlineHit> hits = hits_of(region_, in_cm(at), in_cm(next));
      if (hits.empty()) {
        kept_.push_back(next);
        ahead_.pop_back();
        continue;
      }
      if (!hits[0].is_shore) return ended_at_border(at, next, hits[0]);
      if (!cross_water(hits)) return {};
    }
    flush();
    route_.reaches_end = true;
    return std::move(route_);
  }

 private:
  Route ended_at_border(const CmPoint& from, const CmPoint& to, const OutlineHit& hit) {
    const CmPoint end = rounded_cm(in_cm(from) + (in_cm(to) - in_cm(from)) * hit.share);
    if (!is_steep(hit) || !keep_end(end)) return {};
    flush();
    return std::move(route_);
  }

  /// Appends a point on the outline; a last piece that would be too short is joined to the one before.
  bool keep_end(const CmPoint& end) {
    if (kept_.size() > 1 && distance(kept_.back(), end) < shortest_dead_end) kept_.pop_back();
    if (distance(kept_.back(), end) < shortest_dead_end) return false;
    kept_.push_back(end);
    return true;
  }

  /// Builds a bridge from the last kept point to those ahead: where the line crosses the water, or else up to 36 m beside
  /// it, and turned by up to 60 degrees.
  bool cross_water(const std::vector<OutlineHit>& hits) {
    if (most_ < least_bridge) return false;
    const dvec2 start = in_cm(kept_.back()), along = in_cm(ahead_.back()) - start;
    const dvec2 leaves = start + along * hits[0].share;
    const std::optional<dvec2> lands = landing(start, along, hits);
    if (!lands) return false;
    const dvec2 over = *lands - leaves, middle = (leaves + *lands) / 2.0, direct = over / length_of(over);
    for (const double beside : {0.0, 1800.0, -1800.0, 3600.0, -3600.0}) {
      for (const double turned : {0.0, 15.0, -15.0, 30.0, -30.0, 45.0, -45.0, 60.0, -60.0}) {
        const math::SinCos turn = math::sincos_degrees(turned);
        const dvec2 d(direct.x * turn.cos - direct.y * turn.sin, direct.x * turn.sin + direct.y * turn.cos);
        const dvec2 through = middle + dvec2(-direct.y, direct.x) * beside;
        if (beside != 0 && is_on_land(region_, through)) continue;
        const std::optional<Banks> banks = bridge_at(region_, through, d, most_);
        if (banks && build_bridge(*banks)) return true;
      }
    }
    return false;
  }

  /// The position of the far bank, on the segment that meets the water or on a later one. Leaves the points on land behind it
  /// ahead.
  std::optional<dvec2> landing(const dvec2& start, const dvec2& along, const std::vector<OutlineHit>& hits) {
    if (hits.size() > 1)
      return hits[1].is_shore ? std::optional(start + along * hits[1].share) : std::nullopt;
    while (ahead_.size() > 1) {
      const dvec2 a = in_cm(ahead_.back());
      ahead_.pop_back();
      const dvec2 b = in_cm(ahead_.back());
      const std::vector<OutlineHit> later = hits_of(region_, a, b);
      if (later.empty()) continue;
      return later[0].is_shore ? std::optional(a + (b - a) * later[0].share) : std::nullopt;
    }
    return std::nullopt;
  }

  bool build_bridge(const Banks& banks) {
    std::optional<std::vector<CmPoint>> before = to_bank(kept_, banks.a, banks.along);
    if (!before) return false;
    std::optional<std::vector<CmPoint>> after = to_bank(ahead_, banks.b, dvec2(0) - banks.along);
    if (!after) return false;
    kept_ = std::move(*before);
    kept_.push_back(banks.a);
    flush();
    route_.separated.push_back({{banks.a, banks.b}, kind_, 1});
    kept_ = {banks.b};
    ahead_ = std::move(*after);
    return true;
  }

  /// The points of a line up to a bank, the last one nearest to it, without those that the way to the bank skips. The last
  /// piece meets the shore at a steep angle: along the bridge, whose unit vector is `along`, if the direct way does not.
  std::optional<std::vector<CmPoint>> to_bank(std::vector<CmPoint> points, const CmPoint& bank,
                                              const dvec2& along) const {
    const CmPoint head = rounded_cm(in_cm(bank) - along * shortest_dead_end);
    const bool has_head = is_on_land(region_, in_cm(head)) && is_clear(head, bank);
    for (; !points.empty(); points.pop_back()) {
      const CmPoint& last = points.back();
      if (leads_along(last, bank, along, shortest_dead_end) && is_clear(last, bank) &&
          is_steep_at(last, bank))
        return points;
      if (!has_head || !leads_along(last, head, along, least_bridge) ||
          !hits_of(region_, in_cm(last), in_cm(head)).empty())
        continue;
      points.push_back(head);
      return points;
    }
    return std::nullopt;
  }

  /// Whether a segment has at least a length and turns from a unit vector by at most 60 degrees.
  static bool leads_along(const CmPoint& from, const CmPoint& to, const dvec2& along, double least) {
    const dvec2 segment = in_cm(to) - in_cm(from);
    const double length = length_of(segment);
    return length >= least && segment.x * along.x + segment.y * along.y >= length / 2;
  }

  /// Whether a segment from land to a bank stays on land.
  bool is_clear(const CmPoint& land, const CmPoint& bank) const {
    const dvec2 a = in_cm(land), b = in_cm(bank), off = a - b;
    return hits_of(region_, a, b + off * (5 / length_of(off))).empty();
  }

  bool is_steep_at(const CmPoint& land, const CmPoint& bank) const {
    const dvec2 a = in_cm(land), b = in_cm(bank), off = b - a;
    const std::vector<OutlineHit> hits = hits_of(region_, a, b + off * (5 / length_of(off)));
    return !hits.empty() && is_steep(hits[0]);
  }

  void flush() {
    for (std::size_t k = 1; k < kept_.size(); ++k) route_.pieces.push_back({kept_[k - 1], kept_[k], kind_});
    kept_.clear();
  }

  const Region& region_;
  std::uint32_t kind_;
  double most_;
  std::vector<CmPoint> kept_;   ///< points since the last bridge
  std::vector<CmPoint> ahead_;  ///< points of the line, the next one last
  Route route_;
};

}  // namespace

std::vector<OutlineHit> hits_of(const Region& region, const dvec2& a, const dvec2& b) {
  const dvec2 along = b - a;
  const double low_x = std::min(a.x, b.x), high_x = std::max(a.x, b.x), low_y = std::min(a.y, b.y),
               high_y = std::max(a.y, b.y);
  std::vector<OutlineHit> hits;
  for (std::size_t r = 0; r < region.rings.size(); ++r) {
    const CmRing& ring = region.rings[r];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 c = in_cm(ring[i]), d = in_cm(ring[(i + 1) % ring.size()]);
      if (std::max(c.x, d.x) < low_x || std::min(c.x, d.x) > high_x || std::max(c.y, d.y) < low_y ||
          std::min(c.y, d.y) > high_y)
        continue;
      const dvec2 across = d - c, off = c - a;
      const double scale = along.x * across.y - along.y * across.x;
      if (scale == 0) continue;
      const double share = (off.x * across.y - off.y * across.x) / scale;
      const double at = (off.x * along.y - off.y * along.x) / scale;
      if (share * length_of(along) < at_start || share > 1 || at < 0 || at > 1) continue;
      double sine = std::abs(scale) / (length_of(along) * length_of(across));
      if (is_near_bend(ring, i, a + along * share)) sine = 0;
      hits.push_back({share, sine, region.is_shore[r][i] != 0});
    }
  }
  std::sort(hits.begin(), hits.end(), [](const auto& u, const auto& v) { return u.share < v.share; });
  // A corner of the outline is met on both of its edges.
  const auto same = [](const auto& u, const auto& v) { return v.share - u.share < 1e-9; };
  hits.erase(std::unique(hits.begin(), hits.end(), same), hits.end());
  return hits;
}

Route route_of(const Region& region, const std::vector<CmPoint>& line, std::uint32_t kind,
               double bridge_length) {
  return Follower(region, kind, bridge_length).follow(line);
}

Route given_route(const Region& region, const std::vector<CmPoint>& line, std::uint32_t kind) {
  Route route;
  CmRing over;  // since the last shore
  for (std::size_t i = 1; i < line.size(); ++i) {
    const dvec2 a = in_cm(line[i - 1]), b = in_cm(line[i]);
    const std::vector<OutlineHit> hits = hits_of(region, a, b);
    CmPoint from = line[i - 1];
    for (std::size_t k = 0; k <= hits.size(); ++k) {
      const bool is_end = k == hits.size();
      const CmPoint to = is_end ? line[i] : rounded_cm(a + (b - a) * hits[k].share);
      if (distance(from, to) < at_start) continue;
      // A short rest at the outline would be too short for a street.
      const bool is_rest = distance(from, to) < least_rest && (!is_end || k > 0);
      if (is_rest) {
        from = to;
        continue;
      }
      if (is_on_land(region, (in_cm(from) + in_cm(to)) / 2.0)) {
        route.pieces.push_back({from, to, kind});
        over.clear();
        if (!is_end && hits[k].is_shore) over = {to};
      } else if (!over.empty()) {
        over.push_back(to);
        if (!is_end && hits[k].is_shore) route.separated.push_back({over, kind, 1});
        if (!is_end) over.clear();
      }
      from = to;
    }
  }
  return route;
}

bool meets_separated(const Route& route, const std::vector<SeparatedLine>& separated) {
  const auto meet = [](const CmRing& a, const CmRing& b) {
    for (std::size_t i = 1; i < a.size(); ++i) {
      for (std::size_t k = 1; k < b.size(); ++k) {
        if (segments_meet(a[i - 1], a[i], b[k - 1], b[k])) return true;
      }
    }
    return false;
  };
  return std::any_of(route.separated.begin(), route.separated.end(), [&](const SeparatedLine& own) {
    return std::any_of(separated.begin(), separated.end(), [&](const SeparatedLine& other) {
      return own.level == other.level && meet(own.line, other.line);
    });
  });
}

}  // namespace seedmesh::city
