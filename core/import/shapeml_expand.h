#pragma once
/// Operations as values in ShapeML: `func F(length) = { ... };` and `const up = { ... };`, which `^F(2)` and `^up` use.
#include <vector>

#include "core/import/foreign_text.h"
#include "core/lang/lexer.h"

namespace seedmesh {

/// Replaces each use of operations by their tokens, with the arguments in brackets in the place of the parameters, and removes
/// the definitions. An argument that is such a use, or the name of a rule behind `^`, gets braces. Tokens keep their
/// offsets. Errors: uses nested more than 30 deep, more than 1,000,000 tokens.
void expand_shapeml_operations(std::vector<lang::Token>& tokens, ForeignText& source);

}  // namespace seedmesh
