#include "core/generators/city/geojson.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>
#include <utility>

namespace seedmesh::city {
namespace {

constexpr std::size_t most_features = 20'000, most_positions = 500'000, most_issues = 50;
constexpr int deepest = 8;               // of geometry collections
constexpr double most_metres = 1e6;      // of a coordinate
constexpr double extent_of_degrees = 1;  // a map with a smaller extent is taken for one in degrees

constexpr std::array<std::string_view, 7> geometry_types{
    "Point", "MultiPoint", "LineString", "MultiLineString", "Polygon", "MultiPolygon", "GeometryCollection"};

std::string type_of(const Json& object) {
  const auto found = object.find("type");
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

class Reader {
 public:
  Reader(GeoKind kind, std::string pointer, const GeoReport& report)
      : kind_(kind), pointer_(std::move(pointer)), report_(report) {}

  std::vector<GeoFeature> read(const Json& json) {
    const std::string type = type_of(json);
    if (type == "FeatureCollection") {
      read_collection(json);
    } else if (type == "Feature") {
      read_feature(json, pointer_);
    } else {
      add(json, {pointer_, pointer_, Json::object(), {}, {}});
    }
    finish();
    return std::move(features_);
  }

 private:
  void refuse(IssueCause cause, std::string pointer, std::string message) {
    if (found_.size() < most_issues)
      found_.emplace_back(std::move(cause), std::move(pointer), std::move(message));
  }

  void read_collection(const Json& json) {
    const auto list = json.find("features");
    if (list == json.end()) {
      return refuse(missing_for({"features", "type"}), pointer_,
                    "found no member \"features\", expected a list of features");
    }
    if (!list->is_array())
      return refuse(IssueKind::wrong_type, pointer_ + "/features", "expected a list of features");
    if (list->size() > most_features) {
      return refuse(IssueKind::out_of_range, pointer_ + "/features",
                    "found " + std::to_string(list->size()) + " features, expected at most " +
                        std::to_string(most_features));
    }
    for (std::size_t i = 0; i < list->size(); ++i)
      read_feature((*list)[i], pointer_ + "/features/" + std::to_string(i));
  }

  void read_feature(const Json& json, const std::string& pointer) {
    if (!json.is_object() || type_of(json) != "Feature")
      return refuse(IssueKind::invalid_value, pointer, "expected an object with \"type\": \"Feature\"");
    const auto properties = json.find("properties");
    const bool has_properties = properties != json.end() && !properties->is_null();
    if (has_properties && !properties->is_object())
      return refuse(IssueKind::wrong_type, pointer + "/properties", "expected an object or null");
    const auto geometry = json.find("geometry");
    if (geometry == json.end()) {
      return refuse(missing_for({"geometry", "type"}), pointer,
                    "found no member \"geometry\", expected a geometry or null");
    }
    if (geometry->is_null()) return;
    add(*geometry, {pointer, pointer + "/geometry", has_properties ? *properties : Json::object(), {}, {}});
  }

  void add(const Json& geometry, GeoFeature feature) {
    read_geometry(geometry, feature.geometry, feature, 0);
    if (!feature.lines.empty() || !feature.polygons.empty()) features_.push_back(std::move(feature));
  }

  void read_geometry(const Json& json, const std::string& pointer, GeoFeature& feature, int depth) {
    const std::string type = json.is_object() ? type_of(json) : std::string();
    if (std::find(geometry_types.begin(), geometry_types.end(), type) == geometry_types.end()) {
      return refuse(IssueKind::invalid_value, pointer,
                    "found " + (type.empty() ? "no type" : "the type \"" + shortened(type, 40) + "\"") +
                        ", expected " + (pointer == pointer_ ? "FeatureCollection, Feature or " : "") +
                        "a geometry of GeoJSON");
    }
    const bool is_collection = type == "GeometryCollection";
    const char* name = is_collection ? "geometries" : "coordinates";
    const auto content = json.find(name);
    if (content == json.end() || !content->is_array()) {
      return refuse(content == json.end() ? missing_for({name, "type"}) : IssueKind::wrong_type, pointer,
                    std::string("expected a list \"") + name + "\"");
    }
    const std::string at = pointer + "/" + name;
    if (is_collection && depth == deepest)
      return refuse(IssueKind::out_of_range, pointer, "found geometry collections more than 8 deep");
    if (is_collection) {
      each(*content, at,
           [&](const Json& one, const std::string& where) { read_geometry(one, where, feature, depth + 1); });
      return;
    }
    read_coordinates(*content, at, type, feature);
  }

  void read_coordinates(const Json& json, const std::string& pointer, const std::string& type,
                        GeoFeature& feature) {
    if (json.empty()) return;
    const bool is_line = type.ends_with("LineString"), is_polygon = type.ends_with("Polygon");
    if (!(kind_ == GeoKind::lines ? is_line : is_polygon)) {
      if (others_++ == 0) other_ = {pointer.substr(0, pointer.rfind('/')), type};
      return;
    }
    const auto read = [&](const Json& one, const std::string& where) {
      return is_line ? add_line(one, where, feature) : add_polygon(one, where, feature);
    };
    if (type.starts_with("Multi")) {
      each(json, pointer, read);
    } else {
      read(json, pointer);
    }
  }

  template <class Read>
  void each(const Json& json, const std::string& pointer, const Read& read) {
    if (!json.is_array()) return refuse(IssueKind::wrong_type, pointer, "expected a list");
    for (std::size_t i = 0; i < json.size() && found_.size() < most_issues; ++i)
      read(json[i], pointer + "/" + std::to_string(i));
  }

  CmRing read_positions(const Json& json, const std::string& pointer) {
    CmRing line;
    each(json, pointer, [&](const Json& position, const std::string& where) {
      const bool is_position = position.is_array() && position.size() >= 2 &&
                               std::all_of(position.begin(), position.end(),
                                           [](const Json& number) { return number.is_number(); });
      if (!is_position)
        return refuse(IssueKind::wrong_type, where, "expected a position: a list of two or three numbers");
      if (++positions_ > most_positions) {
        if (positions_ == most_positions + 1) {
          refuse(IssueKind::out_of_range, pointer_,
                 "found more than " + std::to_string(most_positions) + " positions");
        }
        return;
      }
      const glm::dvec2 p(position[0].get<double>(), position[1].get<double>());
      if (!(std::abs(p.x) <= most_metres && std::abs(p.y) <= most_metres)) {
        return refuse(IssueKind::out_of_range, where,
                      "found a position beyond 1,000 km; expected metres east and north, about the origin of "
                      "the area");
      }
      low_ = has_positions_ ? glm::min(low_, p) : p;
      high_ = has_positions_ ? glm::max(high_, p) : p;
      has_positions_ = true;
      const CmPoint point = rounded_cm(p * 100.0);
      if (line.empty() || line.back() != point) line.push_back(point);
    });
    return line;
  }

  bool has_corners(const CmRing& line, std::size_t least, const std::string& pointer) {
    if (line.size() >= least) return true;
    refuse(IssueKind::invalid_value, pointer,
           "found " + std::to_string(line.size()) + " different corners, expected at least " +
               std::to_string(least));
    return false;
  }

  void add_line(const Json& json, const std::string& pointer, GeoFeature& feature) {
    if (json.is_array() && json.empty()) return;
    const std::size_t before = found_.size();
    CmRing line = read_positions(json, pointer);
    if (found_.size() == before && has_corners(line, 2, pointer)) feature.lines.push_back(std::move(line));
  }

  void add_polygon(const Json& json, const std::string& pointer, GeoFeature& feature) {
    Rings rings;
    each(json, pointer, [&](const Json& positions, const std::string& where) {
      if (positions.is_array() && positions.empty()) return;
      const std::size_t before = found_.size();
      CmRing ring = read_positions(positions, where);
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
      if (found_.size() == before && has_corners(ring, 3, where)) rings.push_back(std::move(ring));
    });
    if (!rings.empty()) feature.polygons.push_back(std::move(rings));
  }

  /// Degrees of a town have a small extent. Other errors follow from them.
  void check_unit() {
    const glm::dvec2 extent = high_ - low_;
    const bool is_small = extent.x < extent_of_degrees && extent.y < extent_of_degrees;
    const bool is_in_degrees =
        low_.x >= -180 && high_.x <= 180 && low_.y >= -90 && high_.y <= 90 && positions_ > 1;
    if (!has_positions_ || !is_small || !is_in_degrees) return;
    found_ = {{IssueKind::invalid_value, pointer_,
               "found positions from " + number_text(low_.x) + ", " + number_text(low_.y) + " to " +
                   number_text(high_.x) + ", " + number_text(high_.y) +
                   ", which look like degrees of longitude and latitude; expected metres east and north of "
                   "the origin, as a projected coordinate system has them"}};
  }

  void finish() {
    check_unit();
    if (found_.empty() && others_ > 0) {
      const std::string wanted =
          kind_ == GeoKind::lines ? "LineString or MultiLineString" : "Polygon or MultiPolygon";
      if (features_.empty()) {
        refuse(IssueKind::invalid_value, other_.first, "found " + other_.second + ", expected " + wanted);
      } else if (report_.warnings) {
        report_.warnings->push_back(
            {other_.first, std::to_string(others_) + (others_ == 1 ? " geometry is" : " geometries are") +
                               " left out, the first a " + other_.second + "; expected " + wanted});
      }
    }
    report_.issues.insert(report_.issues.end(), found_.begin(), found_.end());
  }

  GeoKind kind_;
  std::string pointer_;
  const GeoReport& report_;
  std::vector<GeoFeature> features_;
  std::vector<Issue> found_;
  std::size_t positions_ = 0, others_ = 0;
  std::pair<std::string, std::string> other_;  // pointer and type of the first geometry of another kind
  bool has_positions_ = false;
  glm::dvec2 low_{0}, high_{0};
};

/// Reads a number as OpenStreetMap writes lengths: "6", "6.5 m", "20 ft", "20'". Of "3;4" the first counts.
std::optional<double> metres_of(std::string_view text) {
  constexpr double foot = 0.3048;
  text = text.substr(0, text.find(';'));
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  while (unit.ends_with(' ')) unit.remove_suffix(1);
  if (unit.empty() || unit == "m") return value;
  if (unit == "ft" || unit == "'") return value * foot;
  return std::nullopt;
}

}  // namespace

std::vector<GeoFeature> features_of(const GeoJson& value, GeoKind kind, const std::string& pointer,
                                    const GeoReport& report) {
  return Reader(kind, pointer, report).read(Json::parse(value.text));
}

std::vector<Rings> polygons_of(const GeoJson& value, const std::string& pointer, const GeoReport& report) {
  std::vector<Rings> all;
  for (GeoFeature& each : features_of(value, GeoKind::polygons, pointer, report)) {
    all.insert(all.end(), std::make_move_iterator(each.polygons.begin()),
               std::make_move_iterator(each.polygons.end()));
  }
  return all;
}

const Json* first_property(const GeoFeature& feature, const char* name) {
  const auto at = feature.properties.find(name);
  if (at == feature.properties.end()) return nullptr;
  const Json& value = at->is_array() && !at->empty() ? at->front() : *at;
  return value.is_null() ? nullptr : &value;
}

std::optional<double> number_property(const GeoFeature& feature, const char* name,
                                      std::vector<Issue>& issues) {
  const Json* found = first_property(feature, name);
  if (!found) return std::nullopt;
  if (found->is_number()) return found->get<double>();
  if (found->is_string()) {
    if (const std::optional<double> value = metres_of(found->get_ref<const std::string&>())) return value;
  }
  issues.emplace_back(IssueKind::wrong_type, feature.pointer + "/properties/" + name,
                      "expected a number, or a text of a number and `m`, `ft` or `'`");
  return std::nullopt;
}

}  // namespace seedmesh::city
