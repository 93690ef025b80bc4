#include "core/generators/city/tunnels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/generators/city/surface.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double verge_width = 0.5;    // of the walkway on both sides of the carriageway, m
constexpr double side_wall = 0.6;      // m
constexpr double earth = 1;            // above the slab, m
constexpr double slope = 0.5;          // of the earth beside a tube, rise over run
constexpr double same_line = 0.03;     // m
constexpr double most_to_border = 40;  // from the end of the street, m
constexpr double least_sine = 0.8;     // between a tunnel and the border at its mouth
constexpr double point_spacing = 4;    // of vertices of the ground along a tunnel, m

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// An edge of the ground along a street, in metres and in centimetres.
struct Border {
  dvec2 a{0}, b{0};
  CmPoint from, to;
};

/// Whether a border lies on the line of an opening. `ends` become the positions of its ends along that line.
bool is_on_line(const TunnelMouth& mouth, const dvec2& a, const dvec2& b, std::array<double, 2>& ends) {
  const dvec2 p = a - mouth.middle, q = b - mouth.middle;
  ends = {glm::dot(p, mouth.along), glm::dot(q, mouth.along)};
  return std::abs(cross(mouth.along, p)) <= same_line && std::abs(cross(mouth.along, q)) <= same_line;
}

/// The corner of an opening that is strictly between the ends of an edge; the same for both directions of the edge.
std::optional<dvec2> corner_on(const TunnelMouth& mouth, const CmPoint& a, const CmPoint& b, double at) {
  constexpr double least_share = 1e-4;
  const dvec2 from = in_metres(std::min(a, b)), to = in_metres(std::max(a, b));
  std::array<double, 2> ends{};
  if (!is_on_line(mouth, from, to, ends)) return std::nullopt;
  const double share = (at - ends[0]) / (ends[1] - ends[0]);
  if (!(share > least_share && share < 1 - least_share)) return std::nullopt;
  return from + (to - from) * share;
}

std::vector<Border> borders_of(const CityPlan& plan, const EdgeTable& part_of_edge) {
  std::vector<Border> all;
  for (const Part& part : plan.parts) {
    if (is_street_space(part) || part.kind == PartKind::water) continue;
    for (const CmRing& ring : part.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const CmPoint &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
        const std::uint32_t beyond = part_of_edge.value_of(b, a);
        if (beyond == EdgeTable::absent || !is_street_space(plan.parts[beyond])) continue;
        all.push_back({in_metres(a), in_metres(b), a, b});
      }
    }
  }
  return all;
}

/// The first border that a tunnel meets, if it enters the ground there and the border is straight along the opening.
std::optional<TunnelMouth> mouth_at(const std::vector<Border>& borders, const dvec2& from, const dvec2& to,
                                    double half) {
  const double reach = std::min(glm::length(to - from), most_to_border);
  const dvec2 d = (to - from) / glm::length(to - from);
  double nearest = reach;
  const Border* met = nullptr;
  for (const Border& each : borders) {
    const dvec2 edge = each.b - each.a, off = each.a - from;
    const double across = cross(d, edge);
    if (across == 0) continue;
    const double along = cross(off, edge) / across, share = cross(off, d) / across;
    if (share < 0 || share > 1 || along <= 0 || along >= nearest) continue;
    nearest = along;
    met = &each;
  }
  if (!met) return std::nullopt;
  TunnelMouth mouth;
  mouth.middle = from + d * nearest;
  mouth.along = (met->b - met->a) / glm::length(met->b - met->a);
  // The ground is on the left of its border.
  const double sine = cross(mouth.along, d);
  if (sine < least_sine) return std::nullopt;
  mouth.half = half / sine;
  double covered = 0;
  mouth.corners = {mouth.middle - mouth.along * mouth.half, mouth.middle + mouth.along * mouth.half};
  for (const Border& each : borders) {
    std::array<double, 2> ends{};
    if (!is_on_line(mouth, each.a, each.b, ends)) continue;
    covered += std::max(0.0, std::min(ends[1], mouth.half) - std::max(ends[0], -mouth.half));
    for (const std::size_t k : {0U, 1U}) {
      const double at = k == 0 ? -mouth.half : mouth.half;
      mouth.corners[k] = corner_on(mouth, each.from, each.to, at).value_or(mouth.corners[k]);
    }
  }
  if (covered < 2 * mouth.half - same_line) return std::nullopt;
  return mouth;
}

/// The floor between two mouths.
std::vector<TunnelStation> stations_of(const std::vector<ProfilePoint>& line, const Tunnel& tunnel) {
  const TunnelMouth &first = tunnel.mouths[0], &last = tunnel.mouths[1];
  std::vector<TunnelStation> stations = {{first.corners[0], first.corners[1], first.middle, first.floor}};
  constexpr double after_mouth = 1;
  const double begin = glm::length(first.middle - in_metres(line.front().at)) + after_mouth;
  const double end = line.back().station - glm::length(last.middle - in_metres(line.back().at)) - after_mouth;
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    if (line[k].station <= begin || line[k].station >= end) continue;
    const dvec2 here = in_metres(line[k].at), run = in_metres(line[k + 1].at) - in_metres(line[k - 1].at);
    const dvec2 side = dvec2(-run.y, run.x) * (tunnel.half / glm::length(run));
    stations.push_back({here + side, here - side, here, line[k].height + kerb_height});
  }
  stations.push_back({last.corners[1], last.corners[0], last.middle, last.floor});
  return stations;
}

/// Whether a street crosses above a tunnel that is not deep enough for it.
bool is_shallow(const CityPlan& plan, const std::vector<ProfilePoint>& line) {
  const StreetGraph& graph = plan.graph;
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (!graph.is_street(edge)) continue;
    const CmPoint &a = graph.nodes[graph.edges[edge].from], &b = graph.nodes[graph.edges[edge].to];
    for (std::size_t k = 1; k < line.size(); ++k) {
      if (!cross_properly(a, b, line[k - 1].at, line[k].at)) continue;
      const dvec2 street = in_metres(b) - in_metres(a),
                  run = in_metres(line[k].at) - in_metres(line[k - 1].at);
      const double station =
          glm::length(street) * cross(in_metres(line[k - 1].at) - in_metres(a), run) / cross(street, run);
      const double above = height_on_street(plan.heights, edge, station);
      const double highest = std::max(line[k - 1].height, line[k].height);
      if (above - highest < Tunnels::clear_height + Tunnels::slab + kerb_height) return true;
    }
  }
  return false;
}

}  // namespace

Tunnels::Tunnels(const CityPlan& plan, const EdgeTable& part_of_edge) {
  std::vector<Border> borders;
  for (const SeparatedStreet& each : plan.graph.separated) {
    if (each.level > 0) continue;
    if (borders.empty()) borders = borders_of(plan, part_of_edge);
    Tunnel tunnel;
    tunnel.half = plan.classes[each.tag].width / 2 + verge_width;
    const CmRing& line = each.line;
    auto first = mouth_at(borders, in_metres(line[0]), in_metres(line[1]), tunnel.half);
    auto last = mouth_at(borders, in_metres(line.back()), in_metres(line[line.size() - 2]), tunnel.half);
    const std::vector<ProfilePoint> profile = separated_profile(plan, each);
    if (!first || !last || is_shallow(plan, profile)) {
      ++left_out_;
      continue;
    }
    first->floor = plan.heights.node[each.from] + kerb_height;
    last->floor = plan.heights.node[each.to] + kerb_height;
    tunnel.mouths = {*first, *last};
    tunnel.stations = stations_of(profile, tunnel);
    add_ground_points(tunnel);
    tunnels_.push_back(std::move(tunnel));
  }
}

void Tunnels::add_ground_points(const Tunnel& tunnel) {
  const double beside = tunnel.half + side_wall;
  for (std::size_t k = 1; k < tunnel.stations.size(); ++k) {
    const dvec2 from = tunnel.stations[k - 1].middle, run = tunnel.stations[k].middle - from;
    const double length = glm::length(run);
    const dvec2 side = dvec2(-run.y, run.x) / length;
    for (double at = 0; at < length; at += point_spacing) {
      for (const double off : {0.0, beside, -beside, beside + 4, -beside - 4, beside + 9, -beside - 9})
        ground_points_.push_back(from + run * (at / length) + side * off);
    }
  }
}

double Tunnels::cover(const dvec2& metres) const {
  double highest = -1e9;
  for (const Tunnel& tunnel : tunnels_) {
    for (std::size_t k = 1; k < tunnel.stations.size(); ++k) {
      const TunnelStation &s = tunnel.stations[k - 1], &t = tunnel.stations[k];
      const dvec2 run = t.middle - s.middle, off = metres - s.middle;
      const double share = std::clamp(glm::dot(off, run) / glm::dot(run, run), 0.0, 1.0);
      const double beyond = glm::length(off - run * share) - tunnel.half - side_wall;
      const double top = s.height + (t.height - s.height) * share + clear_height + slab + earth;
      highest = std::max(highest, top - slope * std::max(0.0, beyond));
    }
  }
  return highest;
}

std::optional<double> Tunnels::lintel(const dvec2& metres) const {
  for (const Tunnel& tunnel : tunnels_) {
    for (const TunnelMouth& mouth : tunnel.mouths) {
      const dvec2 off = metres - mouth.middle;
      if (std::abs(cross(mouth.along, off)) > 2 * same_line) continue;
      if (std::abs(glm::dot(off, mouth.along)) < mouth.half - 1e-3) return mouth.floor + clear_height;
    }
  }
  return std::nullopt;
}

void Tunnels::append_corners(const CmPoint& a, const CmPoint& b, std::vector<dvec2>& points) const {
  for (const Tunnel& tunnel : tunnels_) {
    for (const TunnelMouth& mouth : tunnel.mouths) {
      for (const double at : {-mouth.half, mouth.half}) {
        if (const auto corner = corner_on(mouth, a, b, at)) points.push_back(*corner);
      }
    }
  }
}

}  // namespace seedmesh::city
