#pragma once
/// Walls with one window in each tile, for houses that are seen from far.
#include <glm/vec2.hpp>

#include "core/texture/relief.h"

namespace seedmesh::texture {

/// The size of one bay of a wall in metres: the distance of windows and the height of a floor.
constexpr glm::dvec2 bay_tile{2.7, 2.8};

/// Adds a window with a frame, a bar and a sill to the relief of a wall that is one bay wide and high. The accent
/// becomes the share of the glass; where the relief had an accent, as in joints, it becomes a light tone. Cost: one
/// pass over the texels.
Relief with_window(Relief wall, const Job& job);

}  // namespace seedmesh::texture
