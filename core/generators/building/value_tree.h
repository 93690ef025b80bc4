#pragma once
/// Expressions that lang::Program cannot represent, as trees of ValueNode: texts that are joined, arrays, functions
/// that call themselves, and functions of the CGA reference on texts, arrays and geometry (value_functions.h).
#include "core/generators/building/parser.h"

namespace seedmesh::building {

enum class TreeNeed : std::uint8_t {
  unneeded,  ///< lang::Program can represent the expression
  fallback,  ///< lang::Program can represent it if all parameters are numbers
  always
};

/// Whether the tokens from `from` to before `to` need a tree.
TreeNeed tree_need(Parser& p, std::size_t from, std::size_t to);

/// Reads the expression of these tokens. Returns the node of its root. Errors are added to the parser.
std::uint32_t parse_tree(Parser& p, std::size_t from, std::size_t to);

/// The same, with selectors such as front and world.up as truth values of a component.
std::uint32_t parse_selector_tree(Parser& p, std::size_t from, std::size_t to);

/// Whether a function of the rules needs a tree, because its value does, or because it calls itself.
bool function_needs_tree(Parser& p, std::string_view name);

/// Whether a name is a property or function that only trees have, such as geometry.du or comp.sel.
bool is_tree_name(std::string_view name);

}  // namespace seedmesh::building
