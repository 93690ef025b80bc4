#pragma once
/// Successors of rules: symbols, operations, brackets, cases and percentages.
#include "core/generators/building/operations.h"
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Reads `case ... else ...`, or one list of choices. Returns the number of the body in the grammar.
std::uint32_t parse_body(Parser& p);

/// Reads steps up to the end of the successor.
Choice parse_successor(Parser& p);

/// Reads one symbol or operation. Returns false and adds an error if none begins here.
bool parse_step(Parser& p, std::vector<Step>& out);

/// Returns the operation that begins at the next token; null if none does. An operation without arguments
/// needs no brackets, unless a rule has its name or a dot follows, which makes the name a leaf.
const OperationRow* operation_here(const Parser& p);

/// Reads an operation with its arguments and what it has in braces.
void parse_operation(Parser& p, const OperationRow& row, std::vector<Step>& out);

/// Reads an argument of an operation by the letter of its kind (OperationRow::arguments).
Argument parse_argument(Parser& p, char kind);

}  // namespace seedmesh::building
