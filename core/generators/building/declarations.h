#pragma once
/// Attributes, constants, functions and their annotations. They may be declared after the rules that use
/// them.
#include "core/generators/building/parser.h"

namespace seedmesh::building {

/// Finds all declarations, and the symbols that have rules. Expressions are not read yet.
void collect_declarations(Parser& p);

/// Compiles the values of all attributes and gives each a slot. Attributes that need each other in a circle
/// are an error.
void compile_attributes(Parser& p);

}  // namespace seedmesh::building
