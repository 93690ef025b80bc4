#pragma once
/// Queries on the transform of a node.
#include "core/model/model.h"

namespace seedmesh {

/// True where the transform changes no bit of any point.
bool is_identity(const Transform& transform);

}  // namespace seedmesh
