#pragma once
/// Trees grown for tests, in figures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/generators/tree/ez_tree.h"
#include "core/generators/tree/grown.h"
#include "core/generators/tree/proctree.h"
#include "core/generators/tree/sculpt.h"
#include "core/generators/tree/weber_penn.h"

namespace seedmesh::tree {

/// The parameters of a preset, as it ships.
inline TreeParams parameters_of_preset(const std::string& name) {
  std::ifstream file(std::string(SEEDMESH_SOURCE_DIR) + "/api_schema/presets/tree/" + name + ".json");
  IssueList errors;
  TreeParams params = read_tree(Json::parse(file).at("parameters"), "/parameters", errors);
  EXPECT_TRUE(errors.empty());
  return params;
}

/// Without limbs that begin thinner than `least_radius`, as far as the model knows that early.
inline Skeleton skeleton_of(const TreeParams& params, std::uint64_t seed, Job& job, double least_radius = 0) {
  Skeleton skeleton(job);
  SkeletonWriter writer(skeleton, job);
  writer.leave_out_below(least_radius);
  const RandomStreams random(params.seeds, seed);
  if (params.model == TreeModel::weber_penn) grow_weber_penn(params, random, writer);
  if (params.model == TreeModel::proctree) grow_proctree(params, random, writer);
  if (params.model == TreeModel::sculpt) grow_sculpt(params, random, writer);
  if (params.model == TreeModel::ez_tree) grow_ez_tree(params, random, seed, writer);
  if (params.model == TreeModel::grown) grow_grown(params, random, writer);
  writer.finish();
  return skeleton;
}

struct LevelCount {
  std::uint64_t count = 0;
};

struct Grown {
  std::vector<LevelCount> levels;
  std::uint64_t leaves = 0;
  double trunk_length = 0, trunk_radius = 0;
  double expected_second = 0;  ///< number of limbs of level 2 by the formula of the paper, for the aspen
};

inline double length_from(const Limbs& limbs, std::size_t head) {
  double length = 0;
  std::size_t last = limbs.parent[head];
  for (std::size_t i = head; i < limbs.size(); ++i) {
    if (i != head && (limbs.parent[i] != last || limbs.starts_limb[i])) break;
    length += static_cast<double>(glm::distance(limbs.position[i], limbs.position[limbs.parent[i]]));
    last = i;
  }
  return length;
}

inline Grown grown(const TreeParams& params, std::uint64_t seed) {
  Job job(seed, Job::Options{});
  const Skeleton skeleton = skeleton_of(params, seed, job);
  const Limbs& limbs = skeleton.limbs;
  Grown out;
  out.leaves = skeleton.organs.organ.size();
  for (std::size_t i = 1; i < limbs.size(); ++i) {
    const bool is_head = limbs.starts_limb[i] || limbs.parent[limbs.parent[i]] == Limbs::none;
    if (!is_head) continue;
    const std::size_t order = limbs.order[i];
    if (order >= out.levels.size()) out.levels.resize(order + 1);
    ++out.levels[order].count;
    const double length = length_from(limbs, i);
    if (order == 0) {
      out.trunk_length = length;
      out.trunk_radius = static_cast<double>(limbs.base_radius[i]);
    }
    if (order == 1) out.expected_second += 30 * (0.2 + 0.8 * length / (out.trunk_length * 0.3));
  }
  return out;
}

/// A skeleton kept with its job.
class Skeletons {
 public:
  Skeletons(const TreeParams& params, std::uint64_t seed)
      : job_(seed, Job::Options{}), skeleton_(skeleton_of(params, seed, job_)) {}

  const Limbs& limbs() const { return skeleton_.limbs; }
  const Organs& organs() const { return skeleton_.organs; }

  /// Every joint of order 0.
  std::vector<glm::vec3> trunk() const {
    return joints([&](std::size_t i) { return limbs().order[i] == 0; });
  }
  /// Every joint.
  std::vector<glm::vec3> tips() const {
    return joints([](std::size_t) { return true; });
  }
  /// The last joint of the trunk.
  std::vector<glm::vec3> trunk_ends() const { return {trunk().back()}; }
  float widest() const {
    float widest = 0;
    for (const glm::vec3& p : limbs().position) widest = std::max(widest, std::sqrt(p.x * p.x + p.z * p.z));
    return widest;
  }

 private:
  template <class Test>
  std::vector<glm::vec3> joints(const Test& test) const {
    std::vector<glm::vec3> out;
    for (std::size_t i = 0; i < limbs().size(); ++i) {
      if (test(i)) out.push_back(limbs().position[i]);
    }
    return out;
  }

  Job job_;
  Skeleton skeleton_;
};

}  // namespace seedmesh::tree
