#pragma once
/// Reads declarations of attributes, constants and functions with their annotations. A declaration may follow
/// the rules that use it.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Finds all declarations, and the symbols that have rules. Expressions are not read yet.
void collect_declarations(Parser& p);

/// Compiles the values of all attributes and gives each a slot. Attributes that depend on each other in a
/// cycle are an error.
void compile_attributes(Parser& p);

}  // namespace seedmesh::building
