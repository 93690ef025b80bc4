#pragma once
/// Fits a model into a budget of triangles, and gives it levels of detail.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"
#include "core/pipeline/coarsen.h"

namespace seedmesh {

/// Levels of detail that a model gets so that a coarser one can replace the finest.
constexpr int levels_to_choose_from = 5;

/// Makes the finest level of the model draw at most `most` triangles, and leaves `lods` levels in all. The
/// finest level that fits becomes the first. Where none fits, the leaves of the coarsest level are thinned
/// out and the rest is simplified. Missing levels have half the triangles of the one before, as far as that
/// is possible. Returns an Issue where the budget cannot be kept. Call it before finish().
std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, const SimplifyLimits& limits, Job& job);

/// Gives a model with one level up to `lods` levels, each with half the triangles of the one before. A model
/// that has several levels keeps them. Adds a warning where there are fewer than `lods`; returns an Issue
/// where there is still only one. Call it after fit() and before finish().
std::optional<Issue> add_levels(Model& model, int lods, const SimplifyLimits& limits, Job& job);

/// Gives a model levels with about these numbers of triangles, which are in descending order. A level of the
/// model with up to a tenth fewer triangles is used as it is. Otherwise the next finer level is simplified.
/// Adds a warning for each level that cannot lose enough, and leaves out those that would keep more than nine
/// tenths of the level before. Sets Node::screen. Returns an Issue where the finest level exceeds the first
/// number, or where only one of several levels remains. Call it before finish().
std::optional<Issue> fit_levels(Model& model, const std::vector<std::uint64_t>& triangles,
                                const SimplifyLimits& limits, Job& job);

}  // namespace seedmesh
