#pragma once
/// Writes trees of the model proctree as files of proctree.js.
#include <string>

#include "generated/params/tree.h"

namespace seedmesh {

/// Returns the 22 parameters as a JSON object with the names of proctree.js.
std::string proctree_file(const TreeParams& params);

}  // namespace seedmesh
