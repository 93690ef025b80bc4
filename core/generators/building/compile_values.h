#pragma once
/// Expressions of rules, compiled for core/lang. Functions of the rules are written out where they are
/// called, texts become numbers of Grammar::texts, queries to other shapes become slots, and `case` and
/// percentages become select().
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// The number of a query to other shapes in the grammar, which gets it if it is new.
std::uint32_t query_index(Parser& p, Query::Kind kind, std::string target);

/// Where the value that begins at token i ends: an expression, or the cases of a function or attribute. i if
/// no value begins there.
std::size_t end_of_value(const Parser& p, std::size_t i);

/// Compiles the tokens from `from` to before `to`.
Value compile_value(Parser& p, std::size_t from, std::size_t to);

/// Compiles the value that begins at the next token, and moves behind it.
Value parse_value(Parser& p);

}  // namespace seedmesh::building
