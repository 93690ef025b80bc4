#include "core/generators/city/plan_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/house_requests.h"

namespace seedmesh::city {
namespace {

std::string id_of(std::uint64_t key) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string id(16, '0');
  for (std::size_t i = 16; i-- > 0; key >>= 4U) id[i] = digits[key & 15U];
  return id;
}

Json position(const CmPoint& p) { return Json::array({p.x / 100.0, p.y / 100.0}); }

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
  Writer(const CityPlan& plan, const CityParams& params) : plan_(plan), requests_(params) {}

  Json write() {
    features_.push_back(feature(polygon(plan_.area), {{"kind", "area"}}));
    add_nodes();
    add_streets();
    for (const Block& block : plan_.blocks) add_block(block);
    std::vector<std::uint32_t> lot_of(plan_.parts.size(), no_index);
    for (std::uint32_t i = 0; i < plan_.lots.size(); ++i) lot_of[plan_.lots[i].part] = i;
    for (std::uint32_t i = 0; i < plan_.parts.size(); ++i) add_part(plan_.parts[i], lot_of[i]);
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
    return degree == 1 ? "dead_end" : degree == 2 ? "bend" : "junction";
  }

  void add_nodes() {
    for (std::uint32_t node = 0; node < plan_.graph.nodes.size(); ++node) {
      const std::uint32_t degree = plan_.graph.street_ends(node);
      if (degree == 0) continue;
      features_.push_back(feature(
          {{"type", "Point"}, {"coordinates", position(plan_.graph.nodes[node])}},
          {{"kind", "node"}, {"id", node_id(node)}, {"degree", degree}, {"type", type_of(node, degree)}}));
    }
  }

  void add_streets() {
    for (std::uint32_t edge = 0; edge < plan_.graph.edges.size(); ++edge) {
      if (!plan_.graph.is_street(edge)) continue;
      const PlanarEdge& each = plan_.graph.edges[edge];
      add_street({each.from,
                  each.to,
                  each.tag,
                  0,
                  {plan_.graph.nodes[each.from], plan_.graph.nodes[each.to]},
                  plan_.graph.edge_key[edge]});
    }
    for (const Bridge& bridge : plan_.graph.bridges) add_street(bridge);
  }

  /// The ramps of bridges that lead over streets are as steep as bridge_height() makes them.
  double grade_of(const Bridge& street) const {
    return street.level != 0 && bridge_height(plan_, street, 1, 2) != 0 ? 0.06 : 0;
  }

  /// A street of any level.
  void add_street(const Bridge& street) {
    const CrossSection& section = plan_.classes[street.tag];
    Json coordinates = Json::array();
    for (const CmPoint& p : street.line) coordinates.push_back(position(p));
    features_.push_back(feature({{"type", "LineString"}, {"coordinates", std::move(coordinates)}},
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
                                 {"grade", grade_of(street)},
                                 {"grade_limit", section.grade_limit},
                                 {"given", street.tag >= first_given && !section.has_wall}}));
  }

  void add_block(const Block& block) {
    Json streets = Json::array();
    for (const std::uint32_t edge : block.streets) streets.push_back(street_id(edge));
    features_.push_back(feature(polygon(block.rings), {{"kind", "block"},
                                                       {"id", id_of(block.key)},
                                                       {"area", area_of(block.rings)},
                                                       {"streets", std::move(streets)}}));
  }

  void add_part(const Part& part, std::uint32_t lot) {
    Json properties = {{"kind", name_of(part.kind)}};
    if (part.street != no_index) properties["street"] = street_id(part.street);
    if (part.node != no_index) properties["node"] = node_id(part.node);
    if (part.block != no_index) properties["block"] = id_of(plan_.blocks[part.block].key);
    if (lot != no_index) add_lot(plan_.lots[lot], properties);
    features_.push_back(feature(polygon(part.rings), std::move(properties)));
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
      add_building(landmark.request, landmark.position, landmark.turn, properties);
    } else if (lot.house) {
      add_building(requests_.of(*lot.house), lot.house->position, lot.house->turn, properties);
    }
  }

  static void add_building(const Child& request, const glm::dvec2& position, double turn, Json& properties) {
    properties["building"] = {{"generator", request.generator},
                              {"seed", *request.seed},
                              {"parameters", Json::parse(request.parameters)}};
    properties["position"] = {position.x, position.y, 0};
    properties["turn"] = turn;
  }

  const CityPlan& plan_;
  HouseRequests requests_;
  Json features_ = Json::array();
};

}  // namespace

Json plan_json(const CityPlan& plan, const CityParams& params) { return Writer(plan, params).write(); }

}  // namespace seedmesh::city
