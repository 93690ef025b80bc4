#include "core/generators/city/cell_division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/vectors.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;
using Ring = std::vector<std::uint32_t>;

constexpr double piece_length = 3000;      // cm
constexpr std::size_t most_starts = 24;    // of one part
constexpr std::size_t most_pieces = 60;    // of one street
constexpr double least_share = 0.2;        // of a part, for each side of a street
constexpr double least_last_piece = 1500;  // cm

std::uint64_t point_key(const CmPoint& p) {
  return key_at(key_at(0xD171, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

/// A way across a part, before it is built.
struct Way {
  std::size_t first = 0, last = 0;  ///< positions in the ring
  std::size_t hole = 0;       ///< the hole at which it ends, with the position `last`; 0: the outer ring
  bool is_to_border = false;  ///< ends on the border between the node at `last` and the next one
  std::vector<dvec2> points;  ///< between its ends, and the end on a border
  double share = 0;           ///< of the smaller side
};

class Divider {
 public:
  Divider(Network& network, const CellRings& rings, const DivisionRules& rules)
      : network_(network), rings_(rings), rules_(rules) {}

  std::vector<Ring> divide() {
    std::vector<Ring> parts = {rings_[0]}, streets;
    while (!parts.empty()) {
      Ring part = std::move(parts.back());
      parts.pop_back();
      if (area_of(part) <= rules_.largest) continue;
      std::vector<Way> ways = ways_across(part);
      std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) {
        return a.share != b.share ? a.share > b.share : a.first < b.first;
      });
      for (Way& way : ways) {
        const std::optional<Ring> street = build(part, way);
        if (!street) continue;
        if (way.hole > 0) {
          parts.push_back(joined(part, way, *street));
          rings_[way.hole].clear();
        } else {
          for (Ring& side : sides_of(part, way, *street)) parts.push_back(std::move(side));
        }
        streets.push_back(*street);
        break;
      }
    }
    return streets;
  }

 private:
  dvec2 at(std::uint32_t node) const { return in_cm(network_.nodes()[node]); }

  /// Whether a street may start or end at a node of the ring: nodes on the border are left out.
  bool may_end(std::uint32_t node) const {
    const std::vector<std::uint32_t>& arms = network_.arms(node);
    const auto is_street = [&](std::uint32_t arm) { return is_street_class(network_.edges()[arm].kind); };
    return rules_.may_end(node) && std::all_of(arms.begin(), arms.end(), is_street);
  }

  double area_of(const Ring& ring) const {
    CmRing points;
    points.reserve(ring.size());
    for (const std::uint32_t node : ring) points.push_back(network_.nodes()[node]);
    return static_cast<double>(doubled_area(points)) / 2;
  }

  /// Ways from those nodes of a part that have the least draws.
  std::vector<Way> ways_across(const Ring& part) const {
    std::vector<std::pair<std::uint64_t, std::size_t>> starts;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (may_end(part[i])) starts.emplace_back(rules_.rng.at(point_key(network_.nodes()[part[i]])).key(), i);
    }
    std::sort(starts.begin(), starts.end());
    if (starts.size() > most_starts) starts.resize(most_starts);
    std::vector<Way> ways;
    for (const auto& [draw, start] : starts) {
      if (std::optional<Way> way = way_from(part, start)) ways.push_back(*std::move(way));
    }
    return ways;
  }

  std::optional<Way> way_from(const Ring& part, std::size_t start) const {
    const std::size_t count = part.size();
    Rng draw = rules_.rng.at("bend").at(point_key(network_.nodes()[part[start]]));
    const double turn =
        draw.uniform(-rules_.bend, rules_.bend) / 10;  // of each of about ten pieces, on average
    dvec2 from = at(part[start]);
    dvec2 direction =
        inward_at(network_, part[(start + count - 1) % count], part[start], part[(start + 1) % count]);
    Way way;
    way.first = start;
    while (way.points.size() < most_pieces) {
      direction = rules_.aligned(way.points.empty()
                                     ? direction
                                     : rotated(direction, turn + draw.uniform(-rules_.bend, rules_.bend) / 4),
                                 from);
      const dvec2 to = from + direction * piece_length;
      const End end = end_of_piece(part, from, to + direction * piece_length / 2.0, start);
      const dvec2 stop = end.is_met ? end.at : to;
      if (end.is_blocked || !rules_.may_pass(from, stop)) return std::nullopt;
      if (end.is_met) {
        way.last = end.position;
        way.hole = end.hole;
        way.is_to_border = end.is_border;
        if (end.is_border) way.points.push_back(stop);
        return finished(part, std::move(way));
      }
      way.points.push_back(to);
      from = to;
    }
    return std::nullopt;
  }

  /// Where a piece ends at the ring.
  struct End {
    bool is_met = false, is_border = false;
    bool is_blocked = false;   ///< by a hole, a shore, or a node where no street may end
    std::size_t hole = 0;      ///< 0: the outer ring
    std::size_t position = 0;  ///< of the node, or of the first node of the edge of the border
    dvec2 at{0};
    double share = 1e300;  ///< of the line on which it is, from its start
  };

  EdgeClass kind_between(std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t arm : network_.arms(a)) {
      const NetworkEdge& edge = network_.edges()[arm];
      if (edge.from == b || edge.to == b) return edge.kind;
    }
    return EdgeClass::shore;
  }

  End end_of_piece(const Ring& part, const dvec2& from, const dvec2& to, std::size_t start) const {
    End end;
    meet_ring(part, 0, part[start], from, to, end);
    for (std::size_t r = 1; r < rings_.size(); ++r) meet_ring(rings_[r], r, part[start], from, to, end);
    return end;
  }

  /// Sets the end of a piece from the node `start` or later to the nearest edge of a ring that it meets.
  void meet_ring(const Ring& ring, std::size_t hole, std::uint32_t start, const dvec2& from, const dvec2& to,
                 End& end) const {
    const CmPoint p = rounded_cm(from), q = rounded_cm(to);
    for (std::size_t i = 0, count = ring.size(); i < count; ++i) {
      const std::size_t next = (i + 1) % count;
      if (ring[i] == start || ring[next] == start) continue;
      const dvec2 a = at(ring[i]), across = at(ring[next]) - a, along = to - from;
      const double scale = along.x * across.y - along.y * across.x;
      if (scale == 0 || !segments_meet(p, q, network_.nodes()[ring[i]], network_.nodes()[ring[next]]))
        continue;
      const double share = ((a.x - from.x) * across.y - (a.y - from.y) * across.x) / scale;
      if (share >= end.share) continue;
      const EdgeClass kind = kind_between(ring[i], ring[next]);
      const dvec2 hit = from + along * share;
      const bool is_near_first = length_of(hit - a) < length_of(hit - at(ring[next]));
      end = {true,
             kind == EdgeClass::border,
             kind == EdgeClass::shore || (hole > 0 && !is_street_class(kind)),
             hole,
             i,
             hit,
             share};
      if (is_street_class(kind)) {
        end.position = is_near_first ? i : next;
        end.at = at(ring[end.position]);
        end.is_blocked = !may_end(ring[end.position]);
      }
      end.is_blocked |= length_of(end.at - from) < least_last_piece;
    }
  }

  /// The way with the share of its smaller side; nullopt if this is too small. Ways to a hole divide nothing, and are
  /// the last ones that are tried.
  std::optional<Way> finished(const Ring& part, Way way) const {
    if (way.hole > 0) return way;
    CmRing points;
    for (std::size_t i = way.first;; i = (i + 1) % part.size()) {
      points.push_back(network_.nodes()[part[i]]);
      if (i == way.last) break;
    }
    CmRing street;
    for (const dvec2& p : way.points) street.push_back(rounded_cm(p));
    points.insert(points.end(), street.rbegin(), street.rend());
    const double share = static_cast<double>(doubled_area(points)) / 2 / area_of(part);
    way.share = std::min(share, 1 - share);
    return way.share >= least_share ? std::optional(std::move(way)) : std::nullopt;
  }

  /// Builds a way, which may end at another node of the part than planned. A new node on the border is added to the part.
  /// Removes the pieces again if one is refused or ends elsewhere.
  std::optional<Ring> build(Ring& part, Way& way) {
    Ring street = {part[way.first]};
    std::vector<dvec2> points = way.points;
    if (way.hole > 0) {
      points.push_back(at(rings_[way.hole][way.last]));
    } else if (!way.is_to_border) {
      points.push_back(at(part[way.last]));
    }
    for (const dvec2& point : points) {
      const PieceResult built = network_.build_piece(street.back(), point, EdgeClass::minor);
      if (built.state == PieceState::failed) break;
      street.push_back(built.node);
      if (built.state == PieceState::free) continue;
      if (built.node == street.front()) break;
      if (way.hole > 0) {
        const Ring& hole = rings_[way.hole];
        const auto met = std::find(hole.begin(), hole.end(), built.node);
        if (met == hole.end()) break;
        way.last = static_cast<std::size_t>(met - hole.begin());
        return street;
      }
      auto end = std::find(part.begin(), part.end(), built.node);
      if (end == part.end()) {
        const std::uint32_t a = part[way.last], b = part[(way.last + 1) % part.size()];
        if (kind_between(built.node, a) != EdgeClass::border ||
            kind_between(built.node, b) != EdgeClass::border)
          break;
        if (way.first > way.last) ++way.first;
        end = part.insert(part.begin() + static_cast<std::ptrdiff_t>(way.last) + 1, built.node);
      }
      way.last = static_cast<std::size_t>(end - part.begin());
      return street;
    }
    // The last arm of a node is the latest one.
    for (std::size_t i = street.size() - 1; i > 0; --i) network_.remove_edge(network_.arms(street[i]).back());
    return std::nullopt;
  }

  /// The ring of a part and of one of its holes after a street has joined them.
  Ring joined(const Ring& part, const Way& way, const Ring& street) const {
    const Ring& hole = rings_[way.hole];
    Ring ring(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(way.first));
    ring.insert(ring.end(), street.begin(), street.end() - 1);
    for (std::size_t i = 0; i <= hole.size(); ++i) ring.push_back(hole[(way.last + i) % hole.size()]);
    ring.insert(ring.end(), street.rbegin() + 1, street.rend());
    ring.insert(ring.end(), part.begin() + static_cast<std::ptrdiff_t>(way.first) + 1, part.end());
    return ring;
  }

  static std::array<Ring, 2> sides_of(const Ring& part, const Way& way, const Ring& street) {
    std::array<Ring, 2> sides;
    for (std::size_t i = way.first; i != way.last; i = (i + 1) % part.size()) sides[0].push_back(part[i]);
    sides[0].insert(sides[0].end(), street.rbegin(), street.rend() - 1);
    for (std::size_t i = way.last; i != way.first; i = (i + 1) % part.size()) sides[1].push_back(part[i]);
    sides[1].insert(sides[1].end(), street.begin(), street.end() - 1);
    return sides;
  }

  Network& network_;
  CellRings rings_;  ///< holes that have been joined are empty
  const DivisionRules& rules_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> divide_cell(Network& network, const CellRings& rings,
                                                    const DivisionRules& rules) {
  return Divider(network, rings, rules).divide();
}

dvec2 inward_at(const Network& network, std::uint32_t before, std::uint32_t node, std::uint32_t after) {
  const dvec2 p = in_cm(network.nodes()[node]);
  const dvec2 in = p - in_cm(network.nodes()[before]), out = in_cm(network.nodes()[after]) - p;
  const dvec2 along = in / length_of(in) + out / length_of(out);
  const double length = length_of(along);
  if (length < 1e-6) return in / length_of(in);
  return dvec2(-along.y, along.x) / length;
}

}  // namespace seedmesh::city
