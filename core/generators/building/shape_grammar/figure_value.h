#pragma once

#include <string>
#include <vector>

#include "core/generators/building/shape_grammar/shape_grammar.h"

namespace seedmesh::building {

/// Returns the value of an expression of a figure, with the names in `values`. Returns 0 and adds errors at
/// `pointer`, at most 100 in all, if the text is wrong or contains a random function.
double figure_value(const std::string& text, const FigureValues& values, const std::string& pointer,
                    std::vector<Issue>& issues);

}  // namespace seedmesh::building
