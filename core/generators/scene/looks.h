#pragma once
/// A model as a scene takes it: one mesh a level, and materials that others may have too.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::scene {

enum class Seeds { must_agree, may_differ };

/// Names aside, but for the seeds of recipes where these may differ.
bool is_same(const Material& a, const Material& b, Seeds seeds);

/// Moves bodies that may touch, as the parts of a building do, a hair apart, each by less than two
/// ten-thousandths of the whole and by another way than those near it: in one mesh their edges would have
/// four faces, and faces that lie on each other would be there twice.
void set_apart(Model& model);

/// One mesh for each level of a model, taken out of it, with that model's own materials.
std::vector<std::vector<Primitive>> levels_made(Model& model, Job& job);

}  // namespace seedmesh::scene
