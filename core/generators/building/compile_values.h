#pragma once
/// Expressions of rules, compiled for core/lang. Texts become ids in Grammar::texts, and queries about
/// other shapes become slots. If lang::Program can represent the value, functions of the rules are expanded where they
/// are called, and `case` and percentages become select(). Otherwise a tree of ValueNode is made.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Returns the index of a query about other shapes in Grammar::queries, which gets the query if it is new.
std::uint32_t query_index(Parser& p, Query::Kind kind, std::string target);

/// Returns the end of the value that begins at token i: an expression, or the cases of a function or attribute.
/// Returns i if no value begins there.
std::size_t end_of_value(const Parser& p, std::size_t i);

/// Compiles the tokens from `from` to before `to`.
Value compile_value(Parser& p, std::size_t from, std::size_t to);

/// Compiles the value that begins at the next token, and advances the parser past it.
Value parse_value(Parser& p);

}  // namespace seedmesh::building
