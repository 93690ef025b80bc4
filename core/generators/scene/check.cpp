/// Checks of a scene that the schema cannot express.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/scene/buildings.h"
#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/scene.h"
#include "core/schema/nearest.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::string_view own_name = "scene", ground_name = "terrain";
constexpr std::string_view png_head = "data:image/png;base64,";

/// Collects the errors below a pointer.
class Checker {
 public:
  Checker(const SceneParams& params, const CheckContext& context) : params_(params), context_(context) {}

  std::vector<Issue> check() {
    check_ground();
    for (std::size_t i = 0; i < params_.paths.size(); ++i) {
      if (i % 1024 == 0) context_.job.check();
      check_line(params_.paths[i].points, "/paths/" + std::to_string(i) + "/points");
    }
    for (std::size_t i = 0; i < params_.layers.size(); ++i) check_layer(i);
    check_outlines(params_, context_.job, issues_);
    const std::size_t variants = count_variants(params_);
    if (variants > most_variants) {
      add(IssueKind::out_of_range, "/layers",
          "found " + std::to_string(variants) + " models, including variants and models of positions; " +
              "expected at most " + std::to_string(most_variants));
    }
    return std::move(issues_);
  }

 private:
  void add(IssueCause cause, std::string pointer, std::string message) {
    issues_.emplace_back(std::move(cause), std::move(pointer), std::move(message));
  }

  void check_ground() {
    if (!params_.terrain) return;
    if (params_.ground)
      add(conflict_with({"terrain"}), "/ground", "found both `terrain` and `ground`; expected one of them");
    const Child& terrain = *params_.terrain;
    if (terrain.generator.empty()) return;
    if (terrain.generator != ground_name) {
      add(IssueKind::invalid_value, "/terrain/generator",
          "found " + terrain.generator + "; expected terrain");
      return;
    }
    const Json parameters = Json::parse(terrain.parameters);
    if (const std::string shape = parameters.value("shape", "plane"); shape != "plane") {
      add(IssueKind::not_available, "/terrain/parameters/shape",
          "found a " + shape + "; the ground of a scene is a plane");
    }
    if (parameters.contains("onto")) {
      add(IssueKind::not_available, "/terrain/parameters/onto",
          "the ground of a scene cannot follow a model");
    }
    const bool has_foundations = std::ranges::any_of(
        params_.layers, [](const SceneLayer& layer) { return layer.foundation.has_value(); });
    if (parameters.contains("refine") &&
        (has_foundations || !params_.paths.empty() || !params_.buildings.empty())) {
      add(conflict_with({"layers", "paths", "buildings"}), "/terrain/parameters/refine",
          "paths, buildings and foundations lie on the squares of the grid; expected a scene without them");
    }
  }

  /// Refuses a scene inside the request, at any depth.
  void check_child(const Child& child, const std::string& pointer) {
    if (child.generator == own_name) {
      add(IssueKind::not_available, pointer + "/generator", "found a scene; scenes cannot be nested");
      return;
    }
    const Generator* generator = find_generator(context_.generators, child.generator);
    if (!generator) return;
    IssueList errors;
    generator->read(Json::parse(child.parameters), "", errors, [&](const ChildLocation& location) {
      check_child(*location.child, pointer + "/parameters" + location.pointer);
    });
  }

  template <class Points>
  void check_line(const Points& points, const std::string& pointer) {
    const bool is_long =
        std::adjacent_find(points.begin(), points.end(), std::not_equal_to<>()) != points.end();
    if (!is_long) add(IssueKind::invalid_value, pointer, "all points are equal; expected a line");
  }

  void check_layer(std::size_t number) {
    const SceneLayer& layer = params_.layers[number];
    const std::string pointer = "/layers/" + std::to_string(number);
    if (layer.name) {
      for (std::size_t i = 0; i < number; ++i) {
        if (params_.layers[i].name != layer.name) continue;
        add(IssueKind::duplicate_key, pointer + "/name",
            "found " + *layer.name + ", which is the name of layer " + std::to_string(i));
        break;
      }
    }
    check_child(layer.model, pointer + "/model");
    check_span(layer.scale, pointer + "/scale");
    check_span(layer.turn, pointer + "/turn");
    if (layer.age) check_span(*layer.age, pointer + "/age");
    if (layer.age && !layer.model.generator.empty() &&
        find_generator(context_.generators, layer.model.generator) &&
        !has_parameter(layer.model.generator, "age"))
      add(IssueKind::not_available, pointer + "/age", layer.model.generator + " has no parameter age");
    if (layer.start) check_span(*layer.start, pointer + "/start");
    const Generator* generator = find_generator(context_.generators, layer.model.generator);
    if (layer.start && generator && !generator->grows)
      add(IssueKind::not_available, pointer + "/start", layer.model.generator + " does not grow");
    if (layer.foundation && !layer.footprint) {
      add(conflict_with({"footprint"}), pointer + "/foundation",
          "a foundation needs a footprint, and the layer has none");
    }
    for (std::size_t i = 0; i < layer.vary.size(); ++i)
      check_variation(layer.model, layer.vary[i], pointer + "/vary/" + std::to_string(i));
    check_place(layer, number, pointer + "/place");
  }

  void check_span(const std::variant<double, std::array<double, 2>>& given, const std::string& pointer) {
    const auto* both = std::get_if<1>(&given);
    if (both && (*both)[0] > (*both)[1])
      add(IssueKind::out_of_range, pointer, "the first value is above the second; expected [from, to]");
  }

  /// Checks both ends of a range, or every value, with the model.
  void check_variation(const Child& model, const SceneVariation& variation, const std::string& pointer) {
    const bool has_range = variation.from.has_value() || variation.to.has_value();
    if (has_range == variation.among.has_value() ||
        (has_range && !(variation.from.has_value() && variation.to.has_value()))) {
      add(conflict_with({"from", "to", "among"}), pointer, "expected either `from` and `to`, or `among`");
      return;
    }
    if (has_range && *variation.from > *variation.to) {
      add(IssueKind::out_of_range, pointer + "/from", "`from` is greater than `to`");
      return;
    }
    const Generator* generator = find_generator(context_.generators, model.generator);
    if (!generator) return;
    if (!has_parameter(model.generator, variation.parameter)) {
      add(IssueKind::unknown_name, pointer + "/parameter",
          model.generator + " has no parameter \"" + shortened(variation.parameter, 40) + "\"");
      return;
    }
    if (variation.among) {
      for (std::size_t i = 0; i < variation.among->size(); ++i) {
        const Json value = std::visit([](const auto& each) { return Json(each); }, (*variation.among)[i]);
        try_value(*generator, model, variation.parameter, value, pointer + "/among/" + std::to_string(i));
      }
      return;
    }
    try_value(*generator, model, variation.parameter, Json(*variation.from), pointer + "/from");
    try_value(*generator, model, variation.parameter, Json(*variation.to), pointer + "/to");
  }

  void try_value(const Generator& generator, const Child& model, const std::string& path, const Json& value,
                 const std::string& pointer) {
    IssueList errors;
    const Json parameters = Json::parse(with_parameter(model.parameters, path, value.dump()));
    const Generator::Params params = generator.read(parameters, "", errors, {});
    std::vector<Issue> issues = errors.take();
    if (issues.empty()) issues = generator.check(params, context_);
    if (!issues.empty())
      add(IssueKind::invalid_value, pointer, "the model refuses it: " + issues.front().message);
  }

  void check_place(const SceneLayer& layer, std::size_t number, const std::string& pointer) {
    const ScenePlace& place = layer.place;
    using Method = SceneMethod;
    const std::string method(text_of(place.method));
    const auto member = [&](const char* name, bool is_given, bool is_needed,
                            std::initializer_list<Method> of) {
      const bool belongs = std::find(of.begin(), of.end(), place.method) != of.end();
      if (is_given && !belongs)
        add(conflict_with({"method"}), pointer + "/" + name, "has no effect with the method " + method);
      if (!is_given && is_needed && belongs)
        add(missing_for({name, "method"}), pointer, "the method " + method + " needs `" + name + "`");
    };
    member("positions", !place.positions.empty(), true, {Method::positions});
    member("distance", place.distance.has_value(), true, {Method::poisson, Method::path});
    member("spacing", place.spacing.has_value(), true, {Method::rows});
    member("angle", place.angle != 0, false, {Method::rows});
    member("stagger", place.stagger != 0, false, {Method::rows});
    member("jitter", place.jitter != 0, false, {Method::rows, Method::path});
    member("points", place.points.has_value(), true, {Method::path});
    member("offset", place.offset != 0, false, {Method::path});
    member("side", place.side != SceneSide::both, false, {Method::path});
    member("clusters", place.clusters.has_value(), true, {Method::clusters});
    member("count", place.count.has_value(), false,
           {Method::poisson, Method::scatter, Method::clusters, Method::rows, Method::path});
    const bool needs_count = place.method == Method::scatter || place.method == Method::clusters;
    if (needs_count && !place.count)
      add(missing_for({"count", "method"}), pointer, "the method " + method + " needs `count`");
    const std::uint64_t most = context_.job.limits().shapes;
    if (needs_count && place.count && static_cast<std::uint64_t>(*place.count) > most) {
      issues_.push_back(limit_issue(
          {Resource::shapes, most, static_cast<std::uint64_t>(*place.count)},
          "found " + std::to_string(*place.count) + "; the limit on shapes is " + std::to_string(most),
          pointer + "/count"));
    }
    if (place.method == Method::positions) {
      check_positions(layer, pointer);
      refuse_rules(place, pointer);
      return;
    }
    if (place.points) check_line(*place.points, pointer + "/points");
    if (place.area) check_area(*place.area, pointer + "/area");
    if (place.density_image && !place.density_image->starts_with(png_head)) {
      add(IssueKind::invalid_value, pointer + "/density_image",
          "expected a PNG as a data URI: data:image/png;base64,…");
    }
    const auto limits = [&](const auto& given, const char* name) {
      if (given && given->from && given->to && *given->from > *given->to)
        add(IssueKind::out_of_range, pointer + "/" + name, "`from` is greater than `to`");
    };
    limits(place.slope, "slope");
    limits(place.altitude, "altitude");
    limits(place.above_water, "above_water");
    limits(place.shade, "shade");
    for (std::size_t i = 0; i < place.near.size(); ++i)
      check_near(place.near[i], number, pointer + "/near/" + std::to_string(i));
    if (place.above_water && !params_.terrain)
      add(conflict_with({"terrain"}), pointer + "/above_water",
          "there is no water; only a terrain has water");
    if (place.ground && !params_.terrain) {
      add(conflict_with({"terrain"}), pointer + "/ground",
          "there are no classes of ground; only a terrain has them");
    }
  }

  void check_positions(const SceneLayer& layer, const std::string& pointer) {
    for (std::size_t i = 0; i < layer.place.positions.size(); ++i) {
      const ScenePosition& position = layer.place.positions[i];
      const std::string at = pointer + "/positions/" + std::to_string(i);
      if (position.model) check_child(*position.model, at + "/model");
      const std::string& generator = position.model ? position.model->generator : layer.model.generator;
      if (position.age && find_generator(context_.generators, generator) && !has_parameter(generator, "age"))
        add(IssueKind::not_available, at + "/age", generator + " has no parameter age");
    }
  }

  /// Explicit positions ignore all rules.
  void refuse_rules(const ScenePlace& place, const std::string& pointer) {
    const auto refuse = [&](bool is_given, const char* name) {
      if (is_given)
        add(conflict_with({"method"}), pointer + "/" + name, "has no effect with the method positions");
    };
    refuse(place.area.has_value(), "area");
    refuse(place.edge != 0, "edge");
    refuse(place.density != 1, "density");
    refuse(place.density_image.has_value(), "density_image");
    refuse(place.noise.has_value(), "noise");
    refuse(place.ground.has_value(), "ground");
    refuse(place.slope.has_value(), "slope");
    refuse(place.altitude.has_value(), "altitude");
    refuse(place.above_water.has_value(), "above_water");
    refuse(place.shade.has_value(), "shade");
    refuse(!place.near.empty(), "near");
  }

  void check_area(const std::vector<std::array<double, 2>>& area, const std::string& pointer) {
    double twice = 0;
    for (std::size_t i = 0, j = area.size() - 1; i < area.size(); j = i++)
      twice += area[j][0] * area[i][1] - area[i][0] * area[j][1];
    if (twice == 0) add(IssueKind::invalid_value, pointer, "the polygon has no area");
  }

  void check_near(const SceneNeighbour& near, std::size_t number, const std::string& pointer) {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < number; ++i) {
      if (params_.layers[i].name) names.push_back(*params_.layers[i].name);
    }
    if (std::find(names.begin(), names.end(), near.layer) == names.end()) {
      add(IssueKind::unknown_name, pointer + "/layer",
          schema::unknown_word("layer before this one called", near.layer, names));
    }
    if (!near.from && !near.to) add(missing_for({"from", "to"}), pointer, "expected `from`, `to` or both");
    if (near.from && near.to && *near.from > *near.to)
      add(IssueKind::out_of_range, pointer + "/from", "`from` is greater than `to`");
  }

  const SceneParams& params_;
  const CheckContext& context_;
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<Issue> check(const SceneParams& params, const CheckContext& context) {
  return Checker(params, context).check();
}

}  // namespace seedmesh::scene
