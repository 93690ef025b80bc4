#include "core/pipeline/fit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/model/index_width.h"

namespace seedmesh {
namespace {

constexpr const char* pointer = "/output/max_triangles";

/// Smaller meshes keep all their triangles at every level: simplification would collapse a box.
constexpr std::uint64_t least_simplified = 64;
constexpr double most_of_level = 0.9;  ///< a level may have this share of the triangles of the one before

/// Makes `level` the finest, with at most `lods` - 1 coarser ones, and empties meshes that no node and no impostor shows.
void promote(Model& model, std::size_t level, std::size_t lods) {
  std::vector<bool> shown(model.meshes.size(), false);
  for (Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::size_t passed = std::min(level, node.lods.size());
    node.mesh = mesh_at(node, level);
    node.lods.erase(node.lods.begin(), node.lods.begin() + static_cast<std::ptrdiff_t>(passed));
    if (node.lods.size() > lods - 1) node.lods.resize(lods - 1);
    shown[static_cast<std::size_t>(node.mesh)] = true;
    for (const int lod : node.lods) shown[static_cast<std::size_t>(lod)] = true;
  }
  // draw_impostors() empties these.
  for (const Material& material : model.materials) {
    for (const ImpostorRecipe::Part& part : material.impostor.parts)
      shown[static_cast<std::size_t>(part.mesh)] = true;
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) model.meshes[i].primitives.clear();
  }
}

}  // namespace

std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, const SimplifyLimits& limits, Job& job) {
  widen(model, job);
  const auto wanted = static_cast<std::size_t>(lods);
  const std::size_t levels = levels_of(model);
  std::size_t level = 0;
  while (level + 1 < levels && drawn_at(model, level) > most) ++level;
  // Where surfaces may move only a little, simplifying the level before may lose less.
  if (level > 0 && std::isfinite(limits.detail) && drawn_at(model, level) <= most &&
      coarsen_if_it_fits(model, level - 1, most, limits, job))
    --level;
  promote(model, level, wanted);
  if (drawn_at(model, 0) > most) coarsen_all(model, 0, most, 0, limits, job);
  const std::uint64_t drawn = drawn_at(model, 0);
  if (drawn > most) {
    return Issue{IssueKind::not_available, pointer,
                 "the coarsest level has " + std::to_string(drawn) + " triangles; found a budget of " +
                     std::to_string(most)};
  }
  while (levels_of(model) < std::min(wanted, levels) && add_level(model, 0, most_of_level, limits, job)) {
  }
  return std::nullopt;
}

std::optional<Issue> add_levels(Model& model, int lods, const SimplifyLimits& limits, Job& job) {
  const auto wanted = static_cast<std::size_t>(lods);
  if (levels_of(model) == 1) {
    widen(model, job);
    SimplifyLimits more = limits;
    while (levels_of(model) < wanted && add_level(model, least_simplified, most_of_level, more, job)) {
      more.detail *= 2;  // each level is seen from twice the distance
    }
  }
  const std::size_t levels = levels_of(model);
  if (levels >= wanted) return std::nullopt;
  if (levels == 1) {
    return Issue{
        IssueKind::not_available, "/output/lods",
        "found " + std::to_string(lods) + " levels of detail; this model has one and cannot be simplified"};
  }
  model.warnings.push_back({"/output/lods",
                            "the model has " + std::to_string(levels) + " levels of detail instead of " +
                                std::to_string(lods) + ", because the coarsest cannot be simplified",
                            0, 0});
  return std::nullopt;
}

}  // namespace seedmesh
