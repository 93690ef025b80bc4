#pragma once
/// The checks of a request that the schema cannot express. The rules are parsed here, too.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/job.h"
#include "core/generators/building/roof_store.h"
#include "core/generators/building/shape_grammar/shape_grammar.h"
#include "core/generators/building/shapes.h"
#include "core/generators/building/syntax.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// A value that a request gives to an attribute.
using AttributeValue = std::variant<double, std::string, bool>;

/// Rules that were read without an error, and the parameters that they depend on. Immutable except for the roofs;
/// requests with other sizes, attributes and seeds share it.
struct RuleSet {
  RuleText text;
  Grammar grammar;  ///< its texts are shared
  /// The parameters from which the rules were read: `rules`, `blueprint`, `start`, `restrict` with `weights`, and
  /// the names of `materials`.
  std::optional<std::variant<std::string, std::map<std::string, std::string>>> rules;
  std::string blueprint;
  std::optional<std::string> start;
  std::pair<int, int> restrictions;
  std::vector<std::string> materials;
  /// Roofs of all requests with these rules.
  std::unique_ptr<RoofStore> roofs = std::make_unique<RoofStore>();
};

/// Returns the rules of the request or of its blueprint; empty if it has a shape grammar. Adds an issue
/// unless exactly one file is the main file (rule_text.h).
RuleText rule_text_of(const BuildingParams& params, std::vector<Issue>& issues);

/// Returns the names of the files that fileSearch and fileRandom find.
std::vector<std::string> file_names(const BuildingParams& params);

/// Returns the value of an attribute as in expressions; true is 1, false is 0.
lang::TaggedValue value_of(Texts& texts, const AttributeValue& given);

/// Checks a value for an attribute of the rules. `base` is the pointer of the object of values. Texts of
/// values are added to `texts`, which begin with those of the grammar.
void check_attribute_value(const Grammar& grammar, Texts& texts,
                           const std::pair<const std::string, AttributeValue>& given, const std::string& base,
                           std::vector<Issue>& issues);

/// Returns a warning if nothing is drawn and no NIL removed shapes.
std::optional<Warning> nothing_drawn(const Shapes& shapes);

/// The limits of the request, and the job whose deadline check_all() keeps.
struct Bounds {
  const Limits& limits;
  const Job* job = nullptr;  ///< checked for stop and deadline; may be null
};

/// Returns all errors. Sets `rules`, or `figures` if the request has a shape grammar. If `rules` is not
/// null, it must be the rules of the parameters (has_rules_of), and they are not read again. `rules` becomes
/// null if the rules have errors.
std::vector<Issue> check_all(const BuildingParams& params, const Bounds& bounds,
                             std::shared_ptr<const RuleSet>& rules, FigureGrammar& figures);

/// Whether `params` would give the same rules, so that these need not be read again.
bool has_rules_of(const RuleSet& rules, const BuildingParams& params);

}  // namespace seedmesh::building
