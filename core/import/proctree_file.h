#pragma once
/// Writes trees of the model proctree as files of proctree.
#include <string>
#include <string_view>

#include "generated/params/tree.h"

namespace seedmesh {

/// Names of the 22 parameters: of the translation to C++ ("mLevels"), as in listing 2.1 of Hutsko's thesis (2022), or
/// of proctree.js ("levels").
enum class ProctreeNames { translation, original };

/// Returns the 22 parameters as a JSON object.
std::string proctree_file(const TreeParams& params, ProctreeNames names);

/// Returns the name in proctree.js of a parameter: "levels" for "mLevels". proctree.js misspells one of them.
std::string proctree_js_name(std::string_view parameter);

}  // namespace seedmesh
