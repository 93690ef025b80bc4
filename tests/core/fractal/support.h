#pragma once
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/child.h"
#include "core/generators/fractal/fractal.h"
#include "core/generators/fractal/instructions.h"
#include "core/geom/mesh/finish.h"
#include "core/registry/registry.h"
#include "generated/params/fractal.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {

inline FractalParams fractal_params(std::string_view json) {
  IssueList faults;
  FractalParams params = read_fractal(Json::parse(json), "", faults);
  EXPECT_TRUE(faults.empty()) << faults.issues().front().pointer << " " << faults.issues().front().message;
  return params;
}

/// As the pipeline does it, with everything read and checked.
inline Result<Model> fractal_of(std::string_view json, std::uint64_t seed = 0, Job::Options options = {}) {
  IssueList faults;
  Job job(seed, options);
  const Generator* generator = find_generator("fractal");
  const Generator::Params params =
      read_parameters(*generator, Json::parse(json), "", {job, generators()}, faults);
  if (!faults.empty()) return Error{Code::invalid, faults.take()};
  try {
    Result<Model> model = generator->generate(params, context_of(job));
    if (model) finish(*model, job);
    return model;
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
}

inline Json derived(std::string_view json, std::uint64_t seed = 0) {
  Job job(seed, Job::Options{});
  const Result<Json> answer = fractal::derive(fractal_params(json), context_of(job));
  EXPECT_TRUE(answer);
  return *answer;
}

inline const Mesh& only_mesh(const Model& model) { return model.meshes.at(0).primitives.at(0).mesh; }

/// What is said of a request that is refused: "pointer: message".
inline std::string refusal(std::string_view json, Job::Options options = {}) {
  const Result<Model> model = fractal_of(json, 0, std::move(options));
  if (model) return "";
  return model.error().issues.front().pointer + ": " + model.error().issues.front().message;
}

}  // namespace seedmesh
