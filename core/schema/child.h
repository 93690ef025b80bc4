#pragma once
/// A request inside a request: a model that another model is made of. The readers made from a schema take it
/// where the schema refers to common.schema.json#/$defs/child; core/generators/child.h makes its model.
#include <cstdint>
#include <optional>
#include <string>

namespace seedmesh {

/// Its preset is resolved when it is read. A value: nothing in it can lead back to the request around it.
struct Child {
  std::string generator;              ///< empty where it was refused
  std::optional<std::uint64_t> seed;  ///< none: drawn by place from the seed of the request around it
  std::string parameters = "{}";  ///< JSON text; canonical after read_parameters (core/generators/child.h)

  friend bool operator==(const Child&, const Child&) = default;
};

/// A child in parameters, with its pointer relative to them.
struct ChildPlace {
  std::string pointer;
  Child* child = nullptr;
};

}  // namespace seedmesh
