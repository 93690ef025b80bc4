#pragma once
/// Patterns of a layer by its parameters: which places there are before any rule is asked.
#include "core/generators/scene/stands.h"

namespace seedmesh {
struct ScenePlace;
struct SceneParams;
enum class SceneMethod;
}  // namespace seedmesh

namespace seedmesh::scene {

/// The member of a place that says how many places a pattern has.
const char* amount_of(SceneMethod method);

/// The part of the ground in which a layer may have places.
Extent part_of(const ScenePlace& place, const Extent& ground);

/// The places of a pattern that has as many as fit: at distances, in rows, along a path.
Array<Stand> pattern_of(const ScenePlace& place, const Extent& ground, Rng rng, const Job& job);

/// Throws Stop, pointing to the member of amount_of(), where a pattern of a layer would have more places than
/// the limit on shapes, as pattern_of() does. Makes nothing. The ground is that of the parameters; of a
/// terrain from a picture nothing is known before it is read, and only paths are looked at.
void refuse_patterns(const SceneParams& params, const Job& job);

}  // namespace seedmesh::scene
