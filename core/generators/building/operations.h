#pragma once
/// The table of operations, for the parser, its messages, the docs and GET /v1/vocabulary.
#include <span>
#include <string_view>

#include "core/generators/building/syntax.h"

namespace seedmesh::building {

/// What follows an operation in braces.
enum class Braces : std::uint8_t {
  absent,
  cells,
  one,
  names,
  selectors,
  perimeter,  ///< { length : depth : successor | ... } { remainder : successor }
  operands,   ///< { successor | successor }
  next,       ///< no braces: the step after it
};

/// What the service does with a name of the CGA reference.
enum class Status : std::uint8_t {
  done,
  ignored,  ///< it gives a warning and has no effect
  error,
};
/// Returns the name of a status.
std::string_view text_of(Status status);

struct OperationRow {
  std::string_view name;
  Op op;
  /// One letter for each argument: n length or number, w word or text, t text (an expression), h angle or
  /// byHeight(...), i word or whole number, x word or expression. Arguments behind | are optional.
  std::string_view arguments;
  Braces braces;
  std::string_view parameters;  ///< their names, for the docs
  std::string_view text;        ///< one sentence for the reader
  std::string_view example;     ///< rules that the tests run
  Status status = Status::done;
};

/// Returns all operations.
std::span<const OperationRow> operations();

/// Returns the group of an operation in the vocabulary: scope, cut, mass, roof, part, material, texture,
/// attribute or report.
std::string_view kind_of(Op op);

/// Returns the operation of this name; null if there is none.
const OperationRow* find_operation(std::string_view name);

}  // namespace seedmesh::building
