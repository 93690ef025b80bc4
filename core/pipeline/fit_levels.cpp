#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/model/build.h"
#include "core/model/index_width.h"
#include "core/model/levels.h"
#include "core/pipeline/fit.h"

namespace seedmesh {
namespace {

constexpr double near_enough = 0.9;    ///< of the requested triangles: a level of the model is used as it is
constexpr double too_many = 1.02;      ///< times the requested triangles, above which there is a warning
constexpr double most_of_level = 0.9;  ///< a level may have this share of the triangles of the one before
/// Smaller meshes keep their triangles as long as others suffice: simplification would collapse a box.
constexpr std::uint64_t least_simplified = 64;

const char* const pointer = "/output/lods";

std::string pointer_to(std::size_t level) { return std::string(pointer) + "/" + std::to_string(level); }

bool is_shape(const Node& node) { return node.collision != CollisionShape::none; }

std::uint64_t triangles_of_shapes(const Model& model) {
  std::uint64_t triangles = 0;
  for (const Node& node : model.nodes) {
    if (node.mesh >= 0 && is_shape(node))
      triangles += triangles_of(model.meshes[static_cast<std::size_t>(node.mesh)]);
  }
  return triangles;
}

/// Builds levels of copies of the levels that the generator made.
class Fitting {
 public:
  Fitting(Model& model, const SimplifyLimits& limits, Job& job)
      : model_(model), limits_(limits), job_(job), shapes_(triangles_of_shapes(model)) {
    for (const Node& node : model.nodes) {
      std::vector<int> own;
      if (node.mesh >= 0 && !is_shape(node)) {
        own.push_back(node.mesh);
        own.insert(own.end(), node.lods.begin(), node.lods.end());
      }
      own_.push_back(std::move(own));
    }
    for (std::size_t level = 0; level < levels_of(model); ++level) has_.push_back(drawn(level));
    used_.assign(has_.size(), false);
  }

  /// Triangles of the model's own level `level` without collision shapes.
  std::uint64_t own_triangles(std::size_t level) const { return has_[level]; }
  std::uint64_t drawn(std::size_t level) const { return drawn_at(model_, level) - shapes_; }

  void clear() {
    for (Node& node : model_.nodes) {
      if (!is_shape(node)) node.lods.clear();
    }
  }

  /// Adds a level with about `wanted` triangles.
  void add(std::size_t level, std::uint64_t wanted) {
    std::size_t source = 0;
    while (source + 1 < has_.size() &&
           static_cast<double>(has_[source + 1]) >= near_enough * static_cast<double>(wanted))
      ++source;
    while (true) {
      show(level, source, has_[source] > wanted);
      if (has_[source] <= wanted) return;
      simplify(level, wanted);
      // Where surfaces may move only a little, the next coarser level of the model may be what fits.
      if (drawn(level) <= wanted || source + 1 == has_.size()) return;
      ++source;
    }
  }

 private:
  /// Shows the model's own level `source` at `level`, as a copy if it will be changed or is shown already.
  void show(std::size_t level, std::size_t source, bool changes) {
    const bool copies = changes || used_[source];
    if (!changes) used_[source] = true;
    std::vector<int> copy(model_.meshes.size(), -1);
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (own_[i].empty()) continue;
      int mesh = own_[i][std::min(source, own_[i].size() - 1)];
      if (mesh >= 0 && copies) {
        int& made = copy[static_cast<std::size_t>(mesh)];
        if (made < 0) made = add_mesh(model_, copy_of(model_.meshes[static_cast<std::size_t>(mesh)]));
        mesh = made;
      }
      Node& node = model_.nodes[i];
      if (level == 0) {
        node.mesh = mesh;
      } else {
        node.lods.resize(level, mesh);
        node.lods.back() = mesh;
      }
    }
  }

  void simplify(std::size_t level, std::uint64_t wanted) {
    SimplifyLimits limits = limits_;
    for (std::size_t i = 0; i < level; ++i) limits.detail *= 2;  // each level is seen from farther away
    coarsen_all(model_, level, wanted + shapes_, least_simplified, limits, job_);
    if (drawn(level) > wanted && !std::isfinite(limits.detail))
      coarsen_all(model_, level, wanted + shapes_, 0, limits, job_);
  }

  Model& model_;
  SimplifyLimits limits_;
  Job& job_;
  std::uint64_t shapes_;               ///< triangles of collision shapes
  std::vector<std::vector<int>> own_;  ///< for each node its meshes by level
  std::vector<std::uint64_t> has_;     ///< triangles of the model's own levels
  std::vector<bool> used_;             ///< own levels that are shown as they are
};

void drop_level(Model& model, std::size_t level) {
  for (Node& node : model.nodes) {
    if (node.lods.size() >= level)
      node.lods.erase(node.lods.begin() + static_cast<std::ptrdiff_t>(level) - 1);
  }
}

/// A level is shown where the triangles on a piece of the screen are as many as those of the finest level that fills
/// it: the size falls with the root of the triangles.
void set_screen(Model& model, const std::vector<std::uint64_t>& drawn) {
  std::vector<float> screen;
  for (std::size_t i = 1; i < drawn.size(); ++i) {
    const double share =
        static_cast<double>(drawn[i]) / static_cast<double>(std::max<std::uint64_t>(drawn[0], 1));
    screen.push_back(static_cast<float>(std::floor(std::sqrt(share) * 1000 + 0.5) / 1000));
  }
  for (Node& node : model.nodes) {
    if (!node.lods.empty()) node.screen = screen;
  }
}

std::string count_text(std::uint64_t triangles) { return std::to_string(triangles) + " triangles"; }

}  // namespace

std::optional<Issue> fit_levels(Model& model, const std::vector<std::uint64_t>& triangles,
                                const SimplifyLimits& limits, Job& job) {
  widen(model, job);
  Fitting fitting(model, limits, job);
  fitting.clear();
  fitting.add(0, triangles.front());
  std::vector<std::uint64_t> drawn = {fitting.drawn(0)};
  if (drawn[0] > triangles[0]) {
    return Issue{IssueKind::not_available, pointer_to(0),
                 "the finest level cannot have fewer than " + count_text(drawn[0]) + "; found a budget of " +
                     std::to_string(triangles[0])};
  }
  for (std::size_t i = 1; i < triangles.size(); ++i) {
    const std::size_t level = drawn.size();
    fitting.add(level, triangles[i]);
    const std::uint64_t made = fitting.drawn(level);
    if (static_cast<double>(made) > most_of_level * static_cast<double>(drawn.back())) {
      drop_level(model, level);
      model.warnings.push_back({pointer_to(i),
                                "there is no level with " + count_text(triangles[i]) +
                                    ", because the level before has " + count_text(drawn.back()) +
                                    " and cannot be simplified",
                                0, 0});
      continue;
    }
    if (static_cast<double>(made) > too_many * static_cast<double>(triangles[i])) {
      model.warnings.push_back({pointer_to(i),
                                "found " + count_text(triangles[i]) + "; the level has " +
                                    std::to_string(made) + ", because it cannot be simplified further",
                                0, 0});
    }
    drawn.push_back(made);
  }
  if (drawn.size() == 1 && triangles.size() > 1) {
    return Issue{IssueKind::not_available, pointer,
                 "found " + std::to_string(triangles.size()) +
                     " levels of detail; this model has one and cannot be simplified"};
  }
  empty_hidden_meshes(model);
  set_screen(model, drawn);
  return std::nullopt;
}

}  // namespace seedmesh
