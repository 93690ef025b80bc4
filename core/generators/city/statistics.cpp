#include "core/generators/city/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/base/math.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

/// A chain of streets between two nodes of a degree other than 2.
struct Segment {
  std::uint32_t from = 0, to = 0;
  double length = 0;  ///< metres
  bool is_inner = true;
};

class Distances {
 public:
  explicit Distances(const std::vector<CmRing>& area) : area_(area) {}
  /// Whether a segment is at least `margin` centimetres from the border.
  bool is_far(const CmPoint& a, const CmPoint& b, double margin) const {
    const dvec2 p = in_cm(a), q = in_cm(b);
    for (const CmRing& ring : area_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const CmPoint &c = ring[i], &d = ring[(i + 1) % ring.size()];
        const dvec2 u = in_cm(c), v = in_cm(d);
        if (cross_properly(a, b, c, d)) return false;
        const double least = std::min({distance_to_segment(p, u, v), distance_to_segment(q, u, v),
                                       distance_to_segment(u, p, q), distance_to_segment(v, p, q)});
        if (least < margin - 1e-6) return false;
      }
    }
    return true;
  }

 private:
  const std::vector<CmRing>& area_;
};

/// The length of a street as its plan shows it, in metres.
double length_of(const std::vector<ProfilePoint>& points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += distance(points[k - 1].at, points[k].at) / 100;
  return length;
}

/// Streets of all levels and their ends.
struct StreetNetwork {
  struct Street {
    std::uint32_t from, to;
    double length;  ///< metres
    bool is_inner;
  };
  std::vector<Street> streets;
  std::vector<std::vector<std::uint32_t>> ends;  ///< streets, indexed by node; loops twice

  StreetNetwork(const CityPlan& plan, const Distances& distances) : ends(plan.graph.nodes.size()) {
    const StreetGraph& graph = plan.graph;
    for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
      if (!graph.is_street(edge)) continue;
      const PlanarEdge& each = graph.edges[edge];
      const CmPoint &a = graph.nodes[each.from], &b = graph.nodes[each.to];
      const double length =
          plan.heights.is_level() ? distance(a, b) / 100 : length_of(shown_profile(plan, edge));
      add({each.from, each.to, length, distances.is_far(a, b, border_margin * 100)});
    }
    for (const SeparatedStreet& each : graph.separated) {
      double length = 0;
      for (std::size_t k = 1; k < each.line.size(); ++k)
        length += distance(each.line[k - 1], each.line[k]) / 100;
      add({each.from, each.to, length, false});
    }
  }
  void add(const Street& street) {
    ends[street.from].push_back(static_cast<std::uint32_t>(streets.size()));
    ends[street.to].push_back(static_cast<std::uint32_t>(streets.size()));
    streets.push_back(street);
  }
};

std::vector<Segment> segments_of(const StreetNetwork& network) {
  std::vector<Segment> segments;
  std::vector<std::uint8_t> is_used(network.streets.size(), 0);
  for (std::uint32_t node = 0; node < network.ends.size(); ++node) {
    if (network.ends[node].size() == 2) continue;
    for (const std::uint32_t first : network.ends[node]) {
      if (is_used[first] != 0) continue;
      Segment segment{node, node, 0, true};
      for (std::uint32_t street = first; is_used[street] == 0;) {
        is_used[street] = 1;
        const StreetNetwork::Street& each = network.streets[street];
        segment.length += each.length;
        segment.is_inner = segment.is_inner && each.is_inner;
        segment.to = each.from == segment.to ? each.to : each.from;
        const std::vector<std::uint32_t>& here = network.ends[segment.to];
        if (here.size() != 2) break;
        street = here[0] == street ? here[1] : here[0];
      }
      segments.push_back(segment);
    }
  }
  return segments;
}

Json quotient(double sum, double by) { return by > 0 ? Json(sum / by) : Json(nullptr); }

Json quantile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return nullptr;
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto k = static_cast<std::size_t>(at);
  const double next = sorted[std::min(k + 1, sorted.size() - 1)];
  return sorted[k] + (at - static_cast<double>(k)) * (next - sorted[k]);
}

/// Entropy of bearings in 36 bins of 10 degrees centred on north.
class Bearings {
 public:
  void add(const CmPoint& a, const CmPoint& b) {
    const double east = static_cast<double>(b.x) - a.x, north = static_cast<double>(b.y) - a.y;
    for (const double sign : {1.0, -1.0}) {
      double turn = math::degrees(math::atan2(sign * east, sign * north)) + 365;
      if (turn >= 360) turn -= 360;
      ++bins_[static_cast<std::size_t>(std::clamp(turn / 10, 0.0, 35.0))];
      ++count_;
    }
  }
  Json entropy() const {
    if (count_ == 0) return nullptr;
    double sum = 0;
    for (const int n : bins_) {
      const double share = static_cast<double>(n) / count_;
      if (n > 0) sum -= share * math::log(share);
    }
    return sum;
  }

 private:
  std::array<int, 36> bins_{};
  int count_ = 0;
};

Json order_of(const Json& entropy) {
  if (entropy.is_null()) return nullptr;
  const double least = math::log(4), most = math::log(36);
  const double share = (entropy.get<double>() - least) / (most - least);
  return 1 - share * share;
}

void add_areas(const CityPlan& plan, Json& result) {
  double street = 0, lot = 0, park = 0, water = 0;
  for (const Part& part : plan.parts) {
    const double area = area_of(part.rings);
    const bool is_park = part.kind == PartKind::park || part.kind == PartKind::square;
    const bool is_water = part.kind == PartKind::water;
    (part.kind == PartKind::lot ? lot : is_park ? park : is_water ? water : street) += area;
  }
  result["area"] = area_of(plan.area);
  result["blocks"] = plan.blocks.size();
  result["lots"] = plan.lots.size();
  result["buildings"] =
      std::count_if(plan.lots.begin(), plan.lots.end(), [](const Lot& each) { return each.is_built(); });
  result["street_area"] = street;
  result["lot_area"] = lot;
  result["park_area"] = park;
  result["water_area"] = water;
}

struct Line {
  double y, step;
};

/// Horizontal lines and the heights for which they stand, evenly between the heights at which the borders of bands
/// begin and end.
std::vector<Line> lines_of(const std::vector<CmRing>& area, double margin) {
  constexpr std::size_t most_turns = 4000;
  constexpr int lines = 4000;
  double low = 1e18, high = -1e18;
  for (const CmPoint& p : area[0]) {
    low = std::min(low, p.y / 100.0);
    high = std::max(high, p.y / 100.0);
  }
  std::vector<double> turns = {low, high};
  for (const CmRing& ring : area) {
    for (std::size_t i = 0; i < ring.size() && turns.size() < most_turns; ++i) {
      const dvec2 a = in_metres(ring[i]), b = in_metres(ring[(i + 1) % ring.size()]);
      const double side = (b.x - a.x) * margin / std::sqrt(glm::dot(b - a, b - a));
      for (const double y :
           {a.y, a.y - margin, a.y + margin, a.y - side, a.y + side, b.y - side, b.y + side}) {
        if (y > low && y < high) turns.push_back(y);
      }
    }
  }
  std::sort(turns.begin(), turns.end());
  std::vector<Line> all;
  for (std::size_t k = 1; k < turns.size(); ++k) {
    const double height = turns[k] - turns[k - 1];
    if (height <= 0) continue;
    const int count = math::to_int32(std::ceil(height / (high - low) * lines));
    for (int i = 0; i < count; ++i)
      all.push_back({turns[k - 1] + (i + 0.5) * height / count, height / count});
  }
  return all;
}

}  // namespace

double inner_area(const std::vector<CmRing>& area, double margin, const Job& job) {
  // Along horizontal lines: what is inside, without the bands around the edges, each of which a line meets in
  // one piece.
  double sum = 0;
  std::vector<double> cuts;
  std::vector<std::array<double, 2>> taken;
  std::size_t done = 0;
  for (const Line& line : lines_of(area, margin)) {
    const double y = line.y, step = line.step;
    if (done++ % 256 == 0) job.check();
    cuts.clear();
    taken.clear();
    for (const CmRing& ring : area) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = in_metres(ring[i]), b = in_metres(ring[(i + 1) % ring.size()]);
        const auto cut = [&](const dvec2& p, const dvec2& q, auto&& keep) {
          if ((p.y > y) != (q.y > y)) keep(p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x));
        };
        cut(a, b, [&](double x) { cuts.push_back(x); });
        if (y < std::min(a.y, b.y) - margin || y > std::max(a.y, b.y) + margin) continue;
        std::array<double, 2> band = {1e18, -1e18};
        const auto widen = [&band](double x) { band = {std::min(band[0], x), std::max(band[1], x)}; };
        const dvec2 along = b - a,
                    side = dvec2(-along.y, along.x) * (margin / std::sqrt(glm::dot(along, along)));
        const std::array<dvec2, 4> corners = {a + side, b + side, b - side, a - side};
        for (std::size_t k = 0; k < 4; ++k) cut(corners[k], corners[(k + 1) % 4], widen);
        for (const dvec2& c : {a, b}) {
          if (std::abs(y - c.y) >= margin) continue;
          const double half = std::sqrt(margin * margin - (y - c.y) * (y - c.y));
          widen(c.x - half);
          widen(c.x + half);
        }
        if (band[0] < band[1]) taken.push_back(band);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    std::sort(taken.begin(), taken.end());
    for (std::size_t k = 1; k < cuts.size(); k += 2) {
      double x = cuts[k - 1];
      for (const auto& [from, to] : taken) {
        if (from > x) sum += step * std::max(0.0, std::min(from, cuts[k]) - x);
        x = std::max(x, to);
      }
      sum += step * std::max(0.0, cuts[k] - x);
    }
  }
  return sum;
}

Json statistics_of(const CityPlan& plan, const Job& job) {
  const StreetGraph& graph = plan.graph;
  const Distances distances(plan.area);
  std::array<double, 5> by_degree{};
  double nodes = 0, junctions = 0, ends = 0;
  for (std::uint32_t node = 0; node < graph.nodes.size(); ++node) {
    const std::uint32_t degree = graph.street_ends(node);
    if (degree == 0 || degree == 2 ||
        !distances.is_far(graph.nodes[node], graph.nodes[node], border_margin * 100))
      continue;
    ++nodes;
    ends += degree;
    junctions += degree >= 3 ? 1 : 0;
    if (degree < 5) ++by_degree[degree];
  }
  double total = 0, bent = 0, straight = 0;
  std::vector<double> lengths;
  Bearings bearings;
  for (const Segment& segment : segments_of(StreetNetwork(plan, distances))) {
    if (!segment.is_inner) continue;
    lengths.push_back(segment.length);
    total += segment.length;
    bent += segment.length;
    if (segment.from == segment.to) continue;
    straight += distance(graph.nodes[segment.from], graph.nodes[segment.to]) / 100;
    bearings.add(graph.nodes[segment.from], graph.nodes[segment.to]);
  }
  std::sort(lengths.begin(), lengths.end());
  Json result;
  const double inner = inner_area(plan.area, border_margin, job),
               streets = static_cast<double>(lengths.size());
  result["inner_area"] = inner;
  result["street_length"] = total;
  result["nodes"] = nodes;
  result["junctions"] = junctions;
  result["junctions_per_km2"] = quotient(junctions * 1e6, inner);
  result["streets"] = lengths.size();
  result["mean_length"] = quotient(total, streets);
  result["median_length"] = quantile(lengths, 0.5);
  result["p5_length"] = quantile(lengths, 0.05);
  result["circuity"] = quotient(bent, straight);
  result["dead_end_share"] = quotient(by_degree[1], nodes);
  result["three_way_share"] = quotient(by_degree[3], nodes);
  result["four_way_share"] = quotient(by_degree[4], nodes);
  result["streets_per_node"] = quotient(ends, nodes);
  result["orientation_entropy"] = bearings.entropy();
  result["orientation_order"] = order_of(result["orientation_entropy"]);
  add_areas(plan, result);
  return result;
}

}  // namespace seedmesh::city
