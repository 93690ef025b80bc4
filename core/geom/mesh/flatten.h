#pragma once
/// Conversion of a model to a list of primitives, for generators that use other models as parts.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// Joins all meshes of the nodes of `model` into one primitive for each material and topology, in the order of first
/// use. Transforms and instances are applied. Where only some parts have an attribute, the others get white, texture
/// coordinate 0 or the normal +Y. Skins keep their bind pose. Coarser levels, tangents and animations are dropped.
/// Spends the triangles of additional copies.
std::vector<Primitive> flatten(const Model& model, Job& job);

/// Moves and scales the primitives so that their common bounding box has its centre at the origin and its
/// longest side is 1. Returns false, and changes nothing, where they have no extent.
bool fit_unit_box(std::vector<Primitive>& primitives);

}  // namespace seedmesh
