#include "core/generators/city/plan_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/generators/city/house_requests.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/surface.h"

namespace seedmesh::city {
namespace {

std::string id_of(std::uint64_t key) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string id(16, '0');
  for (std::size_t i = 16; i-- > 0; key >>= 4U) id[i] = digits[key & 15U];
  return id;
}

Json position(const CmPoint& p) { return Json::array({p.x / 100.0, p.y / 100.0}); }
Json position(const CmPoint& p, double height) { return Json::array({p.x / 100.0, p.y / 100.0, height}); }
double millimetres(double height) { return std::floor(height * 1000 + 0.5) / 1000; }

Json polygon(const std::vector<CmRing>& rings) {
  Json coordinates = Json::array();
  for (const CmRing& ring : rings) {
    Json closed = Json::array();
    for (const CmPoint& p : ring) closed.push_back(position(p));
    closed.push_back(position(ring[0]));
    coordinates.push_back(std::move(closed));
  }
  return {{"type", "Polygon"}, {"coordinates", std::move(coordinates)}};
}

Json feature(Json geometry, Json properties) {
  return {{"type", "Feature"}, {"geometry", std::move(geometry)}, {"properties", std::move(properties)}};
}

class Writer {
 public:
  Writer(const CityPlan& plan, const CityParams& params, Job& job)
      : plan_(plan), job_(job), requests_(params) {
    if (!plan.heights.is_level()) surface_.emplace(plan, kerb_height, job);
  }

  Json write() {
    add_feature(polygon(plan_.area), {{"kind", "area"}});
    add_nodes();
    add_streets();
    for (const Block& block : plan_.blocks) add_block(block);
    std::vector<std::uint32_t> lot_of(plan_.parts.size(), no_index);
    for (std::uint32_t i = 0; i < plan_.lots.size(); ++i) lot_of[plan_.lots[i].part] = i;
    for (std::uint32_t i = 0; i < plan_.parts.size(); ++i) add_part(i, lot_of[i]);
    // GeoJSON has longitudes and latitudes; other programs skip this member.
    return {{"type", "FeatureCollection"},
            {"georeference", {{"projection", "local"}, {"unit", "metre"}}},
            {"features", std::move(features_)}};
  }

 private:
  std::string street_id(std::uint32_t edge) const { return id_of(plan_.graph.edge_key[edge]); }
  std::string node_id(std::uint32_t node) const { return id_of(plan_.graph.node_key[node]); }

  const char* type_of(std::uint32_t node, std::uint32_t degree) const {
    if (plan_.graph.is_at_area_border(node)) return "border";
    const std::vector<CmPoint>& gates = plan_.gates;
    if (std::find(gates.begin(), gates.end(), plan_.graph.nodes[node]) != gates.end()) return "gate";
    if (plan_.graph.is_on_ring(node)) return "roundabout";
    return degree == 1 ? "dead_end" : degree == 2 ? "bend" : "junction";
  }

  /// Adds a feature. Checks the job with every 64 of them, because a feature of a terrain costs some microseconds.
  void add_feature(Json geometry, Json properties) {
    constexpr std::size_t features_between_checks = 64;
    if (features_.size() % features_between_checks == 0) job_.check();
    features_.push_back(feature(std::move(geometry), std::move(properties)));
  }

  void add_nodes() {
    for (std::uint32_t node = 0; node < plan_.graph.nodes.size(); ++node) {
      const std::uint32_t degree = plan_.graph.street_ends(node);
      if (degree == 0) continue;
      const CmPoint& at = plan_.graph.nodes[node];
      Json coordinates = surface_ ? position(at, plan_.heights.node[node]) : position(at);
      add_feature(
          {{"type", "Point"}, {"coordinates", std::move(coordinates)}},
          {{"kind", "node"}, {"id", node_id(node)}, {"degree", degree}, {"type", type_of(node, degree)}});
    }
  }

  void add_streets() {
    for (std::uint32_t edge = 0; edge < plan_.graph.edges.size(); ++edge) {
      if (!plan_.graph.is_street(edge)) continue;
      const PlanarEdge& each = plan_.graph.edges[edge];
      add_street({each.from, each.to, each.tag, 0, {}, plan_.graph.edge_key[edge]},
                 shown_profile(plan_, edge));
    }
    for (const SeparatedStreet& each : plan_.graph.separated)
      add_street(each, separated_profile(plan_, each));
  }

  /// A street of any level. On level ground its line has its corners alone.
  void add_street(const SeparatedStreet& street, const std::vector<ProfilePoint>& profile) {
    const CrossSection& section = plan_.classes[street.tag];
    Json coordinates = Json::array();
    double grade = 0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
      if (surface_) coordinates.push_back(position(profile[k].at, profile[k].height));
      if (k == 0) continue;
      const double run = distance(profile[k - 1].at, profile[k].at) / 100;
      if (run > 0) grade = std::max(grade, std::abs(profile[k].height - profile[k - 1].height) / run);
    }
    if (!surface_) {
      for (const CmPoint& p : street.line) coordinates.push_back(position(p));
      if (street.line.empty()) coordinates = {position(profile.front().at), position(profile.back().at)};
    }
    add_feature({{"type", "LineString"}, {"coordinates", std::move(coordinates)}},
                {{"kind", "street"},
                 {"id", id_of(street.key)},
                 {"from", node_id(street.from)},
                 {"to", node_id(street.to)},
                 {"class", section.name},
                 {"width", section.width},
                 {"lanes", section.lanes},
                 {"sidewalk", {section.sidewalk[0], section.sidewalk[1]}},
                 {"level", street.level},
                 {"bridge", street.level > 0},
                 {"tunnel", street.level < 0},
                 {"grade", grade},
                 {"grade_limit", section.grade_limit},
                 {"given", street.tag >= first_given && !section.has_wall}});
  }

  void add_block(const Block& block) {
    Json streets = Json::array();
    for (const std::uint32_t edge : block.streets) streets.push_back(street_id(edge));
    add_feature(polygon(block.rings), {{"kind", "block"},
                                       {"id", id_of(block.key)},
                                       {"area", area_of(block.rings)},
                                       {"streets", std::move(streets)}});
  }

  /// The outline of a part, on a terrain with the heights of its surface.
  Json outline(std::uint32_t number) const {
    Json geometry = polygon(plan_.parts[number].rings);
    if (!surface_) return geometry;
    const std::vector<CmRing>& rings = plan_.parts[number].rings;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t i = 0; i <= rings[r].size(); ++i) {
        geometry["coordinates"][r][i].push_back(
            millimetres(surface_->height(number, in_metres(rings[r][i % rings[r].size()]))));
      }
    }
    return geometry;
  }

  void add_part(std::uint32_t number, std::uint32_t lot) {
    const Part& part = plan_.parts[number];
    Json properties = {{"kind", name_of(part.kind)}};
    if (part.street != no_index) properties["street"] = street_id(part.street);
    if (part.node != no_index) properties["node"] = node_id(part.node);
    if (part.block != no_index) properties["block"] = id_of(plan_.blocks[part.block].key);
    if (lot != no_index) add_lot(plan_.lots[lot], properties);
    add_feature(outline(number), std::move(properties));
  }

  void add_lot(const Lot& lot, Json& properties) const {
    properties["id"] = id_of(lot.key);
    properties["area"] = lot.area;
    properties["frontage"] = lot.frontage;
    properties["corner"] = lot.is_corner;
    properties["inner"] = lot.is_inner;
    properties["zone"] = lot.zone.empty() ? Json() : Json(lot.zone);
    properties["building"] = nullptr;
    if (lot.landmark != no_index) {
      const Landmark& landmark = plan_.landmarks[lot.landmark];
      double floor = kerb_height, lowest = 0;
      if (surface_) {
        const auto footing = footing_of(landmark);
        floor = millimetres(footing ? surface_->floor_height(*footing, lowest)
                                    : surface_->height(lot.part, landmark.position));
      }
      add_building(landmark.request, {landmark.position, floor}, landmark.turn, properties);
    } else if (lot.house) {
      double lowest = 0;
      const double floor =
          surface_ ? millimetres(surface_->floor_height(lot.footing(), lowest)) : kerb_height;
      add_building(requests_.of(*lot.house), {lot.house->position, floor}, lot.house->turn, properties);
    }
  }

  static void add_building(const Child& request, const glm::dvec3& position, double turn, Json& properties) {
    properties["building"] = {{"generator", request.generator},
                              {"seed", *request.seed},
                              {"parameters", Json::parse(request.parameters)}};
    properties["position"] = {position.x, position.y, position.z};
    properties["turn"] = turn;
  }

  const CityPlan& plan_;
  Job& job_;
  HouseRequests requests_;
  std::optional<Surface> surface_;  ///< empty on level ground
  Json features_ = Json::array();
};

}  // namespace

Json plan_json(const CityPlan& plan, const CityParams& params, Job& job) {
  return Writer(plan, params, job).write();
}

}  // namespace seedmesh::city
