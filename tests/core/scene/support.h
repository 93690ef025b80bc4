#pragma once
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/child.h"
#include "core/generators/scene/place_layers.h"
#include "core/generators/scene/scene.h"
#include "core/geom/mesh/finish.h"
#include "core/registry/registry.h"
#include "generated/params/scene.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {

inline Job job_of(std::uint64_t seed, int threads = 1) {
  Job::Options options;
  options.threads = threads;
  return Job(seed, options);
}

/// Reads parameters like the pipeline, including children.
inline Generator::Params read_scene_params(const Json& json) {
  IssueList faults;
  Generator::Params params =
      read_parameters(*find_generator("scene"), json, "", {Job(0, Job::Options{}), generators()}, faults);
  EXPECT_TRUE(faults.empty()) << faults.issues().front().pointer << " " << faults.issues().front().message;
  return params;
}

inline const SceneParams& own(const Generator::Params& params) {
  return *static_cast<const SceneParams*>(params.get());
}

/// Returns the errors of a request, as "pointer: message".
inline std::vector<std::string> scene_errors(const Json& json) {
  IssueList faults;
  read_parameters(*find_generator("scene"), json, "", {Job(0, Job::Options{}), generators()}, faults);
  std::vector<std::string> message;
  for (const Issue& issue : faults.issues()) message.push_back(issue.pointer + ": " + issue.message);
  return message;
}

/// The placements of a scene, and its ground.
struct Planted {
  scene::Ground ground;
  scene::ScenePlacements all_placements;
  const Array<scene::Placement>& layer(std::size_t i) const { return all_placements.layers.at(i); }
};

inline Planted planted(const Json& json, std::uint64_t seed = 1, int threads = 1) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(seed, threads);
  Result<scene::Ground> ground = scene::Ground::make(own(params), job);
  EXPECT_TRUE(ground);
  scene::ScenePlacements all_placements = scene::place_layers(own(params), *ground, job);
  return {std::move(*ground), std::move(all_placements)};
}

inline Result<Model> scene_of(const Json& json, std::uint64_t seed = 1, Job::Options options = {}) {
  const Generator::Params params = read_scene_params(json);
  Job job(seed, std::move(options));
  try {
    Result<Model> model = scene::generate(own(params), context_of(job));
    if (model) finish(*model, job);
    return model;
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
}

inline Json derived_scene(const Json& json, std::uint64_t seed = 1) {
  const Generator::Params params = read_scene_params(json);
  Job job = job_of(seed);
  Result<Json> answer = scene::derive(own(params), context_of(job));
  EXPECT_TRUE(answer);
  return answer ? *answer : Json();
}

/// A model of cost 0.
inline Json cube(double size = 1) {
  return {{"generator", "fractal"}, {"parameters", {{"iterations", 0}, {"size", size}}}};
}

}  // namespace seedmesh
