#include "core/generators/building/check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/json_pointer.h"
#include "core/generators/building/blueprints/blueprints.h"
#include "core/generators/building/check_grammar.h"
#include "core/generators/building/edits.h"
#include "core/generators/building/footprint.h"
#include "core/generators/building/materials.h"
#include "core/generators/building/restricted_grammar.h"
#include "core/generators/building/shapes.h"
#include "core/gltf/read/read.h"
#include "core/lang/text_positions.h"
#include "core/schema/nearest.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_named = 20;

/// A text in quotes, or a number.
std::string text_of(const lang::TaggedValue& value, const Texts& texts) {
  return value.is_text() ? Json(*texts.find(value.text)).dump() : number_text(value.number);
}

/// "a", "b" or 3: what @Enum allows.
std::string choices_of(const Attribute& attribute, const Texts& texts) {
  std::string out;
  const std::size_t count = std::min(attribute.choices.size(), most_named);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out += i + 1 == attribute.choices.size() ? " or " : ", ";
    out += text_of(attribute.choices[i], texts);
  }
  return count < attribute.choices.size() ? out + ", ..." : out;
}

/// A hint for an unknown attribute: the most similar one, or all of them.
std::string help_with(const std::string& name, const Grammar& grammar) {
  std::vector<std::string_view> known;
  for (const Attribute& each : grammar.attributes) {
    if (!each.is_constant) known.push_back(each.name);
  }
  if (known.empty()) return "; they declare none";
  const std::string_view nearest = schema::nearest_word(name, known);
  if (!nearest.empty()) return "; did you mean \"" + std::string(nearest) + "\"?";
  std::string list;
  for (std::size_t i = 0; i < std::min(known.size(), most_named); ++i)
    list.append(list.empty() ? "" : ", ").append(known[i]);
  return "; they declare " + list + (known.size() > most_named ? ", ..." : "");
}

void check_attribute(const Attribute& attribute, const std::string& pointer, const lang::TaggedValue& value,
                     const Texts& texts, std::vector<Issue>& issues) {
  const std::string found = "found " + text_of(value, texts);
  if (attribute.is_constant) {
    issues.emplace_back(IssueKind::not_available, pointer,
                        "the rules declare this name as a constant, which a request cannot set");
    return;
  }
  if (attribute.has_range && attribute.is_restricted &&
      (value.is_text() || value.number < attribute.low || value.number > attribute.high)) {
    issues.emplace_back(IssueKind::out_of_range, pointer,
                        found + ", expected a number from " + number_text(attribute.low) + " to " +
                            number_text(attribute.high));
  }
  if (!attribute.choices.empty() && attribute.is_restricted &&
      std::ranges::find(attribute.choices, value) == attribute.choices.end()) {
    issues.emplace_back(IssueKind::invalid_value, pointer,
                        found + ", expected " + choices_of(attribute, texts));
  }
}

/// Every name is a valid material, so that names one letter away from a known one get a warning.
void warn_of_materials(Grammar& grammar, const BuildingParams& params, const RuleText& rules) {
  constexpr std::uint32_t one_letter = 2;  // as lang::name_distance counts
  std::vector<std::string_view> known = built_in_materials();
  for (const auto& entry : params.materials) known.emplace_back(entry.first);
  constexpr std::size_t most_checked = 1'000;  // names
  std::set<std::string_view> checked;
  for (const Step& step : grammar.steps) {
    if (checked.size() == most_checked) break;
    if (step.op != Op::material || step.argument_count == 0) continue;
    const Value& value = grammar.arguments[step.first_argument].value;
    const std::string* const name =
        value.expression.is_constant ? grammar.texts.find(value.expression.text) : nullptr;
    if (name == nullptr || name->size() < 3 || !checked.insert(*name).second) continue;
    if (std::ranges::find(known, *name) != known.end()) continue;
    const auto like = std::ranges::find_if(
        known, [&](std::string_view each) { return lang::name_distance(*name, each) <= one_letter; });
    if (like == known.end()) continue;
    const Issue place = issue_at(IssueKind::syntax, rules, step.offset, "");
    grammar.warnings.push_back({place.pointer,
                                "there is no material " + lang::in_quotes(*name) +
                                    "; the shape gets a plain material of this name; did you mean " +
                                    lang::in_quotes(*like) + "?",
                                place.line, place.column});
  }
}

/// Adds what a parameter at `pointer` refuses in the rules. The rules of a blueprint are not in the request, so their first
/// error is reported at the parameter.
void add_refused(const BuildingParams& params, const RuleText& rules, const char* pointer,
                 const std::vector<lang::TextError>& errors, std::vector<Issue>& issues) {
  for (const lang::TextError& error : errors) {
    if (params.rules) {
      issues.push_back(issue_at(error.kind, rules, error.offset, error.message));
      continue;
    }
    issues.emplace_back(IssueKind::invalid_value, pointer,
                        "the rules of the blueprint do not satisfy this restriction: " + error.message +
                            " (line " + std::to_string(text_position(rules.text, error.offset).line) +
                            " of them)");
    return;
  }
}

/// Adds errors and warnings about the start symbol of rules without syntax errors.
void check_start(const BuildingParams& params, const RuleText& rules, Grammar& grammar,
                 std::vector<Issue>& issues) {
  if (grammar.start == none) {
    issues.emplace_back(IssueKind::unknown_name, "/start",
                        "there is no symbol \"" + params.start.value_or("") + "\" in the rules");
    return;
  }
  const Symbol& start = grammar.symbols[grammar.start];
  // A rule file without rules makes the first shape alone.
  if (start.rules.empty() && (!grammar.rules.empty() || params.start)) {
    issues.emplace_back(IssueKind::unknown_name, "/start",
                        "there is no rule for the symbol \"" + start.name + "\"");
    return;
  }
  const std::uint32_t least = least_parameters(grammar, grammar.start);
  const auto warn = [&](const char* message) {
    const Issue place = issue_at(IssueKind::syntax, rules, grammar.rules[start.rules.front()].offset, "");
    grammar.warnings.push_back(
        {place.pointer, lang::in_quotes(start.name) + message, place.line, place.column});
  };
  if (least == 1) {
    warn(" has a parameter, for which the first shape has no value; its height is used");
  } else if (least > 1 && grammar.is_cityengine) {
    warn(" has parameters, for which the first shape has no values; they are 0");
  } else if (least > 1) {
    issues.emplace_back(
        IssueKind::invalid_value, params.start ? "/start" : "/rules",
        "the rules of \"" + start.name +
            "\" have parameters, for which the first shape has no values; begin with a rule that gives them");
  }
}

std::vector<std::string> material_names(const BuildingParams& params) {
  std::vector<std::string> names;
  for (const auto& entry : params.materials) names.push_back(entry.first);
  return names;
}

std::string blueprint_of(const BuildingParams& params) {
  return params.blueprint ? std::string(text_of(*params.blueprint)) : std::string();
}

std::pair<int, int> restrictions_of(const BuildingParams& params) {
  return {static_cast<int>(params.restrict), static_cast<int>(params.weights)};
}

/// Reads the rules and adds the issues of rules and start. Null if the rules have syntax errors.
std::shared_ptr<const RuleSet> read(const BuildingParams& params, std::vector<Issue>& issues) {
  std::vector<lang::TextError> errors;
  if (params.rules && params.blueprint) {
    issues.emplace_back(conflict_with({"rules"}), "/blueprint",
                        "found rules and a blueprint, expected one of them");
  }
  const std::size_t before = issues.size();
  auto set = std::make_shared<RuleSet>();
  set->text = rule_text_of(params, issues);
  if (issues.size() > before) return nullptr;
  const RuleText& rules = set->text;
  Grammar& grammar = set->grammar;
  grammar = read_rules(rules, params.start.value_or(""), errors);
  if (errors.size() == 1 || rules.parts.size() > 1) {
    for (const lang::TextError& error : errors)
      issues.push_back(issue_at(error.kind, rules, error.offset, error.message));
  } else if (!errors.empty()) {
    std::vector<lang::TextError> all = errors;
    lang::add_issues("/rules", rules.text, all, issues);
  }
  const bool has_text_restriction =
      params.restrict == BuildingRestrict::non_erasing || params.restrict == BuildingRestrict::unimarker;
  if (errors.empty() && has_text_restriction) {
    add_refused(params, rules, "/restrict",
                errors_of_restriction(grammar, params.restrict == BuildingRestrict::unimarker), issues);
  }
  if (errors.empty() && params.weights == BuildingWeights::strict)
    add_refused(params, rules, "/weights", errors_of_weights(grammar), issues);
  if (!errors.empty()) return nullptr;
  if (params.rules) warn_of_materials(grammar, params, rules);
  check_start(params, rules, grammar, issues);
  grammar.texts.share();
  set->rules = params.rules;
  set->blueprint = blueprint_of(params);
  set->start = params.start;
  set->restrictions = restrictions_of(params);
  set->materials = material_names(params);
  return set;
}

/// Adds the issues of values for rules.
void check_values(const BuildingParams& params, const Grammar& grammar, std::vector<Issue>& issues) {
  Texts texts = grammar.texts;
  for (const auto& given : params.attributes)
    check_attribute_value(grammar, texts, given, "/attributes", issues);
  if (grammar.start != none) check_edits(params, grammar, issues);
}

/// Rejects parameters of rules and lots in requests with a shape grammar, which has its own initial shape.
void check_alone(const BuildingParams& params, std::vector<Issue>& issues) {
  const BuildingParams plain;
  const auto refuse = [&](bool is_given, const char* name) {
    if (is_given) {
      issues.emplace_back(conflict_with({"shape_grammar"}), std::string("/") + name,
                          "has no meaning for a shape grammar, which begins with its initial shape");
    }
  };
  refuse(params.rules.has_value(), "rules");
  refuse(params.blueprint.has_value(), "blueprint");
  refuse(params.start.has_value(), "start");
  refuse(params.size != plain.size, "size");
  refuse(!params.footprint.empty(), "footprint");
  refuse(!params.attributes.empty(), "attributes");
  refuse(!params.edits.empty(), "edits");
  refuse(params.repeat.has_value(), "repeat");
  refuse(!params.assets.empty(), "assets");
  refuse(params.weights != plain.weights, "weights");
  refuse(!params.tables.empty(), "tables");
  refuse(params.derivation.order != plain.derivation.order, "derivation/order");
  if (params.restrict == BuildingRestrict::split) {
    issues.emplace_back(
        conflict_with({"shape_grammar"}), "/restrict",
        "found split, which restricts rules; expected none, non_erasing or unimarker for a shape grammar");
  }
}

FigureRestriction restriction_of(BuildingRestrict restrict) {
  return restrict == BuildingRestrict::unimarker     ? FigureRestriction::unimarker
         : restrict == BuildingRestrict::non_erasing ? FigureRestriction::non_erasing
                                                     : FigureRestriction::any;
}

}  // namespace

RuleText rule_text_of(const BuildingParams& params, std::vector<Issue>& issues) {
  if (!params.rules) {
    return rule_text(params.blueprint ? blueprint_named(text_of(*params.blueprint))->rules
                                      : std::string_view());
  }
  if (const auto* const text = std::get_if<std::string>(&*params.rules)) return rule_text(*text);
  const auto& files = std::get<std::map<std::string, std::string>>(*params.rules);
  if (files.empty()) {
    issues.emplace_back(missing_for({"rules"}), "/rules", "found no rule file, expected at least one");
    return rule_text("");
  }
  std::string_view start = params.start ? std::string_view(*params.start) : std::string_view();
  start.remove_prefix(std::min(start.find('$') + 1, start.size()));
  return rule_text(files, start, issues);
}

bool has_rules_of(const RuleSet& rules, const BuildingParams& params) {
  return rules.blueprint == blueprint_of(params) && rules.start == params.start &&
         rules.restrictions == restrictions_of(params) && rules.rules == params.rules &&
         rules.materials == material_names(params);
}

std::vector<std::string> file_names(const BuildingParams& params) {
  std::set<std::string> names;
  for (const auto& entry : params.assets) names.insert(entry.first);
  for (const auto& entry : params.materials) names.insert(entry.first);
  for (const auto& entry : params.tables) names.insert(entry.first);
  return {names.begin(), names.end()};
}

lang::TaggedValue value_of(Texts& texts, const AttributeValue& given) {
  if (const auto* text = std::get_if<std::string>(&given)) return {0, texts.id_of(*text)};
  if (const auto* flag = std::get_if<bool>(&given)) return {*flag ? 1.0 : 0.0, 0};
  return {std::get<double>(given), 0};
}

void check_attribute_value(const Grammar& grammar, Texts& texts,
                           const std::pair<const std::string, AttributeValue>& given, const std::string& base,
                           std::vector<Issue>& issues) {
  const std::string& name = given.first;
  const auto found = std::ranges::find(grammar.attributes, name, &Attribute::name);
  if (found == grammar.attributes.end()) {
    issues.emplace_back(IssueKind::unknown_name, base + pointer_token(name),
                        "the rules declare no attribute of this name" + help_with(name, grammar));
    return;
  }
  check_attribute(*found, base + pointer_token(name), value_of(texts, given.second), texts, issues);
}

std::optional<Warning> nothing_drawn(const Shapes& shapes) {
  std::size_t count = 0;
  for (const Shape& shape : shapes.shapes) {
    if (!shape.is_active) continue;
    if (dimension(shape.size) >= 2) return std::nullopt;
    ++count;
  }
  if (count == 0 && shapes.has_removed_shape) return std::nullopt;
  return Warning{"/rules",
                 count == 0 ? "nothing is drawn: no shape is left, because no selector or cell matched any"
                            : "nothing is drawn: " + std::to_string(count) +
                                  (count == 1 ? " shape is" : " shapes are") +
                                  " left, but edges and points have no area",
                 0, 0};
}

std::vector<Issue> check_all(const BuildingParams& params, const Bounds& bounds,
                             std::shared_ptr<const RuleSet>& rules, FigureGrammar& figures) {
  std::vector<Issue> issues;
  if (params.shape_grammar) {
    check_alone(params, issues);
    figures = read_figures(*params.shape_grammar, restriction_of(params.restrict), issues);
  } else if (!params.rules && !params.blueprint) {
    issues.emplace_back(missing_for({"rules", "blueprint", "shape_grammar"}), "",
                        "found none of \"rules\", \"blueprint\" and \"shape_grammar\", expected one of them");
  } else {
    if (!rules) rules = read(params, issues);
    if (rules) check_values(params, rules->grammar, issues);
  }
  if (!params.footprint.empty()) {
    const std::vector<Issue> more = check_footprint(params.footprint, bounds.job);
    issues.insert(issues.end(), more.begin(), more.end());
  } else if (dimension({params.size[0], params.size[1], params.size[2]}) < 2) {
    issues.emplace_back(IssueKind::out_of_range, "/size",
                        "found fewer than two sizes above 0, expected at least two");
  } else if (params.blueprint && !(params.size[0] > 0 && params.size[2] > 0)) {
    issues.emplace_back(IssueKind::out_of_range, "/size",
                        "a blueprint stands on the ground: expected sizes above 0 in x and z");
  }
  if (params.iterations && static_cast<std::uint32_t>(*params.iterations) > bounds.limits.iterations) {
    issues.push_back(iterations_issue(static_cast<std::uint64_t>(*params.iterations), bounds.limits));
  }
  for (const auto& [name, asset] : params.assets) {
    if (asset.model.has_value() == asset.glb.has_value()) {
      issues.emplace_back(conflict_with({"model", "glb"}), "/assets/" + name,
                          std::string("found ") + (asset.model ? "both" : "neither") +
                              " of \"model\" and \"glb\", expected one of them");
    } else if (asset.glb && !is_glb_uri(*asset.glb)) {
      issues.emplace_back(IssueKind::invalid_value, "/assets/" + name + "/glb",
                          "expected a GLB as \"data:model/gltf-binary;base64,…\"");
    }
  }
  check_materials(params, issues);
  return issues;
}

}  // namespace seedmesh::building
