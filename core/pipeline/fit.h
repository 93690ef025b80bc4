#pragma once
/// A model within a budget of triangles, and with as many levels of detail as are wanted.
#include <cstdint>
#include <optional>

#include "core/base/job.h"
#include "core/model/model.h"
#include "core/pipeline/coarsen.h"

namespace seedmesh {

/// The levels of detail that a model is made with so that a coarser one can take the place of the finest.
constexpr int levels_to_choose_from = 5;

/// Makes the finest level of the model draw at most `most` triangles, and leaves it `lods` levels in all:
/// takes the finest of its levels that fits, and where none does, thins the leaves of the coarsest and
/// simplifies the rest of it; levels that are missing behind it have half the triangles of the one before, as
/// far as that goes. An Issue where the budget cannot be kept. Before finish().
std::optional<Issue> fit(Model& model, std::uint64_t most, int lods, const Sacrifice& sacrifice, Job& job);

/// Gives a model that has one level `lods` of them, each the one before with half its triangles, as far as it
/// can be made simpler. A model that has levels of its own keeps these. A warning where there are fewer than
/// `lods`; an Issue where there is still but one. After fit() and before finish().
std::optional<Issue> add_levels(Model& model, int lods, const Sacrifice& sacrifice, Job& job);

}  // namespace seedmesh
