#include "core/generators/scene/scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/child.h"
#include "core/generators/scene/assemble.h"
#include "core/generators/scene/list.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

std::optional<Error> refusal(const SceneParams& params, const Limits& limits) {
  std::vector<Issue> issues = check(params, limits);
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

std::vector<std::uint8_t> used_casts(const Planting& planting, const Casting& casting) {
  std::vector<std::uint8_t> used(casting.casts.size());
  for (std::size_t layer = 0; layer < planting.layers.size(); ++layer) {
    for (const Stand& stand : planting.layers[layer]) used[casting.cast_of(layer, stand)] = 1;
  }
  return used;
}

}  // namespace

Result<Model> generate(const SceneParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  job.progress("derive", 0);
  const Casting casting = casting_of(params, job);
  refuse_too_many(casting, job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  const Planting planting = plant(params, *ground, job);
  job.progress("mesh", 0);
  Pieces pieces;
  Result<std::vector<Model>> models =
      models_of(casting, used_casts(planting, casting), job.demand().lods, job);
  if (!models) return std::move(models).error();
  pieces.models = std::move(*models);
  Result<Model> made = ground->model(params, job);
  if (!made) return made;
  pieces.ground = std::move(*made);
  return assembled(params, {*ground, planting, casting}, std::move(pieces), job);
}

Result<Json> derive(const SceneParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  const Planting planting = plant(params, *ground, job);
  return told(params, *ground, planting, casting_of(params, job), job);
}

Result<Appraisal> appraise(const SceneParams& params, const Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  Appraisal appraisal;
  const Casting casting = casting_of(params, job);
  refuse_too_many(casting, job);
  std::set<std::pair<std::string, std::string>> seen;
  for (const Cast& cast : casting.casts) {
    Result<Appraisal> own = appraise_child(cast.request, cast.pointer, Rng(0), job);
    if (!own) return own;
    for (Warning& each : own->warnings) {
      if (seen.insert({each.pointer, each.message}).second) appraisal.warnings.push_back(std::move(each));
    }
  }
  return appraisal;
}

Json vocabulary() { return Json::object(); }

Result<Array<std::uint8_t>> encode(const SceneParams& params, std::string_view, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  job.progress("derive", 0);
  const Casting casting = casting_of(params, job);
  refuse_too_many(casting, job);
  Result<Ground> ground = Ground::make(params, job);
  if (!ground) return std::move(ground).error();
  const Planting planting = plant(params, *ground, job);
  job.progress("encode", 0);
  return placement_list(params, *ground, planting, casting, job);
}

}  // namespace seedmesh::scene
