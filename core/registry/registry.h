#pragma once
/// The list of all generators. Only core/pipeline and tests use it: generators get it through their context.
#include "core/generators/api.h"

namespace seedmesh {

/// Returns all generators, in the order of the page's menu.
GeneratorList generators();

/// Returns the generator of this name, or null if there is none.
inline const Generator* find_generator(std::string_view name) { return find_generator(generators(), name); }

}  // namespace seedmesh
