#pragma once
/// What the schema of a building cannot say, and the rules read on the way.
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/job.h"
#include "core/generators/building/shape_grammar/shape_grammar.h"
#include "core/generators/building/shapes.h"
#include "core/generators/building/syntax.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// The rules of the request or of its blueprint; empty where there is a shape grammar.
std::string_view rules_of(const BuildingParams& params);

/// The value of an attribute as expressions see it.
double number_of(Texts& texts, const std::variant<double, std::string, bool>& given);

/// None, or that nothing is drawn though nothing was taken away by NIL.
std::optional<Warning> nothing_drawn(const Shapes& shapes);

/// All faults. Fills the grammar, or the pictures where there is a shape grammar.
std::vector<Issue> check_all(const BuildingParams& params, const Limits& limits, Grammar& grammar,
                             PictureGrammar& pictures);

}  // namespace seedmesh::building
