#pragma once
/// Bodies of buildings as they are written: with points in single precision.
#include "core/geom/polygon/massing.h"

namespace seedmesh {

/// Joins points that are equal in single precision, and removes triangles that are then lines or lie back to
/// back. Without such points the mass keeps its triangles. Returns whether the result is closed (is_closed).
bool merge_points(Mass& mass);

}  // namespace seedmesh
