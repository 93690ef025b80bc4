#pragma once
/// Cross-sections of generalized cylinders, from the request.
#include <vector>

#include "core/base/result.h"
#include "core/geom/plant/contour.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// Checks what the schema cannot express: each contour is star-shaped about the origin, and neighbouring
/// points keep a minimum distance.
void check_contours(const LsystemParams& params, std::vector<Issue>& issues);

/// Returns the contours of `params`, in order. Requires that check_contours() reported no issue.
std::vector<Contour> contours_of(const LsystemParams& params);

}  // namespace seedmesh::lsystem
