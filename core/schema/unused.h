#pragma once
/// What generated code reports about parameters that have no effect (x-applies-when in the schema).
#include <string>

namespace seedmesh {

struct UnusedParameter {
  std::string pointer;  ///< JSON Pointer, relative to the parameters
  std::string message;  ///< "`leaf.fold` has no effect unless `leaf.build` is curved or mesh."
};

}  // namespace seedmesh
