#include "core/generators/scene/scene.h"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/child.h"
#include "core/generators/registry.h"
#include "core/generators/scene/assemble.h"
#include "core/generators/scene/casts.h"
#include "core/generators/scene/estimate.h"
#include "core/generators/scene/forecast.h"
#include "core/generators/scene/grow.h"
#include "core/generators/scene/levels.h"
#include "core/generators/scene/list.h"
#include "core/generators/scene/patterns.h"
#include "core/geom/finish.h"
#include "core/gltf/pack.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

std::optional<Error> refusal(const SceneParams& params, const Limits& limits) {
  std::vector<Issue> issues = check(params, limits);
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

template <class Holds>
bool any_model(const SceneParams& params, const Holds& holds) {
  return std::any_of(params.layers.begin(), params.layers.end(), [&](const SceneLayer& layer) {
    const std::vector<ScenePosition>& positions = layer.place.positions;
    return holds(layer.model.generator) ||
           std::any_of(positions.begin(), positions.end(), [&](const ScenePosition& position) {
             return position.model && holds(position.model->generator);
           });
  });
}

template <bool Generator::*trait>
bool has_trait(const std::string& name) {
  const Generator* generator = find_generator(name);
  return generator && generator->*trait;
}

/// What is said of all plants and none of the models has.
std::vector<Warning> without_effect(const SceneParams& params) {
  std::vector<Warning> warnings;
  const auto warn = [&](bool is_given, const char* name) {
    const auto has_it = [name](const std::string& generator) { return has_parameter(generator, name); };
    if (is_given && !any_model(params, has_it))
      warnings.push_back(
          {"/" + std::string(name), "none of the models has a parameter " + std::string(name)});
  };
  warn(params.age.has_value(), "age");
  warn(params.season.has_value(), "season");
  return warnings;
}

/// What of the wanted answer and the parameters does not go together.
std::vector<Issue> conflicts(const SceneParams& params, const Demand& demand) {
  std::vector<Issue> issues;
  const auto add = [&issues](const char* pointer, std::string message) {
    issues.push_back({pointer, std::move(message), 0, 0});
  };
  const std::string levels = "found " + std::to_string(demand.lods) + " levels of detail";
  if (params.camera && demand.lods > 1)
    add("/output/lods", levels + " and a camera, which chooses one for each place");
  if (params.camera && demand.impostor)
    add("/output/impostor", "found a level of detail and a camera, which chooses one for each place");
  if (demand.copies == CopyForm::merge && wants_pictures(params, demand))
    add("/output/instancing", "found merge; a mesh of all copies has no pictures of each");
  if (demand.impostor && !any_model(params, has_trait<&Generator::has_impostor>))
    add("/output/impostor",
        "found an impostor; none of the models is a plant that a picture could stand for");
  if (!demand.growth) return issues;
  if (!any_model(params, has_trait<&Generator::grows>))
    add("/output/animation", "found growth; none of the models grows");
  if (demand.lods > 1) add("/output/lods", levels + "; plants of a scene that grow have one");
  if (params.camera) add("/camera", "a camera chooses levels of detail; plants that grow have one");
  if (demand.copies == CopyForm::gpu)
    add("/output/instancing", "found gpu; copies that are arrays have no bones, and cannot grow");
  return issues;
}

/// How many stand of each model.
std::vector<std::uint64_t> stands_of(const Planting& planting, const Casting& casting) {
  std::vector<std::uint64_t> stands(casting.casts.size());
  for (std::size_t layer = 0; layer < planting.layers.size(); ++layer) {
    for (const Stand& stand : planting.layers[layer]) ++stands[casting.cast_of(layer, stand)];
  }
  return stands;
}

bool has_foundations(const SceneParams& params) {
  return std::any_of(params.layers.begin(), params.layers.end(),
                     [](const SceneLayer& layer) { return layer.foundation.has_value(); });
}

/// For a compressed file. Nothing else is made meanwhile: a great ground takes more memory on its way than
/// all that comes after it.
Result<Model> packed_ground(const SceneParams& params, const Ground& ground, Job& job) {
  Result<Model> made = ground.model(params, job);
  if (!made) return made;
  finish_meshes(*made, job);
  gltf::pack(*made, job);
  return made;
}

}  // namespace

Result<Model> generate(const SceneParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  std::vector<Issue> issues = conflicts(params, job.demand());
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  refuse_patterns(params, job);
  job.progress("derive", 0);
  const Casting casting = casting_of(params, job);
  Forecast forecast(params, casting, job);
  forecast.refuse(job);
  if (job.demand().packs) job.purse()->be_thrifty();
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  // Only foundations bear on the ground: without any it is done before its plants take memory.
  std::optional<Result<Model>> made;
  if (job.demand().packs && !has_foundations(params)) made.emplace(packed_ground(params, *ground, job));
  if (made && !*made) return std::move(*made);
  Planting planting = plant(params, *ground, job);
  for (Warning& each : without_effect(params)) planting.warnings.push_back(std::move(each));
  job.progress("mesh", 0);
  Pieces pieces;
  Demand demand;
  demand.lods = levels_made_of(params, job.demand());
  demand.growth = job.demand().growth;
  if (demand.growth) {
    const Result<std::uint32_t> bones = bones_for({*ground, planting, casting});
    if (!bones) return bones.error();
    demand.most_bones = *bones;
  }
  const bool merges = job.demand().copies == CopyForm::merge && !chooses_levels(params, job.demand());
  forecast.want(stands_of(planting, casting), merges);
  if (job.demand().packs && !made) made.emplace(packed_ground(params, *ground, job));
  if (made && !*made) return std::move(*made);
  if (made) forecast.know_ground();
  // Else models are made beside it: a reduced mesh is long work that cannot be cut.
  std::function<void()> beside;
  if (!made) beside = [&] { made.emplace(ground->model(params, job)); };
  Result<std::vector<Model>> models = models_of(forecast, demand, job, beside);
  if (!models) return std::move(models).error();
  if (!*made) return std::move(*made);
  pieces.models = std::move(*models);
  pieces.ground = std::move(**made);
  return assembled(params, {*ground, planting, casting}, std::move(pieces), job);
}

Result<Json> derive(const SceneParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  refuse_patterns(params, job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  const Planting planting = plant(params, *ground, job);
  return told(params, *ground, planting, casting_of(params, job), job);
}

Result<Appraisal> appraise(const SceneParams& params, const Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  std::vector<Issue> issues = conflicts(params, job.demand());
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  refuse_patterns(params, job);
  Appraisal appraisal;
  appraisal.warnings = without_effect(params);
  const Casting casting = casting_of(params, job);
  const Forecast forecast(params, casting, job);
  forecast.refuse(job);
  std::set<std::pair<std::string, std::string>> seen;
  std::vector<std::optional<Estimate>> estimates;
  for (const Cast& cast : casting.casts) {
    Result<Appraisal> own = appraise_child(cast.request, cast.pointer, Rng(0), job);
    if (!own) return own;
    estimates.push_back(own->estimate);
    for (Warning& each : own->warnings) {
      if (!is_used_elsewhere(casting, each) && seen.insert({each.pointer, each.message}).second)
        appraisal.warnings.push_back(std::move(each));
    }
  }
  appraisal.estimate = estimate_of(params, casting, estimates, job);
  return appraisal;
}

Json vocabulary() { return Json::object(); }

Result<Payload> encode(const SceneParams& params, std::string_view, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  if (params.camera)
    return Error{Code::invalid, {{"/camera", "has no effect on a list of placements", 0, 0}}};
  refuse_patterns(params, job);
  job.progress("derive", 0);
  const Casting casting = casting_of(params, job);
  Forecast forecast(params, casting, job);
  forecast.refuse(job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  const Planting planting = plant(params, *ground, job);
  job.progress("encode", 0);
  return placement_list(params, *ground, planting, forecast, job);
}

}  // namespace seedmesh::scene
