#pragma once
/// Expands operations that are values in ShapeML: `func F(length) = { ... };` and `const up = { ... };`, which
/// `^F(2)` and `^up` use.
#include <set>
#include <string>
#include <vector>

#include "core/import/foreign_text.h"
#include "core/lang/lexer.h"

namespace seedmesh {

/// Replaces each use of a named operation by its tokens. Arguments replace parameters, in parentheses.
/// Definitions are removed. An argument `^name`, or one that names a constant of operations, is enclosed in
/// braces. A rule with operations as parameters is copied for each combination of arguments. Each copy has a
/// name of its own in `made_names`; tokens point into these names. Tokens keep their offsets. Errors: a wrong
/// number of arguments, more than 30 nested uses, more than 1,000 such rules, more than 1,000,000 tokens.
void expand_shapeml_operations(std::vector<lang::Token>& tokens, std::set<std::string>& made_names,
                               ForeignText& source);

}  // namespace seedmesh
