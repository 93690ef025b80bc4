#pragma once
/// The words of ShapeML's notation and their counterparts in rules of buildings.
#include <span>
#include <string_view>

namespace seedmesh {

/// An operation. In `rules`, $1 to $4 are its arguments and $* all of them. Empty: it has no counterpart.
struct ShapemlOperation {
  std::string_view name;
  int least, most;  ///< number of arguments; -1: any
  std::string_view rules;
  bool is_left_out = false;  ///< gives a warning; the geometry is the same without it
};
std::span<const ShapemlOperation> shapeml_operations();

/// A name in expressions, and how rules write it.
struct ShapemlName {
  std::string_view name, rules;
};
std::span<const ShapemlName> shapeml_names();

/// A ShapeML function without a counterpart, and its definition in the language of rules. It is written
/// before rules that call it.
struct ShapemlFunction {
  std::string_view name, declaration;
};
std::span<const ShapemlFunction> shapeml_functions();

}  // namespace seedmesh
