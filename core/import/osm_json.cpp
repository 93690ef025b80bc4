// Reads the JSON of Overpass, with elements or with geometry in place (`out geom`).
#include "core/import/osm_json.h"

#include <array>

#include "core/import/foreign_text.h"
#include "core/import/listed_objects.h"
#include "core/import/map_scene.h"
#include "core/import/osm_data.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_errors = 100;

class OsmJsonReader {
 public:
  explicit OsmJsonReader(const ImportOptions& options) : options_(options) {}

  Result<Imported> read(const Json& file) {
    const auto elements = file.find("elements");
    if (elements == file.end() || !elements->is_array()) {
      return Error{
          Code::invalid,
          {{missing_for({"elements"}), "", "expected an array \"elements\", as Overpass writes it"}}};
    }
    read_bounds(file);
    for (std::size_t i = 0; i < elements->size() && issues_.size() < most_errors; ++i)
      read_element((*elements)[i], i);
    return made(file);
  }

  /// Reads a file whose elements are still texts.
  Result<Imported> read_in_parts(std::string_view text, const ListedObjects& elements) {
    Result<Json> file = parse_json(elements.shell, {.job = options_.job});
    if (!file) return std::move(file).error();
    read_bounds(*file);
    for (std::size_t i = 0; i < elements.texts.size() && issues_.size() < most_errors; ++i) {
      const Result<Json> element = parse_listed(text, elements, i, options_.job);
      if (!element) return element.error();
      read_element(*element, i);
    }
    return made(*file);
  }

 private:
  void read_element(const Json& element, std::size_t index) {
    if (index % 256 == 0) options_.check();
    const std::string pointer = "/elements/" + std::to_string(index);
    if (!element.is_object()) return report(pointer, "expected an object");
    const std::string type = element.value("type", Json("")).is_string() ? element.value("type", "") : "";
    if (type == "node") read_node(element, pointer);
    if (type == "way") read_way(element, pointer);
    if (type == "relation") read_relation(element, pointer);
  }

  Result<Imported> made(const Json& file) {
    const Json remark = file.value("remark", Json());
    if (remark.is_string()) {
      if (std::optional<Error> error = stopped_query(file_, remark.get<std::string>(), {0, "/remark"}, "")) {
        return *std::move(error);
      }
    }
    if (!issues_.empty()) return Error{Code::invalid, std::move(issues_)};
    return scene_of_map(map_of(std::move(file_), options_), "", options_);
  }

  void report(std::string pointer, std::string message) {
    if (issues_.size() < most_errors)
      issues_.emplace_back(IssueKind::invalid_value, std::move(pointer), std::move(message));
  }

  bool identity(const Json& json, const char* name, const std::string& pointer, std::int64_t& id) {
    const auto found = json.find(name);
    if (found != json.end() && found->is_number_integer()) {
      id = found->get<std::int64_t>();
      return true;
    }
    report(pointer, std::string("expected a whole number \"") + name + "\"");
    return false;
  }

  bool position(const Json& json, const std::string& pointer, glm::dvec2& p) {
    const auto longitude = json.find("lon"), latitude = json.find("lat");
    if (longitude == json.end() || latitude == json.end() || !longitude->is_number() ||
        !latitude->is_number()) {
      report(pointer, "expected numbers \"lat\" and \"lon\"");
      return false;
    }
    p = {longitude->get<double>(), latitude->get<double>()};
    if (is_osm_position(p.x, p.y)) return true;
    report(pointer,
           "found a position that is not on Earth: expected lon from -180 to 180 and lat from -90 to 90");
    return false;
  }

  static MapTags tags_of(const Json& json) {
    MapTags tags;
    const auto found = json.find("tags");
    if (found == json.end() || !found->is_object()) return tags;
    for (const auto& [name, value] : found->items()) {
      if (value.is_string()) tags.add(name, value.get<std::string>());
    }
    return tags;
  }

  /// `geometry` of `out geom`; null entries lie outside of the queried box and have no position.
  std::vector<glm::dvec2> geometry_of(const Json& json, const std::string& pointer) {
    std::vector<glm::dvec2> points;
    const auto found = json.find("geometry");
    if (found == json.end() || !found->is_array()) return points;
    for (std::size_t i = 0; i < found->size() && issues_.size() < most_errors; ++i) {
      const Json& each = (*found)[i];
      if (each.is_null()) {
        points.push_back(osm_unknown_point);
        continue;
      }
      glm::dvec2 p{0};
      const std::string at = pointer + "/geometry/" + std::to_string(i);
      if (!each.is_object()) {
        report(at, "expected an object with \"lat\" and \"lon\"");
      } else if (position(each, at, p)) {
        points.push_back(p);
      }
    }
    return points;
  }

  /// `center` of `out center`.
  std::optional<glm::dvec2> center_of(const Json& json, const std::string& pointer) {
    const auto found = json.find("center");
    glm::dvec2 p{0};
    if (found == json.end() || !found->is_object() || !position(*found, pointer + "/center", p))
      return std::nullopt;
    return p;
  }

  /// `bounds` of the editing interface.
  void read_bounds(const Json& file) {
    const Json bounds = file.value("bounds", Json());
    std::array<double, 4> values{};
    constexpr std::array<const char*, 4> names{"minlon", "minlat", "maxlon", "maxlat"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Json value = bounds.is_object() ? bounds.value(names[i], Json()) : Json();
      if (!value.is_number()) return;
      values[i] = value.get<double>();
    }
    if (is_osm_position(values[0], values[1]) && is_osm_position(values[2], values[3]))
      add_bounds(file_.bounds, {{values[0], values[1]}, {values[2], values[3]}});
  }

  void read_node(const Json& json, const std::string& pointer) {
    OsmNode node;
    node.location.pointer = pointer;
    if (!json.contains("lon") && !json.contains("lat")) {
      file_.warnings.add("a node without a position is left out", node.location);
      return;
    }
    if (!identity(json, "id", pointer, node.id) || !position(json, pointer, node.position)) return;
    node.tags = tags_of(json);
    file_.nodes.push_back(std::move(node));
  }

  void read_way(const Json& json, const std::string& pointer) {
    OsmWay way;
    if (!identity(json, "id", pointer, way.id)) return;
    const auto nodes = json.find("nodes");
    if (nodes != json.end() && nodes->is_array()) {
      for (const Json& node : *nodes) {
        if (node.is_number_integer()) way.nodes.push_back(node.get<std::int64_t>());
      }
    }
    way.inline_points = geometry_of(json, pointer);
    way.center = center_of(json, pointer);
    way.tags = tags_of(json);
    way.location.pointer = pointer;
    file_.ways.push_back(std::move(way));
  }

  void read_relation(const Json& json, const std::string& pointer) {
    OsmRelation relation;
    if (!identity(json, "id", pointer, relation.id)) return;
    const auto members = json.find("members");
    if (members != json.end() && members->is_array()) {
      for (std::size_t i = 0; i < members->size(); ++i) {
        const Json& each = (*members)[i];
        const std::string at = pointer + "/members/" + std::to_string(i);
        if (!each.is_object() || each.value("type", Json()) != Json("way")) continue;
        OsmMember member;
        if (!identity(each, "ref", at, member.way)) continue;
        const Json role = each.value("role", Json());
        if (role.is_string()) member.role = osm_role(role.get<std::string>());
        member.inline_points = geometry_of(each, at);
        relation.members.push_back(std::move(member));
      }
    }
    relation.center = center_of(json, pointer);
    relation.tags = tags_of(json);
    relation.location.pointer = pointer;
    file_.relations.push_back(std::move(relation));
  }

  const ImportOptions& options_;
  OsmFile file_;
  std::vector<Issue> issues_;
};

}  // namespace

Result<Imported> import_osm_json(std::string_view text, const ImportOptions& options) {
  if (text.size() > largest_whole_file) {
    const std::optional<ListedObjects> elements = listed_objects(text, "elements");
    // Errors outside of the elements are found in the whole text, for their position.
    if (elements && parse_json(elements->shell, {.job = options.job}))
      return OsmJsonReader(options).read_in_parts(text, *elements);
  }
  Result<Json> file = parse_json(text, {.job = options.job});
  if (!file) return std::move(file).error();
  return OsmJsonReader(options).read(*file);
}

}  // namespace seedmesh
