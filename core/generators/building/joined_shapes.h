#pragma once
/// Rules whose left side has several shapes, as in `pane + pane ~> wide.`
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Searches the shapes from `first` on that were made of `parent` for the left sides of the grammar, in the order of the
/// rules. Shapes match where their symbols and numbers of parameters agree, their scopes have the same axes and
/// together fill one box, and a rule for them holds. They become inactive, and a joined shape with that box and all
/// parameters is added, as a child of the first of them. Spends Resource::shapes. Cost: quadratic in the number of
/// these shapes.
void join_children(Derivation& d, std::uint32_t parent, std::uint32_t first);

}  // namespace seedmesh::building
