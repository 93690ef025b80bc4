#include "core/schema/geojson.h"

#include <initializer_list>

#include "core/schema/reader.h"
#include "core/schema/writer.h"

namespace seedmesh::schema {
namespace {

Json with_members(const Json& object, std::initializer_list<const char*> names) {
  Json kept = Json::object();
  for (const char* name : names) {
    if (const auto at = object.find(name); at != object.end()) kept[name] = *at;
  }
  return kept;
}

/// The object without foreign members. Values of a wrong type stay, so that their errors can be found. Requests have
/// a limited depth, so that the recursion has one, too.
Json cleaned(const Json& value) {
  if (!value.is_object()) return value;
  Json kept =
      with_members(value, {"type", "features", "geometry", "properties", "coordinates", "geometries"});
  for (const char* list : {"features", "geometries"}) {
    if (const auto at = kept.find(list); at != kept.end() && at->is_array()) {
      for (Json& each : *at) each = cleaned(each);
    }
  }
  if (const auto at = kept.find("geometry"); at != kept.end()) *at = cleaned(*at);
  return kept;
}

}  // namespace

void read_geojson(const Location& location, GeoJson& out) {
  if (location.kind() != JsonKind::object) return location.expected("an object of GeoJSON");
  Json kept = cleaned(location.value());
  if (const auto crs = location.value().find("crs"); crs != location.value().end()) kept["crs"] = *crs;
  out.text = canonical_text(kept);
}

Json write_geojson(const GeoJson& value) { return Json::parse(value.text); }

}  // namespace seedmesh::schema
