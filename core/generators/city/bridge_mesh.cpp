#include "core/generators/city/bridge_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>

#include "core/model/empty_mesh.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double deck_thickness = 0.6, parapet_height = 0.9, parapet_width = 0.25;
constexpr double pier_spacing = 25, pier_depth = 6, pier_thickness = 1.2;

/// The two edges of the deck at one position along it.
struct Station {
  dvec2 left{0}, right{0};
  double height = 0;
};

class BridgeBuilder {
 public:
  BridgeBuilder(const CityPlan& plan, const Job& job) : plan_(plan) {
    mesh_ = empty_mesh(job);
    mesh_.uv[0] = Array<glm::vec2>(job);
  }

  void add(const SeparatedStreet& bridge) {
    const std::vector<Station> stations = stations_of(bridge);
    for (std::size_t k = 1; k < stations.size(); ++k) add_piece(stations[k - 1], stations[k]);
    add_piers(stations);
  }

  /// The inside of a tube: floor, ceiling and walls.
  void add(const Tunnel& tunnel) {
    for (std::size_t k = 1; k < tunnel.stations.size(); ++k) {
      const TunnelStation &s = tunnel.stations[k - 1], &t = tunnel.stations[k];
      const double s_top = s.height + Tunnels::clear_height, t_top = t.height + Tunnels::clear_height;
      quad({Corner{s.right, s.height}, {t.right, t.height}, {t.left, t.height}, {s.left, s.height}});
      quad({Corner{s.left, s_top}, {t.left, t_top}, {t.right, t_top}, {s.right, s_top}});
      quad({Corner{s.left, s.height}, {t.left, t.height}, {t.left, t_top}, {s.left, s_top}});
      quad({Corner{t.right, t.height}, {s.right, s.height}, {s.right, s_top}, {t.right, t_top}});
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  using Corner = std::pair<dvec2, double>;

  std::vector<Station> stations_of(const SeparatedStreet& bridge) const {
    const std::vector<ProfilePoint> line = separated_profile(plan_, bridge);
    const double half = plan_.classes[bridge.tag].width / 2;
    std::vector<Station> stations;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const dvec2 here = in_metres(line[k].at);
      const dvec2 d =
          in_metres(line[std::min(k + 1, line.size() - 1)].at) - in_metres(line[k == 0 ? 0 : k - 1].at);
      const dvec2 side = dvec2(-d.y, d.x) * (half / glm::length(d));
      stations.push_back({here + side, here - side, line[k].height});
    }
    fit_end(bridge.from, stations.front());
    fit_end(bridge.to, stations.back());
    return stations;
  }

  /// The deck takes the corners of the carriageway that ends at a node on the shore.
  void fit_end(std::uint32_t node, Station& station) const {
    if (plan_.graph.degree(node) != 1) return;
    const CmPoint& at = plan_.graph.nodes[node];
    for (const std::uint32_t half : plan_.graph.arms.of(node)) {
      if (!plan_.graph.is_street(half / 2)) continue;
      for (const Part& part : plan_.parts) {
        if (part.kind != PartKind::carriageway || part.street != half / 2) continue;
        const CmRing& ring = part.rings[0];
        const auto found = std::find(ring.begin(), ring.end(), at);
        if (found == ring.end()) return;
        const std::size_t i = static_cast<std::size_t>(found - ring.begin()), count = ring.size();
        dvec2 a = in_metres(ring[(i + count - 1) % count]), b = in_metres(ring[(i + 1) % count]);
        if (glm::dot(a - b, station.left - station.right) < 0) std::swap(a, b);
        station.left = a;
        station.right = b;
        return;
      }
    }
  }

  std::uint32_t vertex(const dvec2& p, double height, const glm::vec3& normal, const glm::vec2& uv) {
    mesh_.position.push_back(
        {static_cast<float>(p.x), static_cast<float>(height), static_cast<float>(0 - p.y)});
    mesh_.normal.push_back(normal);
    mesh_.uv[0].push_back(uv);
    return static_cast<std::uint32_t>(mesh_.position.size() - 1);
  }

  /// A quadrilateral, counter-clockwise seen from its front.
  void quad(const std::array<Corner, 4>& corners) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t k = 0; k < 4; ++k)
      p[k] = {corners[k].first.x, corners[k].second, 0 - corners[k].first.y};
    const glm::dvec3 across = glm::cross(p[2] - p[0], p[3] - p[1]);
    const double size = std::sqrt(glm::dot(across, across));
    if (size < 1e-6) return;
    const glm::vec3 normal(across / size);
    const auto u = static_cast<float>(glm::length(p[1] - p[0])),
               v = static_cast<float>(glm::length(p[3] - p[0]));
    const std::array<glm::vec2, 4> uv = {glm::vec2(0, 0), {u, 0}, {u, v}, {0, v}};
    std::array<std::uint32_t, 4> at{};
    for (std::size_t k = 0; k < 4; ++k) at[k] = vertex(corners[k].first, corners[k].second, normal, uv[k]);
    for (const std::size_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh_.index.wide.push_back(at[k]);
  }

  void add_piece(const Station& s, const Station& t) {
    const auto inset = [](const dvec2& from, const dvec2& to) {
      return from + (to - from) * (parapet_width / glm::length(to - from));
    };
    const dvec2 s_left = inset(s.left, s.right), s_right = inset(s.right, s.left);
    const dvec2 t_left = inset(t.left, t.right), t_right = inset(t.right, t.left);
    const double s_low = s.height - deck_thickness, t_low = t.height - deck_thickness;
    const double s_top = s.height + parapet_height, t_top = t.height + parapet_height;
    quad({Corner{s_right, s.height}, {t_right, t.height}, {t_left, t.height}, {s_left, s.height}});
    quad({Corner{s.left, s_low}, {t.left, t_low}, {t.right, t_low}, {s.right, s_low}});
    quad({Corner{s.right, s_low}, {t.right, t_low}, {t.right, t_top}, {s.right, s_top}});
    quad({Corner{s.right, s_top}, {t.right, t_top}, {t_right, t_top}, {s_right, s_top}});
    quad({Corner{s_right, s_top}, {t_right, t_top}, {t_right, t.height}, {s_right, s.height}});
    quad({Corner{t.left, t_low}, {s.left, s_low}, {s.left, s_top}, {t.left, t_top}});
    quad({Corner{t.left, t_top}, {s.left, s_top}, {s_left, s_top}, {t_left, t_top}});
    quad({Corner{t_left, t_top}, {s_left, s_top}, {s_left, s.height}, {t_left, t.height}});
  }

  void add_piers(const std::vector<Station>& stations) {
    double since = pier_spacing / 2;
    for (std::size_t k = 1; k + 1 < stations.size(); ++k) {
      const Station &before = stations[k - 1], &here = stations[k];
      const dvec2 middle = (here.left + here.right) / 2.0;
      since += glm::length(middle - (before.left + before.right) / 2.0);
      if (since < pier_spacing) continue;
      since = 0;
      const dvec2 across = (here.left - here.right) * 0.3;
      const dvec2 along = dvec2(across.y, -across.x) * (pier_thickness / 2 / glm::length(across));
      const std::array<dvec2, 4> foot = {middle - across - along, middle - across + along,
                                         middle + across + along, middle + across - along};
      const double top = here.height - deck_thickness;
      const double low = std::min({stations.front().height, stations.back().height, top}) - pier_depth;
      for (std::size_t n = 0; n < 4; ++n) {
        const dvec2 &a = foot[n], &b = foot[(n + 1) % 4];
        quad({Corner{a, low}, {b, low}, {b, top}, {a, top}});
      }
    }
  }

  const CityPlan& plan_;
  Mesh mesh_;
};

}  // namespace

Mesh bridge_mesh(const CityPlan& plan, const Job& job) {
  BridgeBuilder builder(plan, job);
  for (const SeparatedStreet& each : plan.graph.separated) {
    job.check();
    if (each.level > 0) builder.add(each);
  }
  return builder.take();
}

Mesh tunnel_mesh(const Surface& surface, const Job& job) {
  BridgeBuilder builder(surface.plan(), job);
  for (const Tunnel& tunnel : surface.tunnels().all()) {
    job.check();
    builder.add(tunnel);
  }
  return builder.take();
}

std::optional<Warning> tunnel_warning(const Surface& surface) {
  const std::size_t count = surface.tunnels().left_out();
  if (count == 0) return std::nullopt;
  return Warning{
      "/given/streets",
      std::to_string(count) +
          " tunnels have no mesh; expected 5.6 m below every street that they pass, and ends that meet a "
          "straight border of a block at more than 53 degrees"};
}

}  // namespace seedmesh::city
