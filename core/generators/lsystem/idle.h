#pragma once
/// Parameters that a request gives and its L-system does not read.
#include <vector>

#include "core/model/model.h"

namespace seedmesh {
struct LsystemParams;
}

namespace seedmesh::lsystem {

/// One warning for each parameter that is not its default and has no effect: of another width rule or
/// style, of rules, weather or pictures that there are not. Pointers are relative to the parameters.
std::vector<Warning> idle_parameters(const LsystemParams& params);

}  // namespace seedmesh::lsystem
