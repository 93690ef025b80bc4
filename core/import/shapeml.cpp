/// Reads grammars of ShapeML (Lienhard, "Shape Modeling Language", 2019; its reference names the operations):
///
///   param height = 10;   const color_a = "#dddddd";   func twice(x) = 2 * x;
///   rule House :: height > 3 = { extrude(height) splitFace("top", { Roof }, "vertical", { Wall_ }) };
///
/// The result is a building with the same rules in the notation of CityEngine. Rules of one name become cases, their weights
/// percentages. Symbols that end in `_` are leaves.
#include <algorithm>

#include "core/import/cpfg_include.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/shapeml_names.h"
#include "core/import/shapeml_reader.h"

namespace seedmesh {

using lang::Token;
using lang::TokenKind;

Imported ShapemlReader::read() {
  for (std::size_t i = 0; i + 1 < tokens_.size();) i = statement(i);
  for (const std::string& name : order_) write_rule(name);
  TracedText all;
  for (const ShapemlFunction& each : shapeml_functions()) {
    if (needed_.contains(each.name)) all.write(std::string(each.declaration) + "\n", 0);
  }
  for (const std::string& name : attributes_) all.write("attr " + name + " = 0\n", 0);
  all.copy(declarations_, 0, declarations_.size());
  all.copy(rules_, 0, rules_.size());
  all.copy(repeated_, 0, repeated_.size());
  for (const std::string& leaf : leaves_)
    all.write(leaf + "visible --> case own_hidden == 1: NIL else: " + leaf + ".\n", 0);
  if (order_.empty() && source_.error_count() == 0) source_.report(0, "found no rule, expected at least one");
  Imported out;
  out.request["generator"] = "building";
  out.request["parameters"]["rules"] = all.text();
  out.request["parameters"]["size"] = {1, 0, 1};
  out.origins.push_back({"/parameters/rules", all.runs()});
  return out;
}

std::size_t ShapemlReader::statement(std::size_t i) {
  const std::string_view word = at(i).text;
  const std::size_t end = find(i, ";");
  if (is(i, ";")) return i + 1;
  if (is(i, "#")) {
    source_.report(at(i).offset, "the file of this `#include` is not given; send it as one of `files`",
                   IssueKind::not_available);
    return i + 3;
  }
  if (word == "param" || word == "const" || word == "func") {
    const std::size_t equals = find(i, "=");
    if (equals >= end || !is_name(i + 1)) {
      error(i, "found " + in_quotes(at(i)) + ", expected a name, `=` and a value");
    } else if (is(equals + 1, "{")) {
      error(equals + 1, "a value in braces has no counterpart in rules");
    } else {
      if (word != "func") declarations_.write(word == "param" ? "attr " : "const ", at(i).offset);
      for (std::size_t k = i + 1; k < equals; ++k) declarations_.write(std::string(at(k).text), at(k).offset);
      declarations_.write(" = ", at(equals).offset);
      expression(equals + 1, end, declarations_);
      declarations_.write("\n", at(end).offset);
    }
    return end + 1;
  }
  if (word == "rule") {
    head(i, end);
    return end + 1;
  }
  error(i, "found " + in_quotes(at(i)) + ", expected param, const, func or rule");
  return end + 1;
}

void ShapemlReader::head(std::size_t i, std::size_t end) {
  ShapemlRule rule;
  rule.name = i + 1;
  std::size_t k = i + 2;
  if (!is_name(i + 1)) return error(i + 1, "found " + in_quotes(at(i + 1)) + ", expected the name of a rule");
  if (is(k, "(")) {
    rule.parameters = k;
    k = partner_[k] + 1;
  }
  const std::size_t equals = std::min(body_sign(k, end), end);
  while (is(k, ":") && k < equals) {
    const bool is_condition = is(k + 1, ":");
    const std::size_t from = k + (is_condition ? 2 : 1);
    std::size_t to = from;
    while (to < equals && !is(to, ":")) to = is(to, "(") ? partner_[to] + 1 : to + 1;
    (is_condition ? rule.condition : rule.weight) = from;
    (is_condition ? rule.condition_end : rule.weight_end) = to;
    k = to;
  }
  if (k != equals || !is(equals, "=") || !is(equals + 1, "{"))
    return error(k, "found " + in_quotes(at(k)) + ", expected `= {` and the operations of the rule");
  rule.body = equals + 2;
  rule.body_end = partner_[equals + 1];
  const std::string name(at(rule.name).text);
  if (!by_name_.contains(name)) order_.push_back(name);
  by_name_[name].push_back(rule);
}

std::size_t ShapemlReader::body_sign(std::size_t i, std::size_t end) const {
  for (; i < end; i = is(i, "(") ? partner_[i] + 1 : i + 1) {
    if (is(i, "=") && is(i + 1, "{")) return i;
  }
  return end;
}

void ShapemlReader::write_rule(const std::string& name) {
  const std::vector<ShapemlRule>& all = by_name_[name];
  parameters_.clear();
  rules_.write(name == "Axiom" ? "@StartRule @KeepScopes\n" : "", at(all[0].name).offset);
  rules_.write(name, at(all[0].name).offset);
  if (all[0].parameters != 0) {
    for (std::size_t k = all[0].parameters; k <= partner_[all[0].parameters]; ++k)
      rules_.write(is_type(k) ? "" : std::string(at(k).text), at(k).offset);
    for (const auto& [from, to] : arguments(all[0].parameters - 1))
      parameters_ += ", " + std::string(at(to - 1).text);
  }
  rules_.write(" -->", at(all[0].name).offset);
  std::vector<std::pair<std::string, std::vector<ShapemlRule>>> groups;
  std::vector<ShapemlRule> always;
  for (const ShapemlRule& rule : all) {
    std::string condition;
    for (std::size_t k = rule.condition; k < rule.condition_end; ++k)
      condition += std::string(at(k).text) + " ";
    if (rule.condition == 0) {
      always.push_back(rule);
      continue;
    }
    auto found =
        std::find_if(groups.begin(), groups.end(), [&](const auto& each) { return each.first == condition; });
    if (found == groups.end()) found = groups.insert(groups.end(), {condition, {}});
    found->second.push_back(rule);
  }
  for (const auto& group : groups) {
    rules_.write("\n  case ", at(group.second[0].condition).offset);
    expression(group.second[0].condition, group.second[0].condition_end, rules_);
    rules_.write(":", at(group.second[0].condition_end).offset);
    write_choices(group.second);
  }
  if (!groups.empty() && !always.empty()) rules_.write("\n  else:", at(always[0].name).offset);
  if (!always.empty()) write_choices(always);
  rules_.write("\n", at(all.back().body_end).offset);
}

bool ShapemlReader::is_type(std::size_t k) const {
  return is_name(k) && is_name(k + 1) &&
         (at(k).text == "float" || at(k).text == "int" || at(k).text == "string" || at(k).text == "bool");
}

void ShapemlReader::write_choices(const std::vector<ShapemlRule>& rules) {
  double sum = 0;
  for (const ShapemlRule& rule : rules) sum += weight_of(rule);
  for (std::size_t r = 0; r < rules.size(); ++r) {
    if (rules.size() > 1 && r + 1 < rules.size()) {
      std::string percent = std::to_string(100 * weight_of(rules[r]) / sum);
      rules_.write(" " + percent + "% :", at(rules[r].name).offset);
    } else if (rules.size() > 1) {
      rules_.write(" else :", at(rules[r].name).offset);
    }
    whole(rules[r].body, rules[r].body_end, 0);
  }
}

double ShapemlReader::weight_of(const ShapemlRule& rule) {
  if (rule.weight == 0) return 1;
  const Token& token = at(rule.weight);
  if (rule.weight_end == rule.weight + 1 && token.kind == TokenKind::number && token.number > 0)
    return token.number;
  error(rule.weight, "found " + in_quotes(token) + ", expected a number above 0 as a weight");
  return 1;
}

int marks_of_shapeml(std::string_view text) {
  int marks = 0;
  for (const std::string_view word :
       {"rule Axiom", "splitFace(", "splitRepeat", "splitX(", "splitY(", "param ", "Axiom = {"}) {
    if (text.find(word) != std::string_view::npos) marks += word.starts_with("rule") ? 4 : 1;
  }
  for (const Line& line : lines_of(text)) {
    const std::string_view words = text.substr(line.from, line.to - line.from);
    const bool has_value = words.find('=') != std::string_view::npos;
    if (words.starts_with("rule ") && has_value) marks += 3;
    if ((words.starts_with("param ") || words.starts_with("const ") || words.starts_with("func ")) &&
        has_value && words.find(';') != std::string_view::npos) {
      ++marks;
    }
  }
  return marks < 2 ? 0 : marks;
}

Result<Imported> import_shapeml(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of ShapeML contains one grammar"))
    return *std::move(error);
  const JoinedText joined = with_cpfg_includes(text, options.files);
  ForeignText source(joined.text, text, joined.parts);
  ShapemlReader reader(source);
  return source.finish(reader.read());
}

}  // namespace seedmesh
