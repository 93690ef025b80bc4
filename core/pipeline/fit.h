#pragma once
/// A model within a budget of triangles.
#include <cstdint>
#include <optional>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {

/// The levels of detail that a model is made with so that a coarser one can take the place of the finest.
constexpr int levels_to_choose_from = 5;

/// Makes the finest level of the model draw at most `most` triangles, and leaves it `lods` levels in all:
/// takes the finest of its levels that fits, and where none does, thins the leaves of the coarsest and
/// simplifies the rest of it; levels that are missing behind it have half the triangles of the one before. An
/// Issue where that is not enough. Before finish().
std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, Job& job);

}  // namespace seedmesh
