#pragma once
/// Warnings about parameters of a building that are given and have no effect.
#include <vector>

#include "core/base/result.h"
#include "core/generators/building/syntax.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// Returns the warnings that the schema states (x-applies-when) and those that depend on the rules: `repeat` without a
/// repeat, `weights` without a probability, and materials, assets and tables whose names the rules do not contain. A
/// name counts as contained if a text of the rules or of an attribute is a part of it or contains it, so that names
/// that rules compose get no warning. `grammar` is null for a shape grammar.
std::vector<Warning> unused_settings(const BuildingParams& params, const Grammar* grammar);

}  // namespace seedmesh::building
