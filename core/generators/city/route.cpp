#include "core/generators/city/route.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double shortest_dead_end = 1500;  // of a piece that ends at the border, cm
constexpr double least_border_sine = 0.72;  // of the angle between a street and the border
constexpr double least_bridge = 500;        // cm
constexpr double least_rest = 310;          // of a given street at the outline, cm
constexpr double at_start = 3;              // hits nearer than this are those of the start, cm

double length_of(const dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

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

struct Banks {
  CmPoint a, b;
};

/// A bridge through `middle`, which is in the water, along the direction or turned from it by up to 60 degrees.
std::optional<Banks> bridge_at(const Region& region, const dvec2& middle, const dvec2& direction,
                               double most) {
  for (const double turned : {0.0, 12.0, -12.0, 24.0, -24.0, 36.0, -36.0, 48.0, -48.0, 60.0, -60.0}) {
    const math::SinCos turn = math::sincos_degrees(turned);
    const dvec2 d(direction.x * turn.cos - direction.y * turn.sin,
                  direction.x * turn.sin + direction.y * turn.cos);
    const std::vector<OutlineHit> ahead = hits_of(region, middle, middle + d * most),
                                  back = hits_of(region, middle, middle - d * most);
    if (ahead.empty() || back.empty() || !ahead[0].is_shore || !back[0].is_shore) continue;
    if (!is_steep(ahead[0]) || !is_steep(back[0])) continue;
    const double length = (ahead[0].share + back[0].share) * most;
    if (length > most || length < least_bridge) continue;
    return Banks{rounded_cm(middle - d * (back[0].share * most)),
                 rounded_cm(middle + d * (ahead[0].share * most))};
  }
  return std::nullopt;
}

/// Follows a line and notes what can be built.
class Follower {
 public:
  Follower(const Region& region, std::uint32_t kind, double bridge_length)
      : region_(region), kind_(kind), most_(bridge_length) {}

  Route follow(const std::vector<CmPoint>& line) {
    kept_ = {line[0]};
    CmPoint at = line[0];
    for (std::size_t i = 1; i < line.size();) {
      const std::vector<OutlineHit> hits = hits_of(region_, in_cm(at), in_cm(line[i]));
      if (hits.empty()) {
        at = line[i++];
        kept_.push_back(at);
        continue;
      }
      if (!hits[0].is_shore) return ended_at_border(at, line[i], hits[0]);
      const auto after = cross_water(line, i, at, hits);
      if (!after) return {};
      i = after->first;
      at = after->second;
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

  /// The number of the next corner on land behind the water, and the position of the bank.
  std::optional<std::pair<std::size_t, CmPoint>> cross_water(const std::vector<CmPoint>& line, std::size_t i,
                                                             const CmPoint& at,
                                                             const std::vector<OutlineHit>& hits) {
    if (most_ < least_bridge) return std::nullopt;
    const dvec2 start = in_cm(at), along = in_cm(line[i]) - start;
    const dvec2 leaves = start + along * hits[0].share;
    // The far bank lies on this segment or on a later one.
    dvec2 lands{0};
    std::size_t next = i;
    bool has_landed = false;
    if (hits.size() > 1) {
      if (!hits[1].is_shore) return std::nullopt;
      lands = start + along * hits[1].share;
      has_landed = true;
    }
    while (!has_landed && ++next < line.size()) {
      const dvec2 a = in_cm(line[next - 1]), b = in_cm(line[next]);
      const std::vector<OutlineHit> later = hits_of(region_, a, b);
      if (later.empty()) continue;
      if (!later[0].is_shore) return std::nullopt;
      lands = a + (b - a) * later[0].share;
      has_landed = true;
    }
    if (!has_landed) return std::nullopt;
    const dvec2 over = lands - leaves;
    const auto banks = bridge_at(region_, (leaves + lands) / 2.0, over / length_of(over), most_);
    if (!banks) return std::nullopt;
    while (next + 1 < line.size() && distance(banks->b, line[next]) < shortest_dead_end) ++next;
    if (!keep_end(banks->a) || !is_clear(kept_[kept_.size() - 2], banks->a) ||
        !is_clear(line[next], banks->b) || distance(banks->b, line[next]) < shortest_dead_end)
      return std::nullopt;
    flush();
    route_.bridges.push_back({{banks->a, banks->b}, kind_, 1});
    kept_ = {banks->b};
    return std::pair{next, banks->b};
  }

  /// Whether a segment from land to a bank stays on land.
  bool is_clear(const CmPoint& land, const CmPoint& bank) const {
    const dvec2 a = in_cm(land), b = in_cm(bank), off = a - b;
    return hits_of(region_, a, b + off * (5 / length_of(off))).empty();
  }

  void flush() {
    for (std::size_t k = 1; k < kept_.size(); ++k) route_.pieces.push_back({kept_[k - 1], kept_[k], kind_});
    kept_.clear();
  }

  const Region& region_;
  std::uint32_t kind_;
  double most_;
  std::vector<CmPoint> kept_;
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
        if (!is_end && hits[k].is_shore) route.bridges.push_back({over, kind, 1});
        if (!is_end) over.clear();
      }
      from = to;
    }
  }
  return route;
}

bool meets_bridges(const Route& route, const std::vector<BridgeLine>& bridges) {
  const auto meet = [](const CmRing& a, const CmRing& b) {
    for (std::size_t i = 1; i < a.size(); ++i) {
      for (std::size_t k = 1; k < b.size(); ++k) {
        if (segments_meet(a[i - 1], a[i], b[k - 1], b[k])) return true;
      }
    }
    return false;
  };
  return std::any_of(route.bridges.begin(), route.bridges.end(), [&](const BridgeLine& own) {
    return std::any_of(bridges.begin(), bridges.end(), [&](const BridgeLine& other) {
      return own.level == other.level && meet(own.line, other.line);
    });
  });
}

}  // namespace seedmesh::city
