#pragma once
/// Parameters that a request gives and its machine does not read.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// One warning for each parameter that is not its default and has no effect: of another method, of another
/// kind of cloud, set or surface. Pointers are relative to the parameters.
std::vector<Warning> idle_parameters(const FractalParams& params);

}  // namespace seedmesh::fractal
