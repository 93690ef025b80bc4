#pragma once
/// Rules whose left side has several shapes, as in `pane + [door] ~> wide.`: a set grammar (Stiny 1982; Kogovšek
/// 2014, 4.1 and 4.2), whose left sides are connected shapes of the whole figure, at any position and rotation.
///
/// Shapes of such left sides wait until no other shape can be replaced. The left sides are then searched in the order
/// of the rules, and their shapes in the order of the tree. The result therefore does not depend on the order of the
/// derivation. Shapes that no left side matches are replaced by the rules of their own symbols.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Whether the shape waits until no other shape can be replaced.
bool waits(const Derivation& d, const Shape& shape);

/// Searches the shapes from `first` on. The result is to be replaced next: joined shapes if a left side matches,
/// else the waiting shapes that have a rule of their own, in the order of the tree.
///
/// Shapes match where their symbols and numbers of parameters agree, each is a neighbour of another one
/// (contact.h), and a rule for them applies. Those that the rule does not keep become inactive. The joined
/// shape is a child of the first of them. Its geometry is their union, and it has the parameters of all. If
/// they fill a box in the axes of the first, it is that box. Spends Resource::shapes. Cost of a search for
/// left sides of two shapes: n log² n for n waiting shapes and their neighbours.
std::vector<std::uint32_t> take_waiting(Derivation& d, std::uint32_t first);

}  // namespace seedmesh::building
