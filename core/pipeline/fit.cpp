#include "core/pipeline/fit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/model/widen.h"

namespace seedmesh {
namespace {

constexpr const char* pointer = "/output/max_triangles";

/// A mesh of fewer triangles than this is not made simpler for a level of detail: a box would be none.
constexpr std::uint64_t least_simplified = 64;
constexpr double most_of_level = 0.9;  ///< triangles of a level that is worth it, of the one before

/// `level` becomes the finest, with at most `lods` - 1 behind it; meshes that no node shows any more go.
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
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (!shown[i]) model.meshes[i].primitives.clear();
  }
}

}  // namespace

std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, const Sacrifice& sacrifice, Job& job) {
  widen(model, job);
  const auto wanted = static_cast<std::size_t>(lods);
  const std::size_t levels = levels_of(model);
  std::size_t level = 0;
  while (level + 1 < levels && drawn_at(model, level) > most) ++level;
  // Where surfaces move by little, the level before may be brought within the budget and lose less.
  if (level > 0 && std::isfinite(sacrifice.detail) && drawn_at(model, level) <= most &&
      coarsen_if_it_fits(model, level - 1, most, sacrifice, job))
    --level;
  promote(model, level, wanted);
  if (drawn_at(model, 0) > most) coarsen_all(model, 0, most, 0, sacrifice, job);
  const std::uint64_t drawn = drawn_at(model, 0);
  if (drawn > most) {
    return Issue{pointer, "the model has " + std::to_string(drawn) +
                              " triangles where it is coarsest; found a budget of " + std::to_string(most)};
  }
  while (levels_of(model) < std::min(wanted, levels) && deepen(model, 0, most_of_level, sacrifice, job)) {
  }
  return std::nullopt;
}

std::optional<Issue> add_levels(Model& model, int lods, const Sacrifice& sacrifice, Job& job) {
  const auto wanted = static_cast<std::size_t>(lods);
  if (levels_of(model) == 1) {
    widen(model, job);
    Sacrifice more = sacrifice;
    while (levels_of(model) < wanted && deepen(model, least_simplified, most_of_level, more, job)) {
      more.detail *= 2;  // who is twice as far away sees half as much
    }
  }
  const std::size_t levels = levels_of(model);
  if (levels >= wanted) return std::nullopt;
  if (levels == 1) {
    return Issue{"/output/lods", "found " + std::to_string(lods) +
                                     " levels of detail; this model has one and cannot be made simpler"};
  }
  model.warnings.push_back({"/output/lods",
                            "the model has " + std::to_string(levels) + " levels of detail and not " +
                                std::to_string(lods) + ": the coarsest cannot be made simpler",
                            0, 0});
  return std::nullopt;
}

}  // namespace seedmesh
