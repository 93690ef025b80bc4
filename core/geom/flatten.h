#pragma once
/// A model as one mesh: for what is made of other models.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {

/// All that the nodes of `model` show, transforms and instances applied, joined to one primitive for each
/// material and topology in the order of their first use. Attributes that only some parts have are filled:
/// white, or texture coordinate 0. Skins stay in their bind pose; coarser levels, tangents and animations are
/// left out. Spends triangles for what is drawn more than once.
std::vector<Primitive> flatten(const Model& model, Job& job);

/// Moves the primitives so that the box of all of them has its centre at the origin and its longest side is
/// 1. False: they have no extent at all.
bool fit_unit_box(std::vector<Primitive>& primitives);

}  // namespace seedmesh
