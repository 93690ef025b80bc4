#include "core/generators/scene/model_variants.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/child.h"
#include "core/generators/scene/forecast.h"
#include "core/generators/scene/place_layers.h"
#include "core/schema/embedded.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr std::uint64_t draw_variant = 6;
constexpr std::size_t many_models = 64, parts_of_many = 8;

/// Returns the schema of a generator's parameters, or null.
const Json* schema_of(std::string_view generator) {
  static const auto all = [] {
    std::map<std::string, Json, std::less<>> schemas;
    for (const EmbeddedText& each : embedded_schemas())
      schemas.emplace(std::string(each.name), Json::parse(each.text));
    return schemas;
  }();
  const auto found = all.find(generator);
  return found == all.end() ? nullptr : &found->second;
}

std::vector<std::string> tokens_of(std::string_view path) {
  std::vector<std::string> tokens;
  std::size_t start = 0;
  while (true) {
    const std::size_t dot = path.find('.', start);
    tokens.emplace_back(path.substr(start, dot == std::string_view::npos ? dot : dot - start));
    if (dot == std::string_view::npos) return tokens;
    start = dot + 1;
  }
}

/// Returns the schema of a member, from any of the alternatives.
const Json* member_of(const Json& schema, const std::string& name) {
  if (const auto choices = schema.find("oneOf"); choices != schema.end()) {
    for (const Json& each : *choices) {
      if (const Json* found = member_of(each, name)) return found;
    }
    return nullptr;
  }
  if (const auto members = schema.find("properties"); members != schema.end()) {
    const auto found = members->find(name);
    return found == members->end() ? nullptr : &*found;
  }
  const auto others = schema.find("additionalProperties");
  return others != schema.end() && others->is_object() ? &*others : nullptr;
}

const Json* schema_at(std::string_view generator, std::string_view path) {
  const Json* schema = schema_of(generator);
  for (const std::string& token : tokens_of(path)) {
    if (schema) schema = member_of(*schema, token);
  }
  return schema;
}

/// Returns the final age of a plant by its own request: its age, or else all its iterations.
std::optional<double> own_age(const Child& child) {
  const Json parameters = Json::parse(child.parameters);
  if (const auto age = parameters.find("age"); age != parameters.end() && age->is_number())
    return age->get<double>();
  const Json* iterations = schema_at(child.generator, "iterations");
  if (!iterations) return std::nullopt;
  const auto given = parameters.find("iterations");
  if (given != parameters.end() && given->is_number()) return given->get<double>();
  return iterations->contains("default") ? std::optional(iterations->at("default").get<double>())
                                         : std::nullopt;
}

void set(Child& child, std::string_view path, const Json& value) {
  child.parameters = with_parameter(child.parameters, path, value.dump());
}

Json drawn_value(const SceneVariation& variation, const Child& child, Rng rng) {
  if (variation.among) {
    const auto& choice = (*variation.among)[rng.below(static_cast<std::uint32_t>(variation.among->size()))];
    return std::visit([](const auto& value) { return Json(value); }, choice);
  }
  const double from = *variation.from, to = *variation.to;
  if (!is_whole(child.generator, variation.parameter)) return rng.uniform(from, to);
  return math::to_int64(std::min(std::floor(rng.uniform(from, to + 1)), to));
}

double value_of(const std::variant<double, std::array<double, 2>>& given, Rng rng) {
  if (const double* one = std::get_if<double>(&given)) return *one;
  return rng.uniform(std::get<1>(given)[0], std::get<1>(given)[1]);
}

/// Applies the settings of the scene for all plants: a largest age and a season.
void live_in(const SceneParams& scene, Child& child) {
  if (scene.age && has_parameter(child.generator, "age"))
    set(child, "age", std::min(*scene.age, own_age(child).value_or(*scene.age)));
  if (scene.season && has_parameter(child.generator, "season"))
    set(child, "season", std::string(text_of(*scene.season)));
}

Child variant_of(const SceneParams& scene, const SceneLayer& layer, std::size_t number, Rng models) {
  Child child = layer.model;
  const Rng rng = (child.seed ? Rng::of_seed(*child.seed) : models).at(number);
  if (!child.seed || number > 0) child.seed = rng.key();
  if (layer.age) set(child, "age", value_of(*layer.age, rng.at("age")));
  live_in(scene, child);
  for (const SceneVariation& each : layer.vary)
    set(child, each.parameter, drawn_value(each, child, rng.at("vary").at(each.parameter)));
  return child;
}

/// Returns the model of a position, or nullopt where it uses a variant of the layer.
std::optional<Child> model_at(const SceneParams& scene, const SceneLayer& layer,
                              const ScenePosition& position, const Child& variant, Rng rng) {
  if (!position.model && !position.age) return std::nullopt;
  Child child = position.model ? *position.model : variant;
  if (!child.seed) child.seed = rng.key();
  if (position.model && layer.age && has_parameter(child.generator, "age"))
    set(child, "age", value_of(*layer.age, rng.at("age")));
  if (position.age) set(child, "age", *position.age);
  live_in(scene, child);
  return child;
}

/// Returns the parameter that replaces a missing age, where a position of the layer has an age.
std::optional<std::string> used_with_age(const SceneLayer& layer) {
  const auto has_age = [](const ScenePosition& each) { return each.age.has_value(); };
  const Json* age = schema_at(layer.model.generator, "age");
  if (!age || !age->contains("x-full") || std::ranges::none_of(layer.place.positions, has_age))
    return std::nullopt;
  return age->at("x-full").get<std::string>();
}

}  // namespace

bool has_parameter(std::string_view generator, std::string_view path) {
  return schema_at(generator, path) != nullptr;
}

bool is_whole(std::string_view generator, std::string_view path) {
  const Json* schema = schema_at(generator, path);
  return schema && schema->value("type", "") == "integer";
}

std::string with_parameter(const std::string& parameters, std::string_view path, const std::string& json) {
  Json root = Json::parse(parameters);
  Json* at = &root;
  for (const std::string& token : tokens_of(path)) {
    if (!at->is_object()) *at = Json::object();
    at = &(*at)[token];
  }
  *at = Json::parse(json);
  return canonical_text(root);
}

std::uint32_t VariantTable::variant_at(std::size_t layer, const Placement& placement) const {
  const Layer& own = layers[layer];
  if (placement.position < own.by_position.size() && own.by_position[placement.position] != none)
    return own.by_position[placement.position];
  Rng rng(key_at(placement.key, draw_variant));
  return own.first + rng.below(own.count);
}

bool is_used_elsewhere(const VariantTable& variant_table, const Warning& warning) {
  return std::ranges::find(variant_table.used_with_age, warning.pointer) != variant_table.used_with_age.end();
}

bool any_generator(const SceneParams& params, const std::function<bool(const std::string& name)>& predicate) {
  return std::ranges::any_of(params.layers, [&](const SceneLayer& layer) {
    return predicate(layer.model.generator) ||
           std::ranges::any_of(layer.place.positions, [&](const ScenePosition& position) {
             return position.model && predicate(position.model->generator);
           });
  });
}

std::size_t count_variants(const SceneParams& params) {
  std::size_t count = 0;
  for (const SceneLayer& layer : params.layers) {
    count += static_cast<std::size_t>(layer.variants);
    for (const ScenePosition& position : layer.place.positions)
      count += position.model || position.age ? 1U : 0U;
  }
  return count;
}

VariantTable variant_table_of(const SceneParams& params, const Job& job) {
  VariantTable variant_table;
  for (std::size_t i = 0; i < params.layers.size(); ++i) {
    const SceneLayer& layer = params.layers[i];
    const Rng rng = stream_of(layer, i, job);
    const std::string name = layer.name.value_or("layer_" + std::to_string(i));
    const std::string pointer = "/layers/" + std::to_string(i);
    if (const auto name_of_full = used_with_age(layer))
      variant_table.used_with_age.push_back(pointer + "/model/parameters/" + *name_of_full);
    VariantTable::Layer own;
    own.first = static_cast<std::uint32_t>(variant_table.variants.size());
    own.count = static_cast<std::uint32_t>(layer.variants);
    std::vector<Child> variants;
    for (std::size_t k = 0; k < own.count; ++k) {
      variants.push_back(variant_of(params, layer, k, rng.at("model")));
      variant_table.variants.push_back({name + "_" + std::to_string(k), pointer + "/model", variants.back()});
    }
    for (std::size_t k = 0; k < layer.place.positions.size(); ++k) {
      const ScenePosition& position = layer.place.positions[k];
      const Rng there = rng.at("position").at(k);
      Rng choice(key_at(there.key(), draw_variant));
      const std::optional<Child> child =
          model_at(params, layer, position, variants[choice.below(own.count)], there);
      own.by_position.push_back(child ? static_cast<std::uint32_t>(variant_table.variants.size()) : none);
      if (!child) continue;
      const std::string position_pointer = pointer + "/place/positions/" + std::to_string(k);
      variant_table.variants.push_back({name + "_at_" + std::to_string(k),
                                        position.model ? position_pointer + "/model" : pointer + "/model",
                                        *child});
    }
    variant_table.layers.push_back(std::move(own));
  }
  return variant_table;
}

Result<std::vector<Model>> models_of(Forecast& forecast, const Demand& demand, const GenerateContext& context,
                                     const std::function<void()>& background) {
  Job& job = context.job;
  const VariantTable& variant_table = forecast.variant_table();
  std::vector<std::optional<Result<Model>>> made(variant_table.variants.size());
  const auto make = [&](std::size_t i) {
    const ModelVariant& variant = variant_table.variants[i];
    Demand own = demand;
    own.growth = demand.growth && find_generator(context.generators, variant.request.generator)->grows;
    made[i].emplace(generate_child(variant.request, variant.pointer, Rng(0), context, own));
  };
  for (const std::size_t i : forecast.samples()) {  // one by one, to measure the cost of each
    const Job::PointerScope scope(job, forecast.limit_pointer());
    Amounts spent = spent_of(job);
    make(i);
    if (!*made[i]) return std::move(*made[i]).error();
    const Amounts after = spent_of(job);
    for (std::size_t r = 0; r < spent.size(); ++r) spent[r] = after[r] - spent[r];
    forecast.record(i, spent);
    forecast.refuse(job);
  }
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (forecast.is_needed(i) && !made[i]) others.push_back(i);
  }
  const Job::PointerScope scope(job, forecast.limit_pointer());
  // With many models, the cost of the first parts predicts the total.
  const std::size_t parts = others.size() >= many_models ? parts_of_many : 1;
  for (std::size_t own = 0; own < parts; ++own) {
    const Amounts before = spent_of(job);
    const std::size_t here = (others.size() + parts - 1 - own) / parts;
    parallel_for(job, 1 + here, 1, [&](std::size_t i, std::size_t, std::size_t) {
      if (i > 0) make(others[own + (i - 1) * parts]);
      if (i == 0 && own == 0 && background) background();
    });
    if (own > 0) forecast.refuse(job, before, parts - 1 - own);
  }
  std::vector<Model> models(made.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!made[i]) continue;
    if (!*made[i]) return std::move(*made[i]).error();
    models[i] = std::move(**made[i]);
  }
  return models;
}

}  // namespace seedmesh::scene
