#pragma once
/// The list of all generators. Only core/pipeline and tests use it: generators get it through their context.
#include "core/generators/api.h"

namespace seedmesh {

/// Returns all generators, in the order of the page's menu.
GeneratorList generators();

/// Returns null where there is no generator of this name.
inline const Generator* find_generator(std::string_view name) { return find_generator(generators(), name); }

}  // namespace seedmesh
