#include "core/generators/scene/unused.h"

#include <algorithm>
#include <string>

#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/rules.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

class Finder {
 public:
  Finder(const SceneParams& params, Purpose purpose, const Demand* demand)
      : params_(params), purpose_(purpose), demand_(demand) {}

  std::vector<Warning> find() {
    of_models("age", params_.age.has_value());
    of_models("season", params_.season.has_value());
    find_words();
    find_ground();
    for (std::size_t i = 0; i < params_.paths.size(); ++i)
      find_path(params_.paths[i], "/paths/" + std::to_string(i));
    for (std::size_t i = 0; i < params_.layers.size(); ++i) find_layer(i, "/layers/" + std::to_string(i));
    const bool has_crown =
        std::ranges::any_of(params_.layers, [](const SceneLayer& each) { return each.crown > 0; });
    warn(params_.competition > 0 && !has_crown, "/competition", "no layer has a `crown`");
    warn(params_.chunks > 1 && params_.layers.empty(), "/chunks", "there are no layers");
    return std::move(warnings_);
  }

 private:
  void warn(bool is_unused, std::string pointer, const std::string& reason) {
    if (is_unused) warnings_.push_back({std::move(pointer), "has no effect: " + reason});
  }

  void of_models(const char* name, bool is_given) {
    const auto has_it = [name](const std::string& generator) { return has_parameter(generator, name); };
    if (is_given && !any_generator(params_, has_it))
      warnings_.push_back({"/" + std::string(name), "no model has the parameter " + std::string(name)});
  }

  void find_words() {
    if (!params_.words) return;
    if (purpose_ != Purpose::derivation) {
      warnings_.push_back({"/words", "has an effect on the response of derive only"});
    } else if (!any_generator(params_, [](const std::string& name) { return name == "lsystem"; })) {
      warn(true, "/words", "no model is an L-system");
    }
  }

  void find_ground() {
    if (!params_.ground || params_.ground->outline != SceneOutline::none) return;
    const SceneGround plain;
    const char* const reason = "`outline` is none";
    warn(params_.ground->color != plain.color, "/ground/color", reason);
    warn(params_.ground->specular.has_value(), "/ground/specular", reason);
    warn(params_.ground->emission.has_value(), "/ground/emission", reason);
  }

  void find_path(const ScenePath& path, const std::string& pointer) {
    if (path.shown) return;
    const ScenePath plain;
    const char* const reason = "the path is not shown";
    warn(path.color != plain.color, pointer + "/color", reason);
    warn(path.specular.has_value(), pointer + "/specular", reason);
    warn(path.emission.has_value(), pointer + "/emission", reason);
  }

  /// `is_zero`: the limited quantity is 0 everywhere.
  template <class Limits>
  void find_limits(const Limits& limits, const std::string& pointer, bool is_zero, const char* reason) {
    if (!limits) return;
    if (!limits->from && !limits->to) {
      warn(true, pointer, "neither `from` nor `to` is given");
    } else {
      warn(is_zero && share_of_limits(*limits, 0) == 1, pointer, reason);
    }
  }

  void find_layer(std::size_t number, const std::string& pointer) {
    const SceneLayer& layer = params_.layers[number];
    const auto has_crown = [](const SceneLayer& each) { return each.crown > 0; };
    const auto first = params_.layers.begin(), own = first + static_cast<std::ptrdiff_t>(number);
    const bool is_level = !params_.terrain;
    const char* const level = "the ground is level";
    const ScenePlace& place = layer.place;
    find_limits(place.slope, pointer + "/place/slope", is_level, level);
    find_limits(place.altitude, pointer + "/place/altitude", is_level, level);
    find_limits(place.above_water, pointer + "/place/above_water", false, "");
    find_limits(place.shade, pointer + "/place/shade", !std::any_of(first, own, has_crown),
                "no earlier layer has a `crown`");
    warn(place.side != SceneSide::both && place.offset == 0, pointer + "/place/side", "`offset` is 0");
    warn(layer.upright < 1 && is_level, pointer + "/upright", level);
    const bool shades = std::any_of(own + 1, params_.layers.end(),
                                    [](const SceneLayer& each) { return each.place.shade.has_value(); });
    warn(layer.crown > 0 && params_.competition == 0 && !shades, pointer + "/crown",
         "`competition` is 0, and no later layer has limits of `shade`");
    if (layer.start && demand_ && !demand_->growth)
      warn(true, pointer + "/start", "`output.animation` is not growth");
  }

  const SceneParams& params_;
  Purpose purpose_;
  const Demand* demand_;
  std::vector<Warning> warnings_;
};

}  // namespace

std::vector<Warning> unused_settings(const SceneParams& params, Purpose purpose, const Demand* demand) {
  return Finder(params, purpose, demand).find();
}

}  // namespace seedmesh::scene
