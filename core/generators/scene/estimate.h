#pragma once
/// What a scene will have, before anything is placed or made.
#include <optional>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/generators/scene/casts.h"

namespace seedmesh::scene {

/// The ground, before it is made: a square. Nothing for a terrain from a picture, whose depth is not known.
std::optional<Extent> extent_told(const SceneParams& params);

/// How many of a layer stand, at most, where all of `extent` suits it: the number that is asked for, or that
/// its pattern has room for.
double expected_stands(const SceneLayer& layer, const Extent& extent);

/// Every model by itself (`estimates`, by Casting::casts) as often as it stands, and the ground; nothing
/// where no model of a layer can tell. One that cannot tell counts as the mean of its layer, a reduced ground
/// as an eighth of its grid. Exact where each place is given and each model is exact. Bytes: each model once,
/// and a node for each place.
std::optional<Estimate> estimate_of(const SceneParams& params, const Casting& casting,
                                    const std::vector<std::optional<Estimate>>& estimates, const Job& job);

}  // namespace seedmesh::scene
