#pragma once
/// Checks of parameters that the schema cannot express.
#include <vector>

#include "core/base/result.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {

/// Adds an error for each stage that has too many rounds, no points, or no meaning for the method.
void check_stages(const FractalParams& params, std::vector<Issue>& issues);

/// Adds errors of the element: a plate for instructions that have no plate, or a file that is not a GLB.
void check_element(const FractalParams& params, std::vector<Issue>& issues);

}  // namespace seedmesh::fractal
