#pragma once
/// A request inside a request: the model of the inner request becomes part of the outer model. Generated
/// readers accept one wherever a schema refers to common.schema.json#/$defs/child. core/generators/child.h
/// makes its model.
#include <cstdint>
#include <optional>
#include <string>

namespace seedmesh {

/// A plain value without references to the outer request. A preset is already merged in.
struct Child {
  std::string generator;              ///< empty if the request had an error
  std::optional<std::uint64_t> seed;  ///< none: derived from the seed of the outer request
  std::string parameters = "{}";  ///< JSON text; canonical after read_parameters (core/generators/child.h)

  friend bool operator==(const Child&, const Child&) = default;
};

/// A child inside parameters, and the JSON Pointer from those parameters to it.
struct ChildLocation {
  std::string pointer;
  Child* child = nullptr;
};

}  // namespace seedmesh
