#pragma once
/// Chooses a rule for a shape and runs the steps of its successor.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Whether the shape can be replaced: it is part of the result, and its symbol has rules.
bool has_rule(const Derivation& d, const Shape& shape);

/// Replaces a shape by the successor of its rule. Returns false if no rule has a true condition. The shape then
/// becomes a leaf.
bool expand(Derivation& d, std::uint32_t shape);

/// Replaces the shapes from index `first` on until none has a rule, the newest first. Rules whose left side has
/// several shapes (joined_shapes.h) are applied last.
void finish_from(Derivation& d, std::uint32_t first);

/// Runs a body that is nested in a successor, for a shape that an operation made. The first branch whose
/// condition is true is used, and one of its choices is selected by weight.
void run_body(Derivation& d, std::uint32_t body, const ShapeState& state, const Frame& frame);

/// Adds a shape that no rule replaces. Spends Resource::shapes.
void add_leaf(Derivation& d, const ShapeState& state, const Frame& frame, std::uint64_t key,
              std::uint32_t symbol);

}  // namespace seedmesh::building
