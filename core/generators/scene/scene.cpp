#include "core/generators/scene/scene.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/api.h"
#include "core/generators/child.h"
#include "core/generators/scene/assemble.h"
#include "core/generators/scene/estimate.h"
#include "core/generators/scene/forecast.h"
#include "core/generators/scene/grow.h"
#include "core/generators/scene/levels.h"
#include "core/generators/scene/list.h"
#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/patterns.h"
#include "core/generators/scene/unused.h"
#include "core/generators/scene/words.h"
#include "core/geom/mesh/finish.h"
#include "core/gltf/compress/pack.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

std::optional<Error> refusal(const SceneParams& params, const GenerateContext& context) {
  std::vector<Issue> issues = check(params, {context.job, context.generators});
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

/// Returns whether the generator with this name has a trait.
struct HasTrait {
  GeneratorList generators;
  bool Generator::*trait;
  bool operator()(const std::string& name) const {
    const Generator* generator = find_generator(generators, name);
    return generator && generator->*trait;
  }
};

/// Adds the warnings of unused_settings().
void warn_of_unused(const SceneParams& params, Purpose purpose, const Demand* demand,
                    std::vector<Warning>& warnings) {
  for (Warning& each : unused_settings(params, purpose, demand)) warnings.push_back(std::move(each));
}

/// Finds conflicts between the requested output and the parameters.
std::vector<Issue> conflicts(const SceneParams& params, const GenerateContext& context) {
  const Demand& demand = context.demand;
  std::vector<Issue> issues;
  const auto add = [&issues](const char* pointer, const char* other, std::string message) {
    issues.emplace_back(conflict_with({other}), pointer, std::move(message));
  };
  const std::string levels = "found " + std::to_string(demand.lods) + " levels of detail";
  if (params.camera && demand.lods > 1)
    add("/output/lods", "parameters/camera", levels + " and a camera, which chooses one for each placement");
  if (params.camera && demand.impostor) {
    add("/output/impostor", "parameters/camera",
        "found a level of detail and a camera, which chooses one for each placement");
  }
  if (demand.copies == CopyForm::merge && wants_impostors(params, demand))
    add("/output/instancing", "output/impostor", "found merge; a merged mesh cannot use impostors");
  if (demand.impostor && !any_generator(params, HasTrait{context.generators, &Generator::has_impostor}))
    add("/output/impostor", "parameters/layers", "found an impostor; no model supports impostors");
  if (!demand.growth) return issues;
  if (!any_generator(params, HasTrait{context.generators, &Generator::grows}))
    add("/output/animation", "parameters/layers", "found growth, but no model grows");
  if (demand.lods > 1)
    add("/output/lods", "output/animation", levels + "; growing plants of a scene have one level");
  if (params.camera)
    add("/camera", "output/animation", "a camera chooses levels of detail; growing plants have one level");
  if (demand.copies == CopyForm::gpu) {
    add("/output/instancing", "output/animation",
        "found gpu; instanced copies have no bones and cannot grow");
  }
  return issues;
}

/// Returns the number of placements of each variant.
std::vector<std::uint64_t> placements_of(const ScenePlacements& all_placements,
                                         const VariantTable& variant_table) {
  std::vector<std::uint64_t> placements(variant_table.variants.size());
  for (std::size_t layer = 0; layer < all_placements.layers.size(); ++layer) {
    for (const Placement& placement : all_placements.layers[layer])
      ++placements[variant_table.variant_at(layer, placement)];
  }
  return placements;
}

/// A list of placements has neither the ground nor what belongs to it.
void warn_of_outlines(const SceneParams& params, ScenePlacements& all_placements) {
  if (!params.buildings.empty()) {
    all_placements.warnings.push_back(
        {"/buildings", "buildings belong to the ground, which a list of placements leaves out"});
  }
}

bool has_foundations(const SceneParams& params) {
  return std::any_of(params.layers.begin(), params.layers.end(),
                     [](const SceneLayer& layer) { return layer.foundation.has_value(); });
}

/// Generates the ground for a compressed file. It runs alone, because a large ground needs more memory than
/// everything after it.
Result<Model> packed_ground(const SceneParams& params, const Ground& ground, const GenerateContext& context) {
  Job& job = context.job;
  Result<Model> made = ground.model(params, context);
  if (!made) return made;
  finish_meshes(*made, job);
  gltf::pack(*made, job);
  return made;
}

}  // namespace

Result<Model> generate(const SceneParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  std::vector<Issue> issues = conflicts(params, context);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  refuse_patterns(params, job);
  job.progress("derive", 0);
  const VariantTable variant_table = variant_table_of(params, job);
  Forecast forecast(params, variant_table, context);
  forecast.refuse(job);
  if (context.demand.packs) job.budget()->prefer_low_memory();
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  // Placements change the ground only through foundations. Without these the ground is generated first,
  // before plants take memory.
  std::optional<Result<Model>> made;
  if (context.demand.packs && !has_foundations(params)) made.emplace(packed_ground(params, *ground, context));
  if (made && !*made) return std::move(*made);
  ScenePlacements all_placements = place_layers(params, *ground, job);
  warn_of_unused(params, Purpose::model, &context.demand, all_placements.warnings);
  job.progress("mesh", 0);
  Pieces pieces;
  Demand demand;
  demand.lods = level_count_of(params, context.demand);
  demand.two_sided_leaves = context.demand.two_sided_leaves;
  demand.growth = context.demand.growth;
  if (demand.growth) {
    const Result<std::uint32_t> bones =
        bones_for({*ground, all_placements, variant_table}, context.generators);
    if (!bones) return bones.error();
    demand.most_bones = *bones;
  }
  const bool merges = context.demand.copies == CopyForm::merge && !chooses_levels(params, context.demand);
  forecast.set_counts(placements_of(all_placements, variant_table), merges);
  if (context.demand.packs && !made) made.emplace(packed_ground(params, *ground, context));
  if (made && !*made) return std::move(*made);
  if (made) forecast.spend_ground();
  // Otherwise models are generated in parallel with it, because a reduced mesh is long work that cannot be
  // split.
  std::function<void()> background;
  if (!made) background = [&] { made.emplace(ground->model(params, context)); };
  Result<std::vector<Model>> models = models_of(forecast, demand, context, background);
  if (!models) return std::move(models).error();
  if (!*made) return std::move(*made);
  pieces.models = std::move(*models);
  pieces.ground = std::move(**made);
  return assembled(params, {*ground, all_placements, variant_table}, std::move(pieces), context);
}

Result<Json> derive(const SceneParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  refuse_patterns(params, job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  ScenePlacements all_placements = place_layers(params, *ground, job);
  warn_of_outlines(params, all_placements);
  warn_of_unused(params, Purpose::derivation, nullptr, all_placements.warnings);
  const VariantTable variant_table = variant_table_of(params, job);
  Json answer = placements_json(params, *ground, all_placements, variant_table, job);
  if (!params.words) return answer;
  Result<Json> words = words_of(all_placements, variant_table, context);
  if (!words) return words;
  answer["words"] = *std::move(words);
  return answer;
}

Result<Appraisal> appraise(const SceneParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  std::vector<Issue> issues = conflicts(params, context);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  refuse_patterns(params, job);
  Appraisal appraisal;
  warn_of_unused(params, Purpose::derivation, &context.demand, appraisal.warnings);
  const VariantTable variant_table = variant_table_of(params, job);
  const Forecast forecast(params, variant_table, context);
  forecast.refuse(job);
  std::set<std::pair<std::string, std::string>> seen;
  std::vector<std::optional<Estimate>> estimates;
  for (const ModelVariant& variant : variant_table.variants) {
    Result<Appraisal> own = appraise_child(variant.request, variant.pointer, Rng(0), context);
    if (!own) return own;
    estimates.push_back(own->estimate);
    for (Warning& each : own->warnings) {
      if (!is_used_elsewhere(variant_table, each) && seen.insert({each.pointer, each.message}).second)
        appraisal.warnings.push_back(std::move(each));
    }
  }
  appraisal.estimate = estimate_of(params, variant_table, estimates, context);
  return appraisal;
}

Json vocabulary() { return Json::object(); }

Result<Payload> encode(const SceneParams& params, const WantedFormat&, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  if (params.camera) {
    return Error{Code::invalid,
                 {{conflict_with({"output/format"}), "/camera", "has no effect on a list of placements"}}};
  }
  refuse_patterns(params, job);
  job.progress("derive", 0);
  const VariantTable variant_table = variant_table_of(params, job);
  Forecast forecast(params, variant_table, context);
  forecast.refuse(job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  ScenePlacements all_placements = place_layers(params, *ground, job);
  warn_of_outlines(params, all_placements);
  warn_of_unused(params, Purpose::list, nullptr, all_placements.warnings);
  job.progress("encode", 0);
  return placement_list(params, *ground, all_placements, forecast, context);
}

}  // namespace seedmesh::scene
