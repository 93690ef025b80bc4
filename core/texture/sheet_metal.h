#pragma once
/// Metal on walls: sheets with ribs, and smooth panels.
#include <glm/vec2.hpp>

#include "core/base/rng.h"
#include "core/texture/relief.h"

namespace seedmesh::texture {

/// The size of both textures in metres.
constexpr glm::dvec2 sheet_metal_tile{1, 1};

/// Paint a texture. Cost: about 10 ns a texel.
Relief sheet(int size, Rng rng, const Job& job);
Relief panels(int size, Rng rng, const Job& job);

}  // namespace seedmesh::texture
