#pragma once
/// The request's cross-sections of generalized cylinders.
#include <vector>

#include "core/base/result.h"
#include "core/geom/contour.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// What the schema cannot say of the contours: closed about the middle, with room between their points.
void check_contours(const LsystemParams& params, std::vector<Issue>& issues);

/// Those of `params`, in order. Checked before.
std::vector<Contour> contours_of(const LsystemParams& params);

}  // namespace seedmesh::lsystem
