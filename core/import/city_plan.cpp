#include "core/import/city_plan.h"

#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/import/foreign_text.h"

namespace seedmesh {
namespace {

struct Kind {
  const char* name;
  const char* tag;
  const char* value;
};
constexpr std::array<Kind, 5> kinds{{{"park", "leisure", "park"},
                                     {"verge", "landuse", "grass"},
                                     {"square", "place", "square"},
                                     {"water", "natural", "water"},
                                     {"street", "highway", "residential"}}};

std::string text_at(const Json& object, const char* name) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A number at one or two names; `other` where there is none.
double number_at(const Json& object, const char* name, double other) {
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found != object.end() && found->is_number() ? found->get<double>() : other;
}

double number_at(const Json& list, std::size_t i) {
  return list.is_array() && i < list.size() && list[i].is_number() ? list[i].get<double>() : 0;
}

/// The plan of a building request about its origin: its footprint, or a rectangle of its size. x is east, y is north.
MapRing plan_of(const Json& parameters) {
  MapRing ring;
  const auto footprint = parameters.find("footprint");
  if (footprint != parameters.end() && footprint->is_array() && !footprint->empty()) {
    for (const Json& point : (*footprint)[0]) ring.emplace_back(number_at(point, 0), -number_at(point, 1));
    if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    return ring;
  }
  const auto size = parameters.find("size");
  if (size == parameters.end()) return ring;
  const double x = number_at(*size, 0) / 2, y = number_at(*size, 2) / 2;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

bool describe_lot(const Json& properties, MapFeature& feature) {
  const auto building = properties.find("building");
  if (building == properties.end() || !building->is_object()) return false;
  const auto parameters = building->find("parameters");
  if (parameters == building->end() || !parameters->is_object()) return false;
  MapRing ring = plan_of(*parameters);
  const auto position = properties.find("position");
  if (ring.size() < 3 || position == properties.end()) return false;
  const double turn = math::radians(number_at(properties, "turn", 0));
  const double c = math::cos(turn), s = math::sin(turn);
  for (glm::dvec2& p : ring)
    p = {number_at(*position, 0) + c * p.x - s * p.y, number_at(*position, 1) + s * p.x + c * p.y};
  feature.polygons = {{std::move(ring)}};
  feature.tags.add("building", "yes");
  const Json attributes = parameters->value("attributes", Json::object());
  const double floors = number_at(attributes, "floors", 0);
  const double size = parameters->contains("size") ? number_at((*parameters)["size"], 1) : 0;
  const double height = number_at(attributes, "height", size);
  if (height > 0) feature.tags.add("height", number_text(height));
  if (height <= 0 && floors > 0) feature.tags.add("building:levels", number_text(floors));
  return true;
}

}  // namespace

bool is_city_plan(const Json& file) {
  if (!file.is_object()) return false;
  const auto stated = file.find("georeference");
  if (stated != file.end() && text_at(*stated, "projection") == "local") return true;
  const auto features = file.find("features");
  if (features == file.end() || !features->is_array() || features->empty()) return false;
  const Json& first = (*features)[0];
  const auto properties = first.is_object() ? first.find("properties") : first.end();
  return properties != first.end() && text_at(*properties, "kind") == "area";
}

bool describe_plan_feature(const Json& properties, MapFeature& feature) {
  const std::string kind = text_at(properties, "kind");
  feature.name = text_at(properties, "id");
  feature.tags = {};
  if (kind == "lot") return describe_lot(properties, feature);
  for (const Kind& each : kinds) {
    if (kind != each.name) continue;
    feature.tags.add(each.tag, each.value);
    const double width = number_at(properties, "width", 0);
    if (width > 0) feature.tags.add("width", number_text(width));
    return true;
  }
  return false;
}

}  // namespace seedmesh
