/// Reads grammars of ShapeML (Lienhard, "Shape Modeling Language", 2019; its reference names the operations):
///
///   param height = 10;   const color_a = "#dddddd";   func twice(x) = 2 * x;
///   rule House :: height > 3 = { extrude(height) splitFace("top", { Roof }, "vertical", { Wall_ }) };
///
/// The result is a building with the same rules in the notation of CityEngine. Rules of one name become cases, their weights
/// percentages. Symbols that end in `_` are leaves.
#include <algorithm>
#include <map>
#include <set>

#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/shapeml_names.h"
#include "core/import/shapeml_text.h"

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 100;  ///< nested braces

/// A rule: tokens of its head and of its body between the braces.
struct ShapemlRule {
  std::size_t name = 0, parameters = 0;  ///< tokens; parameters: of the bracket, or 0
  std::size_t weight = 0, weight_end = 0, condition = 0, condition_end = 0;
  std::size_t body = 0, body_end = 0;
};

class ShapemlReader : private ShapemlText {
 public:
  explicit ShapemlReader(ForeignText& source) : ShapemlText(source) {}

  Imported read() {
    for (std::size_t i = 0; i + 1 < tokens_.size();) i = statement(i);
    for (const std::string& name : order_) write_rule(name);
    TracedText all;
    for (const ShapemlFunction& each : shapeml_functions()) {
      if (needed_.contains(each.name)) all.write(std::string(each.declaration) + "\n", 0);
    }
    for (const std::string& name : attributes_) all.write("attr " + name + " = 0\n", 0);
    all.copy(declarations_, 0, declarations_.size());
    all.copy(rules_, 0, rules_.size());
    if (order_.empty() && source_.error_count() == 0)
      source_.report(0, "found no rule, expected at least one");
    Imported out;
    out.request["generator"] = "building";
    out.request["parameters"]["rules"] = all.text();
    out.request["parameters"]["size"] = {1, 0, 1};
    out.origins.push_back({"/parameters/rules", all.runs()});
    return out;
  }

 private:
  std::size_t statement(std::size_t i) {
    const std::string_view word = at(i).text;
    const std::size_t end = find(i, ";");
    if (is(i, ";")) return i + 1;
    if (is(i, "#")) {
      source_.warn(at(i).offset, "other files are not read: give one file with all rules");
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
        for (std::size_t k = i + 1; k < equals; ++k)
          declarations_.write(std::string(at(k).text), at(k).offset);
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

  /// rule Name(parameters) : weight :: condition = { body }
  void head(std::size_t i, std::size_t end) {
    ShapemlRule rule;
    rule.name = i + 1;
    std::size_t k = i + 2;
    if (!is_name(i + 1))
      return error(i + 1, "found " + in_quotes(at(i + 1)) + ", expected the name of a rule");
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

  /// The `=` before the braces of a rule.
  std::size_t body_sign(std::size_t i, std::size_t end) const {
    for (; i < end; i = is(i, "(") ? partner_[i] + 1 : i + 1) {
      if (is(i, "=") && is(i + 1, "{")) return i;
    }
    return end;
  }

  /// All rules of a name as cases, and those of one condition as percentages.
  void write_rule(const std::string& name) {
    const std::vector<ShapemlRule>& all = by_name_[name];
    rules_.write(name == "Axiom" ? "@StartRule @KeepScopes\n" : "", at(all[0].name).offset);
    rules_.write(name, at(all[0].name).offset);
    if (all[0].parameters != 0) {
      for (std::size_t k = all[0].parameters; k <= partner_[all[0].parameters]; ++k)
        rules_.write(is_type(k) ? "" : std::string(at(k).text), at(k).offset);
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
      auto found = std::find_if(groups.begin(), groups.end(),
                                [&](const auto& each) { return each.first == condition; });
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

  bool is_type(std::size_t k) const {
    return is_name(k) && is_name(k + 1) &&
           (at(k).text == "float" || at(k).text == "int" || at(k).text == "string" || at(k).text == "bool");
  }

  void write_choices(const std::vector<ShapemlRule>& rules) {
    double sum = 0;
    for (const ShapemlRule& rule : rules) sum += weight_of(rule);
    for (std::size_t r = 0; r < rules.size(); ++r) {
      if (rules.size() > 1 && r + 1 < rules.size()) {
        std::string percent = std::to_string(100 * weight_of(rules[r]) / sum);
        rules_.write(" " + percent + "% :", at(rules[r].name).offset);
      } else if (rules.size() > 1) {
        rules_.write(" else :", at(rules[r].name).offset);
      }
      operations(rules[r].body, rules[r].body_end, 0);
    }
  }

  double weight_of(const ShapemlRule& rule) {
    if (rule.weight == 0) return 1;
    const Token& token = at(rule.weight);
    if (rule.weight_end == rule.weight + 1 && token.kind == TokenKind::number && token.number > 0)
      return token.number;
    error(rule.weight, "found " + in_quotes(token) + ", expected a number above 0 as a weight");
    return 1;
  }

  void operations(std::size_t from, std::size_t to, int depth) {
    if (depth > deepest) return error(from, "braces are nested more than 100 deep");
    for (std::size_t i = from; i < to;) {
      const Token& token = at(i);
      const std::size_t behind = is(i + 1, "(") ? std::min(partner_[i + 1] + 1, to) : i + 1;
      if (is(i, "[") || is(i, "]")) {
        rules_.write(" " + std::string(token.text), token.offset);
        ++i;
      } else if (is(i, ";")) {
        ++i;
      } else if (token.kind != TokenKind::name) {
        error(i, "found " + in_quotes(token) + ", expected an operation or the name of a rule" +
                     (is(i, "^") ? "; no operations have this name" : ""));
        i = behind;
      } else {
        step(i, depth);
        i = behind;
      }
    }
  }

  void step(std::size_t i, int depth) {
    const std::string_view name = at(i).text;
    const auto given = arguments(i);
    if (name.starts_with("split")) return split(i, given, depth);
    if (name == "scale" || name == "scaleCenter") return scale(i, given);
    if (name == "set" && given.size() == 2) return set(i, given);
    const auto rows = shapeml_operations();
    const auto found = std::ranges::find(rows, name, &ShapemlOperation::name);
    if (found != rows.end()) {
      const int count = static_cast<int>(given.size());
      if (count < found->least || count > found->most) {
        return error(i, in_quotes(at(i)) + " has " + std::to_string(count) +
                            " arguments, for which there is no counterpart");
      }
      if (found->is_left_out) {
        if (warned_.insert(std::string(name)).second)
          source_.warn(at(i).offset, in_quotes(at(i)) + " has no counterpart and is left out");
        return;
      }
      return write_as(i, found->rules, given);
    }
    if (by_name_.contains(std::string(name)) || name.ends_with('_')) {
      rules_.write(" " + std::string(name) + (name.ends_with('_') ? "." : ""), at(i).offset);
      if (!given.empty() && !name.ends_with('_')) {
        rules_.write("(", at(i).offset);
        write_all(given);
        rules_.write(")", at(i).offset);
      }
      return;
    }
    error(i, in_quotes(at(i)) + " is no rule, and no operation with a counterpart");
  }

  void write_all(const std::vector<std::pair<std::size_t, std::size_t>>& given) {
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (k > 0) rules_.write(", ", at(given[k].first).offset);
      expression(given[k].first, given[k].second, rules_);
    }
  }

  /// Writes a row of the table with the arguments in the place of $1, $2 and $*.
  void write_as(std::size_t i, std::string_view rules,
                const std::vector<std::pair<std::size_t, std::size_t>>& given) {
    rules_.write(" ", at(i).offset);
    for (std::size_t k = 0; k < rules.size(); ++k) {
      if (rules[k] != '$') {
        rules_.write(rules.substr(k, 1), at(i).offset);
        continue;
      }
      ++k;
      if (rules[k] == '*') {
        write_all(given);
      } else if (const auto index = static_cast<std::size_t>(rules[k] - '1'); index < given.size()) {
        expression(given[index].first, given[index].second, rules_);
      }
    }
  }

  /// scale(f), scale(x, y, z) and the same about the centre
  void scale(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given) {
    if (given.size() != 1 && given.size() != 3)
      return error(i, in_quotes(at(i)) + " takes one or three factors");
    const auto three = [&](std::string_view before, std::string_view behind) {
      for (std::size_t k = 0; k < 3; ++k) {
        rules_.write(std::string(k > 0 ? ", " : "") + "'(" + std::string(before), at(i).offset);
        const auto& argument = given[given.size() == 1 ? 0 : k];
        expression(argument.first, argument.second, rules_);
        rules_.write(std::string(behind) + ")", at(i).offset);
      }
      rules_.write(")", at(i).offset);
    };
    if (at(i).text == "scaleCenter") {
      rules_.write(" t(", at(i).offset);
      three("0.5 - 0.5 * (", ")");
    }
    rules_.write(" s(", at(i).offset);
    three("", "");
  }

  /// set("name", value): an attribute of the rules
  void set(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given) {
    if (at(given[0].first).kind != TokenKind::string)
      return error(i, "set needs the name of an attribute in quotes");
    const std::string name = "own_" + lang::string_value(at(given[0].first));
    attributes_.insert(name);
    rules_.write(" set(" + name + ", ", at(i).offset);
    expression(given[1].first, given[1].second, rules_);
    rules_.write(")", at(i).offset);
  }

  void block(const std::pair<std::size_t, std::size_t>& given, int depth) {
    if (!is(given.first, "{"))
      return error(given.first, "found " + in_quotes(at(given.first)) + ", expected operations in braces");
    operations(given.first + 1, std::min(partner_[given.first], given.second), depth + 1);
  }

  void split(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth) {
    const std::string_view name = at(i).text;
    const std::size_t from = at(i).offset;
    const std::string axis = name.empty() ? "" : std::string(1, static_cast<char>(name.back() | 0x20));
    if (name == "splitFace" && given.size() >= 2 && given.size() % 2 == 0) {
      rules_.write(" comp(f) {", from);
      for (std::size_t k = 0; k + 1 < given.size(); k += 2) {
        rules_.write((k > 0 ? " | " : " ") + lang::string_value(at(given[k].first)) + " :",
                     at(given[k].first).offset);
        block(given[k + 1], depth);
      }
      rules_.write(" }", from);
    } else if (name == "splitFaceByIndex" && given.size() >= 2) {
      rules_.write(" comp(f) {", from);
      for (std::size_t k = 0; k + 1 < given.size(); ++k) {
        rules_.write((k > 0 ? " | " : " ") + std::string(at(given[k].first).text) + " :",
                     at(given[k].first).offset);
        block(given.back(), depth);
      }
      rules_.write(" }", from);
    } else if (name.starts_with("splitRepeat") && given.size() == 2) {
      rules_.write(" split(" + axis + ") { ~(", from);
      expression(given[0].first, given[0].second, rules_);
      rules_.write(") :", from);
      block(given[1], depth);
      rules_.write(" }*", from);
    } else if ((name == "splitX" || name == "splitY" || name == "splitZ") && given.size() >= 3 &&
               given.size() % 2 == 1 && at(given[0].first).kind == TokenKind::string) {
      pattern(i, lang::string_value(at(given[0].first)), given, depth);
    } else {
      error(i, in_quotes(at(i)) + " with these arguments has no counterpart");
    }
  }

  /// splitX("s(f)s", size, { ... }, ...): f is a fixed size, s one that stretches, and brackets repeat.
  void pattern(std::size_t i, const std::string& signs,
               const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth) {
    rules_.write(" split(" + std::string(1, static_cast<char>(at(i).text.back() | 0x20)) + ") {",
                 at(i).offset);
    std::size_t next = 1;
    bool needs_bar = false;
    for (const char sign : signs) {
      if (sign == '(') {
        rules_.write(needs_bar ? " | {" : " {", at(i).offset);
        needs_bar = false;
      } else if (sign == ')') {
        rules_.write(" }*", at(i).offset);
        needs_bar = true;
      } else if ((sign == 'f' || sign == 's') && next + 1 < given.size()) {
        rules_.write(std::string(needs_bar ? " | " : " ") + (sign == 's' ? "~(" : "("), at(i).offset);
        expression(given[next].first, given[next].second, rules_);
        rules_.write(") :", at(i).offset);
        block(given[next + 1], depth);
        next += 2;
        needs_bar = true;
      } else {
        return error(i, "the pattern of " + in_quotes(at(i)) + " does not fit its sizes and operations");
      }
    }
    if (next != given.size())
      error(i, "the pattern of " + in_quotes(at(i)) + " does not fit its sizes and operations");
    rules_.write(" }", at(i).offset);
  }

  TracedText rules_;
  std::map<std::string, std::vector<ShapemlRule>> by_name_;
  std::vector<std::string> order_;
  std::set<std::string, std::less<>> warned_;
};

}  // namespace

int marks_of_shapeml(std::string_view text) {
  int marks = 0;
  for (const std::string_view word :
       {"rule Axiom", "splitFace(", "splitRepeat", "splitX(", "splitY(", "param ", "Axiom = {"}) {
    if (text.find(word) != std::string_view::npos) marks += word.starts_with("rule") ? 4 : 1;
  }
  return marks < 2 ? 0 : marks;
}

Result<Imported> import_shapeml(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of ShapeML contains one grammar"))
    return *std::move(error);
  ForeignText source(text);
  ShapemlReader reader(source);
  return source.finish(reader.read());
}

}  // namespace seedmesh
