// Buildings of maps; see map_scene.h. The tags are those of "Simple 3D Buildings" and "Key:building:part" of the
// OpenStreetMap wiki.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/polygon/massing.h"
#include "core/import/foreign_text.h"
#include "core/import/map_footprints.h"
#include "core/import/map_scene.h"
#include "core/import/map_values.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using Name = std::pair<std::string_view, std::string_view>;

// Metres.
constexpr double level_height = 3, thin_roof = 0.3, usual_slope = 35;
constexpr char wall_color[] = "#d9d0c1", flat_roof_color[] = "#a7a39a", sloped_roof_color[] = "#8d5b46";

// Values of roof:shape by the names of massing.h.
constexpr std::array<Name, 34> roof_shapes{{{"flat", "flat"},
                                            {"terrace", "flat"},
                                            {"skillion", "skillion"},
                                            {"shed", "skillion"},
                                            {"lean_to", "skillion"},
                                            {"pent", "skillion"},
                                            {"monopitch", "skillion"},
                                            {"gabled", "gabled"},
                                            {"gable", "gabled"},
                                            {"pitched", "gabled"},
                                            {"saddle", "gabled"},
                                            {"half-hipped", "half_hipped"},
                                            {"half_hipped", "half_hipped"},
                                            {"halfhipped", "half_hipped"},
                                            {"clipped_gable", "half_hipped"},
                                            {"gambrel", "gambrel"},
                                            {"saltbox", "saltbox"},
                                            {"round", "round"},
                                            {"barrel", "round"},
                                            {"arched", "round"},
                                            {"hipped", "hipped"},
                                            {"hip", "hipped"},
                                            {"mansard", "mansard"},
                                            {"pyramidal", "pyramidal"},
                                            {"pyramid", "pyramidal"},
                                            {"tented", "pyramidal"},
                                            {"cone", "pyramidal"},
                                            {"conical", "pyramidal"},
                                            {"spherical", "dome"},
                                            {"dome", "dome"},
                                            {"cupola", "dome"},
                                            {"onion", "onion"},
                                            {"bulbous", "onion"},
                                            {"side_hipped", "hipped"}}};

// Levels of buildings that have neither a height nor levels.
constexpr std::array<std::pair<std::string_view, double>, 14> usual_levels{{{"garage", 1},
                                                                            {"garages", 1},
                                                                            {"carport", 1},
                                                                            {"shed", 1},
                                                                            {"hut", 1},
                                                                            {"cabin", 1},
                                                                            {"kiosk", 1},
                                                                            {"roof", 1},
                                                                            {"greenhouse", 1},
                                                                            {"static_caravan", 1},
                                                                            {"apartments", 4},
                                                                            {"office", 4},
                                                                            {"hotel", 5},
                                                                            {"church", 4}}};

/// Reads a value and warns of one that cannot be read.
template <class Read>
auto value_of(MapConversion& map, const MapFeature& feature, std::initializer_list<std::string_view> names,
              Read read) -> decltype(read(std::string_view())) {
  for (const std::string_view name : names) {
    const std::string_view text = feature.tags.get(name);
    if (text.empty()) continue;
    if (auto value = read(text)) return value;
    map.warnings.add(
        "\"" + shortened(text, 40) + "\" is no value of " + std::string(name) + "; it is left out",
        feature.position);
  }
  return {};
}

/// The heights of a building in metres above the ground.
struct Heights {
  double base = 0, top = 0, roof = 0;
};

class BuildingWriter {
 public:
  BuildingWriter(MapConversion& map, const MapBody& body) : map_(map), body_(body), feature_(*body.feature) {}

  Json write() {
    const std::string_view shape = shape_of();
    MassOptions options = options_of(shape);
    const Heights heights = heights_of(options);
    Json made = Json::object();
    if (!feature_.name.empty()) made["name"] = feature_.name;
    made["footprint"] = map_.rings(body_.plan);
    made["height"] = metres(heights.top);
    if (heights.base > 0) made["base"] = metres(heights.base);
    const std::string_view material = material_of({"building:material", "building:facade:material"});
    if (const std::string_view surface = map_surface(material); surface != "plain")
      made["material"] = surface;
    made["color"] = color_of({"building:colour", "building:color"}, material, wall_color);
    Json roof = {{"color", color_of({"roof:colour", "roof:color"}, material_of({"roof:material"}),
                                    shape == "flat" ? flat_roof_color : sloped_roof_color)}};
    if (heights.roof > 0) {
      roof["shape"] = shape;
      roof["height"] = metres(heights.roof);
      if (direction_) {
        roof["direction"] = *direction_;
      } else if (options.across) {
        roof["orientation"] = "across";
      }
    }
    made["roof"] = std::move(roof);
    return made;
  }

 private:
  static double metres(double value) { return std::floor(value * 1000 + 0.5) / 1000; }

  std::optional<double> length(std::initializer_list<std::string_view> names) {
    return value_of(map_, feature_, names, map_length);
  }
  std::optional<double> number(std::initializer_list<std::string_view> names) {
    return value_of(map_, feature_, names, map_number);
  }

  std::string_view shape_of() {
    const std::string_view text = feature_.tags.get({"roof:shape", "building:roof:shape", "building:roof"});
    if (text.empty()) return "flat";
    std::string plain = lower(text);
    std::replace(plain.begin(), plain.end(), ' ', '_');
    for (const auto& [name, shape] : roof_shapes) {
      if (name == plain) return shape;
    }
    map_.warnings.add("roof:shape=" + shortened(text, 40) + " has no counterpart; the roof is flat",
                      feature_.position);
    return "flat";
  }

  MassOptions options_of(std::string_view shape) {
    MassOptions options;
    for (std::size_t i = 0; i < mass_roof_names.size(); ++i) {
      if (mass_roof_names[i] == shape) options.roof = static_cast<MassRoof>(i);
    }
    if (options.roof == MassRoof::flat) return options;
    direction_ = value_of(map_, feature_, {"roof:direction", "roof:slope:direction"}, map_direction);
    if (direction_) {
      const math::SinCos at = math::sincos_degrees(*direction_);
      options.direction = dvec2(at.sin, at.cos);
    }
    options.across = feature_.tags.is("roof:orientation", "across");
    return options;
  }

  /// The height of the roof alone; nullopt where no tag states it.
  std::optional<double> stated_roof(const MassOptions& options) {
    const auto height = length({"roof:height", "building:roof:height"});
    if (height && *height > 0) return height;
    const auto angle = value_of(map_, feature_, {"roof:angle", "building:roof:angle"}, map_degrees);
    if (angle && *angle > 0 && *angle < 85)
      return roof_height_at(body_.plan, options, math::radians(*angle), map_.job);
    const auto levels = number({"roof:levels", "building:roof:levels"});
    if (levels && *levels > 0) return *levels * level_height;
    return std::nullopt;
  }

  Heights heights_of(const MassOptions& options) {
    Heights heights;
    const auto top = length({"height", "building:height", "est_height"});
    const auto levels = number({"building:levels"});
    const auto base_levels = number({"building:min_level", "min_level"});
    heights.base = std::max(
        length({"min_height", "building:min_height"}).value_or(base_levels.value_or(0) * level_height), 0.0);
    const bool is_flat = options.roof == MassRoof::flat;
    const std::optional<double> stated = is_flat ? std::nullopt : stated_roof(options);
    double usual = 0;
    if (!is_flat && !stated) {
      const bool is_tall = options.roof == MassRoof::dome || options.roof == MassRoof::round;
      const double angle = is_tall ? 45 : options.roof == MassRoof::onion ? 60 : usual_slope;
      usual = roof_height_at(body_.plan, options,
                             math::radians(options.roof == MassRoof::skillion ? 10 : angle), map_.job);
    }
    if (top && *top > 0) {
      heights.top = *top;
      heights.roof = stated ? *stated : std::min(usual, (heights.top - heights.base) / 2);
    } else {
      const double count = levels && *levels > 0 ? *levels : usual_number_of_levels(base_levels);
      const double walls = std::max(count * level_height, heights.base + (stated ? 0 : level_height));
      heights.roof = stated ? *stated : std::min(usual, walls);
      heights.top = walls + heights.roof;
    }
    check(heights, options);
    return heights;
  }

  double usual_number_of_levels(std::optional<double> base_levels) {
    map_.warnings.add("a building without height and levels gets the usual levels of its kind, 3 m each",
                      feature_.position);
    const std::string_view kind = feature_.tags.get({"building:part", "building"});
    double count = 2;
    for (const auto& [name, levels] : usual_levels) {
      if (name == kind) count = levels;
    }
    return std::max(count, base_levels.value_or(0) + 1);
  }

  void check(Heights& heights, const MassOptions& options) {
    constexpr double tallest = 10'000;
    if (heights.top > tallest) {
      map_.warnings.add("a height above 10 km is reduced to 10 km", feature_.position);
      heights.top = tallest;
    }
    if (options.roof == MassRoof::flat && feature_.tags.is("building", "roof") && heights.base == 0)
      heights.base = std::max(heights.top - thin_roof, 0.0);
    heights.top = std::max(metres(heights.top), 0.001);
    heights.base = metres(heights.base);
    if (heights.base >= heights.top) {
      map_.warnings.add("min_height is not below height; it is left out", feature_.position);
      heights.base = 0;
    }
    if (metres(heights.roof) > metres(heights.top - heights.base)) {
      map_.warnings.add("the roof is higher than the building; it is reduced to its height",
                        feature_.position);
      heights.roof = heights.top - heights.base;
    }
    heights.roof = metres(heights.roof);
  }

  std::string_view inherited(std::initializer_list<std::string_view> names) const {
    const std::string_view own = feature_.tags.get(names);
    return own.empty() && body_.outline ? body_.outline->tags.get(names) : own;
  }

  std::string_view material_of(std::initializer_list<std::string_view> names) const {
    const std::string_view text = inherited(names);
    return text.substr(0, text.find(';'));
  }

  std::string color_of(std::initializer_list<std::string_view> names, std::string_view material,
                       std::string_view otherwise) {
    const std::string_view text = inherited(names);
    if (!text.empty()) {
      if (const auto color = map_color(text.substr(0, text.find(';')))) return *color;
      map_.warnings.add("\"" + shortened(text, 40) + "\" is no colour of CSS; the usual colour is used",
                        feature_.position);
    }
    if (material.empty()) return std::string(otherwise);
    const std::string_view color = map_material_color(material);
    if (color.empty()) {
      map_.warnings.add(
          "the material " + shortened(material, 40) + " has no colour here; the usual colour is used",
          feature_.position);
    }
    return std::string(color.empty() ? otherwise : color);
  }

  MapConversion& map_;
  const MapBody& body_;
  const MapFeature& feature_;
  std::optional<double> direction_;
};

}  // namespace

std::vector<bool> add_buildings(MapConversion& map, const MapData& data) {
  std::vector<bool> is_building(data.features.size(), false);
  const std::vector<MapBody> bodies = map_bodies(map, data, is_building);
  constexpr std::size_t most_buildings = 100'000;
  for (const MapBody& body : bodies) {
    if (body.is_hidden) continue;
    if (map.buildings.size() >= most_buildings) {
      map.warnings.add("more than 100,000 buildings; the others are left out", body.feature->position);
      continue;
    }
    map.buildings.push_back(BuildingWriter(map, body).write());
  }
  return is_building;
}

}  // namespace seedmesh
