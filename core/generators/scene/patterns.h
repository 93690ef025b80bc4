#pragma once
/// Computes the candidate positions of a layer from its parameters, before any rule applies.
#include "core/generators/scene/candidate_positions.h"

namespace seedmesh {
struct ScenePlace;
struct SceneParams;
enum class SceneMethod;
}  // namespace seedmesh

namespace seedmesh::scene {

/// Returns the JSON pointer of the member that sets the number of positions of a pattern.
const char* amount_of(SceneMethod method);

/// Returns the part of the ground in which a layer can have positions.
Extent part_of(const ScenePlace& place, const Extent& ground);

/// Returns the positions of a pattern that fills the ground: by distance, in rows, or along a path.
Array<Placement> pattern_of(const ScenePlace& place, const Extent& ground, Rng rng, const Job& job);

/// Throws Stop where a pattern would exceed the limit on shapes, as pattern_of() does. The pointer is that of
/// amount_of(). Computes no positions. For a terrain from an image, whose size is unknown, only paths are
/// checked.
void refuse_patterns(const SceneParams& params, Job job);

}  // namespace seedmesh::scene
