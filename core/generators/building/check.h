#pragma once
/// The checks of a request that the schema cannot express. They read the rules as well.
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

/// The rules of the request or of its blueprint; empty if it has a shape grammar. Adds an issue if the main file is not
/// clear.
RuleText rule_text_of(const BuildingParams& params, std::vector<Issue>& issues);

/// The value of an attribute as expressions see it; true is 1, false is 0.
lang::TaggedValue value_of(Texts& texts, const std::variant<double, std::string, bool>& given);

/// Checks a value for an attribute of the rules. `base` is the pointer of the object of values, with a slash at its end.
void check_attribute_value(const Grammar& grammar, const std::string& name, const lang::TaggedValue& value,
                           const std::string& base, std::vector<Issue>& issues);

/// A warning if nothing is drawn and no NIL removed shapes.
std::optional<Warning> nothing_drawn(const Shapes& shapes);

/// Within what check_all works.
struct Bounds {
  const Limits& limits;
  const Job* job = nullptr;  ///< checked for stop and deadline; may be null
};

/// All errors. Fills the grammar, or the pictures if the request has a shape grammar.
std::vector<Issue> check_all(const BuildingParams& params, const Bounds& bounds, Grammar& grammar,
                             PictureGrammar& pictures);

}  // namespace seedmesh::building
