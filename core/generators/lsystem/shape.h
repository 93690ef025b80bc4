#pragma once
/// What happens to a drawn skeleton before it is dressed: width laws over the whole, weather.
#include "core/geom/limbs.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

void shape(Skeleton& skeleton, const LsystemParams& params, Job& job);

}  // namespace seedmesh::lsystem
