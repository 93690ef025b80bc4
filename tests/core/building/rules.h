#pragma once
/// Rules run by one line of a test.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/geom/mesh/finish.h"
#include "generated/params/building.h"
#include "tests/support/context.h"

namespace seedmesh::building {

inline BuildingParams with(std::string rules, std::array<double, 3> size = {10, 10, 10}) {
  BuildingParams params;
  params.rules = std::move(rules);
  params.size = size;
  return params;
}

inline Json derived(const BuildingParams& params, std::uint64_t seed = 0) {
  Job job(seed, Job::Options{});
  const Result<Json> answer = derive(params, context_of(job));
  if (answer) return *answer;
  ADD_FAILURE() << answer.error().issues.front().message;
  return {{"shapes", Json::array()}, {"warnings", Json::array()}, {"reports", Json::object()}};
}

/// Symbols of the active shapes, in order, with a blank between.
inline std::string active(const Json& answer) {
  std::string out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"]) out += (out.empty() ? "" : " ") + shape["symbol"].get<std::string>();
  }
  return out;
}

inline std::string leaves(const std::string& rules, std::array<double, 3> size = {10, 10, 10},
                          std::uint64_t seed = 0) {
  return active(derived(with(rules, size), seed));
}

inline std::vector<double> sizes(const Json& answer, int axis) {
  std::vector<double> out;
  for (const Json& shape : answer["shapes"]) {
    if (shape["active"]) out.push_back(shape["scope"]["size"][static_cast<std::size_t>(axis)]);
  }
  return out;
}

/// Runs a rule file of CityEngine on a lot of 10 m by 8 m.
inline Json result_of(const std::string& rules) {
  return derived(with("version \"2025.0\" " + rules, {10, 0, 8}));
}

/// No operation of a rule file is left out because it cannot be done.
inline void expect_done(const Json& answer, const std::string& rules) {
  EXPECT_EQ(answer["warnings"].dump().find("is left out"), std::string::npos)
      << rules << answer["warnings"].dump();
}

/// "line:column message" of the first fault.
inline std::string fault(const std::string& rules) {
  const std::vector<Issue> issues = check(with(rules), Limits{});
  if (issues.empty()) return "none";
  return std::to_string(issues[0].line) + ":" + std::to_string(issues[0].column) + " " + issues[0].message;
}

inline std::string refusal(const BuildingParams& params, const Limits& limits = {}) {
  Job::Options options;
  options.limits = limits;
  Job job(0, options);
  try {
    const Result<Json> answer = derive(params, context_of(job));
    return answer ? "none" : answer.error().issues.front().message;
  } catch (const Stop& stop) {
    return std::to_string(stop.issue().line) + ":" + std::to_string(stop.issue().column) + " " +
           stop.issue().message;
  }
}

inline Model model_of(const BuildingParams& params, std::uint64_t seed = 0) {
  Job job(seed, Job::Options{});
  Result<Model> model = generate(params, context_of(job));
  if (!model) {
    ADD_FAILURE() << model.error().issues.front().message;
    return {};
  }
  finish(*model, job);
  return std::move(*model);
}

inline double volume(const BuildingParams& params) {
  double sum = 0;
  const Model model = model_of(params);
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const double copies = std::max<double>(1, static_cast<double>(node.instances.transforms.size()));
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const Mesh& mesh = primitive.mesh;
      for (std::size_t t = 0; t < mesh.index.size(); t += 3) {
        const glm::dvec3 a = mesh.position[mesh.index.at(t)], b = mesh.position[mesh.index.at(t + 1)],
                         c = mesh.position[mesh.index.at(t + 2)];
        sum += copies * glm::dot(a, glm::cross(b, c)) / 6;
      }
    }
  }
  return sum;
}

}  // namespace seedmesh::building
