#pragma once
/// Cuts the beginning off an animation.
#include "core/model/model.h"

namespace seedmesh {

/// Removes the first `seconds`: at time t, every channel then has the value that it had at t + `seconds`. Each channel
/// keeps at least one key. Linear and step interpolation; rotations are interpolated component by component.
void trim(Animation& animation, float seconds);

}  // namespace seedmesh
