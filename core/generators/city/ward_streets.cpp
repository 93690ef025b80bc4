#include "core/generators/city/ward_streets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <queue>
#include <set>

#include "core/base/math.h"
#include "core/generators/city/landform.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double piece_length = 2400;      // of a street that others can join, cm
constexpr double least_gate_space = 7000;  // between two gates, cm
constexpr double along_wall = 2.5;         // how much longer a path along the wall counts
constexpr std::uint32_t major = static_cast<std::uint32_t>(EdgeClass::major);
constexpr std::uint32_t minor = static_cast<std::uint32_t>(EdgeClass::minor);

using Link = std::pair<std::uint32_t, std::uint32_t>;
Link link_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

class Streets {
 public:
  Streets(WardPlan& plan, const WardCells& cells, const std::vector<std::uint32_t>& chosen,
          const std::vector<std::uint32_t>& outline, const WardStreetInput& input)
      : plan_(plan), cells_(cells), outline_(outline), input_(input), square_(cells.rings[chosen[0]]) {
    for (const std::uint32_t cell : chosen) {
      const auto& ring = cells.rings[cell];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Link link = link_of(ring[i], ring[(i + 1) % ring.size()]);
        if (!tag_.emplace(link, minor).second) continue;
        next_[link.first].push_back(link.second);
        next_[link.second].push_back(link.first);
      }
    }
    for (std::size_t i = 0; i < outline.size(); ++i)
      tag_[link_of(outline[i], outline[(i + 1) % outline.size()])] = input.wall_tag;
    for (std::size_t i = 0; i < outline.size(); ++i)
      wall_.insert(link_of(outline[i], outline[(i + 1) % outline.size()]));
  }

  void add() {
    for (const std::uint32_t gate : gates()) {
      plan_.gates.push_back(cells_.corner[gate]);
      add_main_street(gate);
      add_road(gate);
    }
    for (const auto& [link, tag] : tag_) {
      if (!wall_.contains(link)) add_pieces(link.first, link.second, tag);
    }
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const std::uint32_t a = outline_[i], b = outline_[(i + 1) % outline_.size()];
      add_pieces(a, b, input_.wall_tag);
    }
  }

 private:
  dvec2 at(std::uint32_t corner) const { return in_cm(cells_.corner[corner]); }

  /// Corners of the wall where a street between two wards ends, far from each other.
  std::vector<std::uint32_t> gates() const {
    std::vector<std::pair<double, std::uint32_t>> candidates;
    for (const std::uint32_t corner : outline_) {
      Rng draw = input_.rng.at(static_cast<std::uint64_t>(corner));
      if (next_.at(corner).size() > 2 && !is_at_citadel(corner)) candidates.emplace_back(draw.unit(), corner);
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::uint32_t> chosen;
    while (chosen.size() < static_cast<std::size_t>(input_.streets.wards.gates)) {
      std::uint32_t best = no_index;
      double farthest = least_gate_space;
      for (const auto& [draw, corner] : candidates) {
        double nearest = chosen.empty() ? 1e12 - draw : 1e12;
        for (const std::uint32_t other : chosen)
          nearest = std::min(nearest, glm::length(at(other) - at(corner)));
        if (nearest <= farthest) continue;
        farthest = nearest;
        best = corner;
      }
      if (best == no_index) break;
      chosen.push_back(best);
    }
    return chosen;
  }

  bool is_at_citadel(std::uint32_t corner) const {
    return std::any_of(plan_.wards.begin(), plan_.wards.end(), [&](const Ward& ward) {
      return ward.zone == zone_citadel &&
             std::find(ward.ring.begin(), ward.ring.end(), cells_.corner[corner]) != ward.ring.end();
    });
  }

  /// Marks the shortest path from a gate to the square (Dijkstra 1959).
  void add_main_street(std::uint32_t gate) {
    std::map<std::uint32_t, double> reached;
    std::map<std::uint32_t, std::uint32_t> before;
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    reached[gate] = 0;
    queue.emplace(0, gate);
    while (!queue.empty()) {
      const auto [gone, corner] = queue.top();
      queue.pop();
      if (gone > reached[corner]) continue;
      if (std::find(square_.begin(), square_.end(), corner) != square_.end())
        return mark(before, gate, corner);
      for (const std::uint32_t other : next_.at(corner)) {
        const double factor = wall_.contains(link_of(corner, other)) ? along_wall : 1;
        const double length = gone + factor * glm::length(at(other) - at(corner));
        const auto known = reached.find(other);
        if (known != reached.end() && known->second <= length) continue;
        reached[other] = length;
        before[other] = corner;
        queue.emplace(length, other);
      }
    }
  }

  void mark(const std::map<std::uint32_t, std::uint32_t>& before, std::uint32_t gate, std::uint32_t corner) {
    while (corner != gate) {
      const std::uint32_t last = before.at(corner);
      if (!wall_.contains(link_of(corner, last))) tag_[link_of(corner, last)] = major;
      corner = last;
    }
  }

  /// A road from a gate straight to the border, in the first direction in which it can be built.
  void add_road(std::uint32_t gate) {
    const auto found = std::find(outline_.begin(), outline_.end(), gate);
    const auto i = static_cast<std::size_t>(found - outline_.begin());
    const std::size_t count = outline_.size();
    const dvec2 before = at(outline_[(i + count - 1) % count]), after = at(outline_[(i + 1) % count]);
    const dvec2 along = (after - before) / glm::length(after - before), out(along.y, -along.x);
    constexpr double far = 2e6;
    for (const double turn : {0.0, 12.0, -12.0, 24.0, -24.0, 36.0, -36.0}) {
      const math::SinCos by = math::sincos_degrees(turn);
      const dvec2 direction(out.x * by.cos - out.y * by.sin, out.x * by.sin + out.y * by.cos);
      const CmPoint start = cells_.corner[gate], end = rounded_cm(in_cm(start) + direction * far);
      const Route road =
          route_of(input_.ground.region, {start, end}, major, input_.streets.bridge_length * 100);
      if (road.pieces.empty() || !is_apart(road, start) || is_steep(road)) continue;
      for (const StreetPiece& piece : road.pieces) add_pieces(piece.a, piece.b, major);
      plan_.route.separated.insert(plan_.route.separated.end(), road.separated.begin(), road.separated.end());
      return;
    }
  }

  bool is_steep(const Route& road) const {
    const Landform* landform = input_.ground.landform;
    return landform && std::any_of(road.pieces.begin(), road.pieces.end(), [&](const StreetPiece& piece) {
             // A road is sampled in short pieces, as it can follow the ground.
             const dvec2 a = in_cm(piece.a), along = in_cm(piece.b) - a;
             const int count = std::max(1, math::to_int32(glm::length(along) / piece_length + 0.5));
             for (int n = 0; n < count; ++n) {
               const double from = static_cast<double>(n) / count, to = (n + 1.0) / count;
               if (is_too_steep(*landform, a + along * from, a + along * to,
                                input_.streets.classes.major.grade))
                 return true;
             }
             return false;
           });
  }

  /// Whether a road meets neither the wall nor another road, except at its gate.
  bool is_apart(const Route& road, const CmPoint& gate) const {
    constexpr double least = 3000;
    for (const StreetPiece& piece : road.pieces) {
      for (std::size_t i = 0; i < outline_.size(); ++i) {
        const CmPoint &a = cells_.corner[outline_[i]],
                      &b = cells_.corner[outline_[(i + 1) % outline_.size()]];
        if (a != gate && b != gate && segments_meet(piece.a, piece.b, a, b)) return false;
      }
      for (const StreetPiece& other : plan_.route.pieces) {
        if (segments_meet(piece.a, piece.b, other.a, other.b) ||
            distance_to_segment(in_cm(piece.b), in_cm(other.a), in_cm(other.b)) < least)
          return false;
      }
    }
    return true;
  }

  void add_pieces(std::uint32_t a, std::uint32_t b, std::uint32_t tag) {
    add_pieces(cells_.corner[a], cells_.corner[b], tag);
  }
  void add_pieces(const CmPoint& a, const CmPoint& b, std::uint32_t tag) {
    const int count = std::max(1, math::to_int32(distance(a, b) / piece_length + 0.5));
    CmPoint last = a;
    for (int n = 1; n <= count; ++n) {
      const CmPoint next =
          n == count ? b : rounded_cm(in_cm(a) + (in_cm(b) - in_cm(a)) * (static_cast<double>(n) / count));
      plan_.route.pieces.push_back({last, next, tag});
      last = next;
    }
  }

  WardPlan& plan_;
  const WardCells& cells_;
  const std::vector<std::uint32_t>& outline_;
  const WardStreetInput& input_;
  const std::vector<std::uint32_t>& square_;
  std::map<Link, std::uint32_t> tag_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> next_;
  std::set<Link> wall_;
};

}  // namespace

std::uint32_t WardCells::corner_near(const dvec2& p, double reach) {
  for (std::uint32_t i = 0; i < corner.size(); ++i) {
    const dvec2 off = in_cm(corner[i]) - p;
    if (glm::dot(off, off) < reach * reach) return i;
  }
  corner.push_back(rounded_cm(p));
  return static_cast<std::uint32_t>(corner.size()) - 1;
}

CmRing WardCells::ring_of(std::uint32_t cell) const {
  CmRing ring;
  for (const std::uint32_t each : rings[cell]) ring.push_back(corner[each]);
  return ring;
}

std::vector<std::uint32_t> outline_of(const WardCells& cells, const std::vector<std::uint32_t>& chosen) {
  std::set<Link> edges;
  for (const std::uint32_t cell : chosen) {
    const auto& ring = cells.rings[cell];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      if (edges.erase({b, a}) == 0) edges.insert({a, b});
    }
  }
  std::map<std::uint32_t, std::uint32_t> next;
  for (const auto& [a, b] : edges) {
    if (!next.emplace(a, b).second) return {};
  }
  std::vector<std::uint32_t> outline;
  std::uint32_t at = next.empty() ? 0 : next.begin()->first;
  while (outline.size() < next.size()) {
    outline.push_back(at);
    const auto found = next.find(at);
    if (found == next.end()) return {};
    at = found->second;
    if (at == outline[0]) break;
  }
  if (outline.size() != next.size() || outline.size() < 3) return {};
  return outline;
}

void add_ward_streets(WardPlan& plan, const WardCells& cells, const std::vector<std::uint32_t>& chosen,
                      const std::vector<std::uint32_t>& outline, const WardStreetInput& input) {
  Streets(plan, cells, chosen, outline, input).add();
}

}  // namespace seedmesh::city
