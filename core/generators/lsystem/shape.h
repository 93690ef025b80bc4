#pragma once
/// Changes a drawn skeleton before meshing: width rules over the whole plant, and weather.
#include "core/geom/plant/limbs.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

void shape(Skeleton& skeleton, const LsystemParams& params, Job& job);

}  // namespace seedmesh::lsystem
