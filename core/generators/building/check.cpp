#include "core/generators/building/check.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/building/blueprints/blueprints.h"
#include "core/generators/building/ground.h"
#include "core/generators/building/kinds.h"
#include "core/generators/building/looks.h"
#include "core/generators/building/shapes.h"
#include "core/gltf/read.h"
#include "core/lang/text_places.h"
#include "core/schema/nearest.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

/// A text as a JSON Pointer token.
std::string escaped(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
  return out;
}

constexpr std::size_t most_named = 20;

/// "a", "b" and 3: what @Enum allows.
std::string choices_of(const Attribute& attribute, const Texts& texts) {
  std::string out;
  const std::size_t count = std::min(attribute.choices.size(), most_named);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out += i + 1 == attribute.choices.size() ? " or " : ", ";
    const std::string* const text = texts.of(attribute.choices[i]);
    out += text != nullptr ? Json(*text).dump() : number_text(attribute.choices[i]);
  }
  return count < attribute.choices.size() ? out + ", ..." : out;
}

/// Which attribute of the rules was meant, or which there are.
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

void check_attribute(const Attribute& attribute, const std::string& name, double number, const Texts& texts,
                     std::vector<Issue>& issues) {
  const std::string* const text = texts.of(number);
  const std::string found = "found " + (text != nullptr ? Json(*text).dump() : number_text(number));
  const std::string pointer = "/attributes/" + escaped(name);
  if (attribute.is_constant) {
    issues.push_back({pointer, "the rules declare this name as a constant, which no request sets"});
    return;
  }
  if (attribute.has_range && (text != nullptr || number < attribute.low || number > attribute.high)) {
    issues.push_back({pointer, found + ", expected a number from " + number_text(attribute.low) + " to " +
                                   number_text(attribute.high)});
  }
  if (!attribute.choices.empty() && std::ranges::find(attribute.choices, number) == attribute.choices.end())
    issues.push_back({pointer, found + ", expected " + choices_of(attribute, texts)});
}

/// A material is whatever its name says, so that a name one letter away from a known one gets a warning.
void warn_of_materials(Grammar& grammar, const BuildingParams& params, std::string_view rules) {
  constexpr std::uint32_t one_letter = 2;  // as lang::name_distance counts
  std::vector<std::string_view> known = built_in_materials();
  for (const auto& entry : params.materials) known.emplace_back(entry.first);
  constexpr std::size_t most_looked_at = 1'000;  // names; a hint is worth no more
  std::set<std::string_view> told;
  for (const Step& step : grammar.steps) {
    if (told.size() == most_looked_at) break;
    if (step.op != Op::material || step.argument_count == 0) continue;
    const Value& value = grammar.arguments[step.first_argument].value;
    const std::string* const name =
        value.expression.is_constant ? grammar.texts.of(value.expression.value) : nullptr;
    if (name == nullptr || name->size() < 3 || !told.insert(*name).second) continue;
    if (std::ranges::find(known, *name) != known.end()) continue;
    const auto like = std::ranges::find_if(
        known, [&](std::string_view each) { return lang::name_distance(*name, each) <= one_letter; });
    if (like == known.end()) continue;
    const TextPlace place = place_of(rules, step.offset);
    grammar.warnings.push_back({"/rules",
                                "there is no material " + lang::in_quotes(*name) +
                                    ", so that it is a new one; did you mean " + lang::in_quotes(*like) + "?",
                                place.line, place.column});
  }
}

/// The rules read, and all that is wrong with the parameters around them.
Grammar read(const BuildingParams& params, std::vector<Issue>& issues) {
  std::vector<lang::Fault> faults;
  if (params.rules && params.blueprint)
    issues.push_back({"/blueprint", "found rules and a blueprint, expected one of them"});
  const std::string_view rules = rules_of(params);
  Grammar grammar = read_rules(rules, params.start.value_or(""), faults);
  if (!faults.empty()) {
    std::vector<lang::Fault> told = faults;
    lang::add_issues("/rules", rules, told, issues);
  }
  if (faults.empty() && params.restrict != BuildingRestrict::none) {
    for (const lang::Fault& fault : faults_of_kind(grammar, params.restrict == BuildingRestrict::unimarker)) {
      if (params.rules) {
        issues.push_back(issue_at("/rules", rules, fault.offset, fault.message));
        continue;
      }
      issues.push_back({"/restrict", "the rules of the blueprint are not of this kind: " + fault.message +
                                         " (line " + std::to_string(place_of(rules, fault.offset).line) +
                                         " of them)"});
      break;
    }
  }
  if (faults.empty() && params.rules) warn_of_materials(grammar, params, rules);
  if (faults.empty() && grammar.start == none) {
    issues.push_back({"/start", "there is no symbol \"" + params.start.value_or("") + "\" in the rules"});
  } else if (faults.empty()) {
    const Symbol& start = grammar.symbols[grammar.start];
    if (start.rules.empty()) {
      issues.push_back({"/start", "there is no rule for the symbol \"" + start.name + "\""});
    } else if (const std::uint32_t least = least_parameters(grammar, grammar.start); least == 1) {
      const TextPlace place = place_of(rules, grammar.rules[start.rules.front()].offset);
      grammar.warnings.push_back(
          {"/rules",
           lang::in_quotes(start.name) +
               " has a parameter, which nothing gives the first shape: it is taken to be its height",
           place.line, place.column});
    } else if (least > 1) {
      issues.push_back(
          {params.start ? "/start" : "/rules",
           "the rules of \"" + start.name +
               "\" have parameters, which the first shape has not; begin with a rule that gives them"});
    }
  }
  for (const auto& [name, given] : params.attributes) {
    if (!faults.empty()) break;
    const auto found = std::ranges::find(grammar.attributes, name, &Attribute::name);
    const Attribute* const attribute = found == grammar.attributes.end() ? nullptr : &*found;
    if (attribute == nullptr) {
      issues.push_back({"/attributes/" + escaped(name),
                        "the rules declare no attribute of this name" + help_with(name, grammar)});
      continue;
    }
    check_attribute(*attribute, name, number_of(grammar.texts, given), grammar.texts, issues);
  }
  return grammar;
}

/// A shape grammar begins with a picture of its own: what tells of rules and lots has no meaning for it.
void check_alone(const BuildingParams& params, std::vector<Issue>& issues) {
  const BuildingParams plain;
  const auto refuse = [&](bool is_given, const char* name) {
    if (is_given)
      issues.push_back({std::string("/") + name,
                        "has no meaning for a shape grammar, which begins with its "
                        "initial shape"});
  };
  refuse(params.rules.has_value(), "rules");
  refuse(params.blueprint.has_value(), "blueprint");
  refuse(params.start.has_value(), "start");
  refuse(params.size != plain.size, "size");
  refuse(!params.footprint.empty(), "footprint");
  refuse(!params.attributes.empty(), "attributes");
  refuse(params.repeat.has_value(), "repeat");
  refuse(!params.assets.empty(), "assets");
  refuse(params.derivation.order != plain.derivation.order, "derivation/order");
}

PictureRestriction restriction_of(BuildingRestrict restrict) {
  return restrict == BuildingRestrict::unimarker     ? PictureRestriction::unimarker
         : restrict == BuildingRestrict::non_erasing ? PictureRestriction::non_erasing
                                                     : PictureRestriction::any;
}

}  // namespace

std::string_view rules_of(const BuildingParams& params) {
  if (params.rules) return *params.rules;
  return params.blueprint ? blueprint_named(text_of(*params.blueprint))->rules : std::string_view();
}

double number_of(Texts& texts, const std::variant<double, std::string, bool>& given) {
  if (const auto* text = std::get_if<std::string>(&given)) return texts.number_of(*text);
  if (const auto* flag = std::get_if<bool>(&given)) return *flag ? 1 : 0;
  return std::get<double>(given);
}

std::optional<Warning> nothing_drawn(const Shapes& shapes) {
  std::size_t count = 0;
  for (const Shape& shape : shapes.shapes) {
    if (!shape.is_active) continue;
    if (dimension(shape.size) >= 2) return std::nullopt;
    ++count;
  }
  if (count == 0 && shapes.takes_away) return std::nullopt;
  return Warning{"/rules",
                 count == 0 ? "nothing is drawn: no shape is left, as no selector or cell took anything"
                            : "nothing is drawn: " + std::to_string(count) +
                                  (count == 1 ? " shape is" : " shapes are") +
                                  " left, an edge or a point, which has no area",
                 0, 0};
}

std::vector<Issue> check_all(const BuildingParams& params, const Limits& limits, Grammar& grammar,
                             PictureGrammar& pictures) {
  std::vector<Issue> issues;
  if (params.shape_grammar) {
    check_alone(params, issues);
    pictures = read_pictures(*params.shape_grammar, restriction_of(params.restrict), issues);
  } else if (!params.rules && !params.blueprint) {
    issues.push_back(
        {"", "found none of \"rules\", \"blueprint\" and \"shape_grammar\", expected one of them"});
  } else {
    grammar = read(params, issues);
  }
  if (!params.footprint.empty()) {
    const std::vector<Issue> more = check_footprint(params.footprint);
    issues.insert(issues.end(), more.begin(), more.end());
  } else if (dimension({params.size[0], params.size[1], params.size[2]}) < 2) {
    issues.push_back({"/size", "at least two of the three sizes are above 0"});
  } else if (params.blueprint && !(params.size[0] > 0 && params.size[2] > 0)) {
    issues.push_back({"/size", "a blueprint stands on the ground: its sizes in x and z are above 0"});
  }
  if (params.iterations && static_cast<std::uint32_t>(*params.iterations) > limits.iterations) {
    issues.push_back({"/iterations", "found " + std::to_string(*params.iterations) + ", expected at most " +
                                         std::to_string(limits.iterations)});
  }
  for (const auto& [name, asset] : params.assets) {
    if (asset.model.has_value() == asset.glb.has_value())
      issues.push_back({"/assets/" + name, std::string("found ") + (asset.model ? "both" : "neither") +
                                               " of \"model\" and \"glb\", expected one of them"});
    else if (asset.glb && !is_glb_uri(*asset.glb))
      issues.push_back({"/assets/" + name + "/glb", "expected a GLB as \"data:model/gltf-binary;base64,…\""});
  }
  check_looks(params, issues);
  return issues;
}

}  // namespace seedmesh::building
