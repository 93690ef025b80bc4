#pragma once
/// The list of all generators. Only core/pipeline and tests use it: generators get it through their context.
#include "core/generators/api.h"

namespace seedmesh {

/// In the order of the menu.
GeneratorList generators();

/// Null: there is no generator of this name.
inline const Generator* find_generator(std::string_view name) { return find_generator(generators(), name); }

}  // namespace seedmesh
