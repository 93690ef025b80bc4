// Reads OpenStreetMap: XML as the editing interface, JOSM and Overpass write it. osm_json.cpp reads the JSON of Overpass.
#include <charconv>
#include <cstring>
#include <pugixml.hpp>

#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/map_scene.h"
#include "core/import/osm_data.h"
#include "core/import/osm_json.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_errors = 100;

template <class Number>
bool read_number(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

class OsmXmlReader {
 public:
  OsmXmlReader(std::string_view text, const ImportOptions& options) : text_(text), options_(options) {}

  Result<Imported> read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!parsed) {
      const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.offset, 0));
      return Error{Code::malformed,
                   {issue_at(IssueKind::syntax, "", text_, std::min(offset, text_.size()),
                             std::string("this is no XML: ") + parsed.description())}};
    }
    if (const pugi::xml_node change = document.child("osmChange")) {
      return Error{
          Code::invalid,
          {issue_at(IssueKind::not_available, "", text_, location_of(change).offset,
                    "found a list of changes (<osmChange>), which is no map; expected the element <osm> "
                    "of OpenStreetMap")}};
    }
    const pugi::xml_node root = document.child("osm");
    if (!root) {
      return Error{
          Code::invalid,
          {issue_at(IssueKind::invalid_value, "", text_, 0, "expected the element <osm> of OpenStreetMap")}};
    }
    std::size_t elements = 0;
    for (const pugi::xml_node element : root.children()) {
      if (++elements % 256 == 0) options_.check();
      const std::string_view name = element.name();
      if (std::string_view(element.attribute("action").value()) == "delete" ||
          std::string_view(element.attribute("visible").value()) == "false")
        continue;
      if (name == "node") read_node(element);
      if (name == "way") read_way(element);
      if (name == "relation") read_relation(element);
      if (name == "bounds") read_bounds(element);
      if (name == "remark") {
        if (std::optional<Error> error =
                stopped_query(file_, element.child_value(), location_of(element), text_)) {
          return *std::move(error);
        }
      }
    }
    if (!issues_.empty()) return Error{Code::invalid, std::move(issues_)};
    return scene_of_map(map_of(std::move(file_), options_), text_, options_);
  }

 private:
  static MapPosition location_of(const pugi::xml_node& element) {
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(element.offset_debug(), 0)), ""};
  }

  void report(const pugi::xml_node& element, std::string message) {
    if (issues_.size() < most_errors) {
      issues_.push_back(
          issue_at(IssueKind::invalid_value, "", text_, location_of(element).offset, std::move(message)));
    }
  }

  template <class Number>
  bool attribute(const pugi::xml_node& element, const char* name, Number& number) {
    const std::string_view value = element.attribute(name).value();
    if (read_number(value, number)) return true;
    report(element, std::string("found ") + (value.empty() ? "no" : "no number in the") + " attribute \"" +
                        name + "\" of <" + element.name() + ">");
    return false;
  }

  bool position(const pugi::xml_node& element, glm::dvec2& p) {
    if (!attribute(element, "lon", p.x) || !attribute(element, "lat", p.y)) return false;
    if (is_osm_position(p.x, p.y)) return true;
    report(element,
           "found a position that is not on Earth: expected lon from -180 to 180 and lat from -90 to 90");
    return false;
  }

  static MapTags tags_of(const pugi::xml_node& element) {
    MapTags tags;
    for (const pugi::xml_node tag : element.children("tag"))
      tags.add(tag.attribute("k").value(), tag.attribute("v").value());
    return tags;
  }

  void read_bounds(const pugi::xml_node& element) {
    MapBounds bounds;
    if (!attribute(element, "minlon", bounds.min.x) || !attribute(element, "minlat", bounds.min.y) ||
        !attribute(element, "maxlon", bounds.max.x) || !attribute(element, "maxlat", bounds.max.y))
      return;
    if (is_osm_position(bounds.min.x, bounds.min.y) && is_osm_position(bounds.max.x, bounds.max.y))
      add_bounds(file_.bounds, bounds);
  }

  void read_node(const pugi::xml_node& element) {
    OsmNode node;
    node.location = location_of(element);
    if (!element.attribute("lon") && !element.attribute("lat")) {
      file_.warnings.add("a node without a position is left out", node.location);
      return;
    }
    if (!attribute(element, "id", node.id) || !position(element, node.position)) return;
    node.tags = tags_of(element);
    file_.nodes.push_back(std::move(node));
  }

  /// The points of `out geom`; those outside of the queried box have no position.
  std::vector<glm::dvec2> inline_points(const pugi::xml_node& element) {
    std::vector<glm::dvec2> points;
    bool has_positions = false;
    for (const pugi::xml_node nd : element.children("nd")) {
      glm::dvec2 p = osm_unknown_point;
      if (nd.attribute("lat")) {
        has_positions = true;
        if (!position(nd, p)) continue;
      }
      points.push_back(p);
    }
    return has_positions ? points : std::vector<glm::dvec2>();
  }

  void read_way(const pugi::xml_node& element) {
    OsmWay way;
    if (!attribute(element, "id", way.id)) return;
    for (const pugi::xml_node nd : element.children("nd")) {
      std::int64_t node = 0;
      if (nd.attribute("ref") && attribute(nd, "ref", node)) way.nodes.push_back(node);
    }
    way.inline_points = inline_points(element);
    way.tags = tags_of(element);
    way.location = location_of(element);
    file_.ways.push_back(std::move(way));
  }

  void read_relation(const pugi::xml_node& element) {
    OsmRelation relation;
    if (!attribute(element, "id", relation.id)) return;
    for (const pugi::xml_node each : element.children("member")) {
      if (std::strcmp(each.attribute("type").value(), "way") != 0) continue;
      OsmMember member;
      if (!attribute(each, "ref", member.way)) continue;
      member.role = osm_role(each.attribute("role").value());
      member.inline_points = inline_points(each);
      relation.members.push_back(std::move(member));
    }
    relation.tags = tags_of(element);
    relation.location = location_of(element);
    file_.relations.push_back(std::move(relation));
  }

  std::string_view text_;
  const ImportOptions& options_;
  OsmFile file_;
  std::vector<Issue> issues_;
};

bool begins_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

int marks_of_osm(std::string_view text) {
  if (begins_json(text)) {
    const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
    const bool is_named = has("\"way\"") || has("\"node\"") || has("\"relation\"") || has("\"osm3s\"");
    return is_named && has("\"elements\"") ? 100 : 0;
  }
  return text.substr(0, 4096).find("<osm") != std::string_view::npos ? 100 : 0;
}

Result<Imported> import_osm(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of OpenStreetMap contains one map"))
    return *std::move(error);
  if (begins_json(text)) return import_osm_json(text, options);
  return OsmXmlReader(text, options).read();
}

}  // namespace seedmesh
