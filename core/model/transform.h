#pragma once
/// What a transform of a node does.
#include "core/model/model.h"

namespace seedmesh {

/// Whether all stays where it is, to the bit.
bool is_identity(const Transform& transform);

}  // namespace seedmesh
