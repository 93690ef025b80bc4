#pragma once
/// The table of operations: one row serves the parser, the faults, the docs and GET /v1/vocabulary.
#include <span>
#include <string_view>

#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// What stands in braces behind an operation.
enum class Braces : std::uint8_t { absent, cells, one, names, selectors };

struct OperationRow {
  std::string_view name;
  Op op;
  /// A letter an argument: n length or number, w word or text, t text (an expression that gives one), h an
  /// angle or byHeight(...), i a word or a whole number. What stands behind | may be left out.
  std::string_view arguments;
  Braces braces;
  std::string_view parameters;  ///< their names, as the docs print them
  std::string_view text;        ///< one sentence for the reader
  std::string_view example;     ///< rules that the tests derive
};

std::span<const OperationRow> operations();

/// scope, cut, mass, roof, part, look, texture, attribute or report: a group for the reader.
std::string_view kind_of(Op op);

/// Null: there is no operation of this name.
const OperationRow* find_operation(std::string_view name);

}  // namespace seedmesh::building
