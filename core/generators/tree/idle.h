#pragma once
/// Parameters that a request gives and its tree does not read.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {
struct TreeParams;
}

namespace seedmesh::tree {

/// One warning for each parameter that is not its default and has no effect: of another model, of levels,
/// leaves, roots, an age or pictures that there are not. What a season leaves without leaves is not told,
/// since seasons change. Pointers are relative to the parameters.
std::vector<Warning> idle_parameters(const TreeParams& params);

}  // namespace seedmesh::tree
