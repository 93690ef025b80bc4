#include "core/import/houdini_rules.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

/// The first `mark` of a line outside of parentheses; line.to if there is none.
std::size_t outside(std::string_view text, char mark, Line line) {
  int depth = 0;
  for (std::size_t i = line.from; i < line.to; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth == 0 && text[i] == mark) return i;
  }
  return line.to;
}

/// Whether the line has a condition before `to`: <= and >= occur only there.
bool has_condition(std::string_view text, Line line, std::size_t to) {
  return text.substr(0, to).find(':', line.from) != std::string_view::npos;
}

/// Calls use(name) for each name of a text.
template <class Use>
void each_name(std::string_view text, Use&& use) {
  for (std::size_t from = 0; from < text.size();) {
    std::size_t to = from;
    while (to < text.size() && (is_letter(text[to]) || is_digit(text[to]) || text[to] == '_')) ++to;
    if (to > from) use(text.substr(from, to - from));
    from = std::max(to, from + 1);
  }
}

std::string_view part_of(std::string_view text, Line line) {
  return text.substr(line.from, line.to - line.from);
}

bool is_coordinate(std::string_view name) { return name == "x" || name == "y" || name == "z"; }

bool names_coordinate(std::string_view text) {
  bool found = false;
  each_name(text, [&](std::string_view name) { found = found || is_coordinate(name); });
  return found;
}

/// The same in the arguments of modules; a module itself may be called x.
bool arguments_name_coordinate(std::string_view word) {
  bool found = false;
  for (std::size_t open = word.find('('); open != std::string_view::npos; open = word.find('(', open)) {
    int depth = 0;
    const std::size_t from = open;
    for (; open < word.size(); ++open) {
      if (word[open] == '(') ++depth;
      if (word[open] == ')' && --depth == 0) break;
    }
    found = found || names_coordinate(word.substr(from, open - from));
  }
  return found;
}

std::size_t parameter_count(std::string_view center) {
  const std::size_t open = center.find('(');
  if (open == std::string_view::npos) return 0;
  return 1 + static_cast<std::size_t>(std::ranges::count(center, ','));
}

}  // namespace

std::size_t houdini_equals(std::string_view text, Line line) {
  int depth = 0;
  for (std::size_t i = line.from; i < line.to; ++i) {
    const char c = text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c != '=' || depth > 0) continue;
    const char before = i > line.from ? text[i - 1] : ' ', after = i + 1 < line.to ? text[i + 1] : ' ';
    if (after == '=') {
      ++i;
    } else if (before != '!' && !((before == '<' || before == '>') && has_condition(text, line, i))) {
      return i;
    }
  }
  return line.to;
}

HoudiniRule houdini_rule(std::string_view text, Line line) {
  HoudiniRule rule;
  rule.equals = houdini_equals(text, line);
  if (rule.equals == line.to) return rule;
  const std::size_t colon = outside(text, ':', {line.from, rule.equals});
  rule.head = {line.from, colon};
  rule.condition = colon < rule.equals ? trimmed(text, {colon + 1, rule.equals}) : Line{colon, colon};
  const std::size_t less = outside(text, '<', rule.head), greater = outside(text, '>', rule.head);
  rule.has_left = less < rule.head.to;
  rule.has_right = greater < rule.head.to;
  rule.left = rule.has_left ? Line{line.from, less} : Line{line.from, line.from};
  const std::size_t from = rule.has_left ? less + 1 : line.from;
  rule.center = {from, std::max(greater, from)};
  rule.right = rule.has_right ? Line{greater + 1, colon} : Line{colon, colon};
  const std::size_t weight = outside(text, ':', {rule.equals + 1, line.to});
  rule.successor = {rule.equals + 1, weight};
  rule.weight = weight < line.to ? trimmed(text, {weight + 1, line.to}) : Line{line.to, line.to};
  return rule;
}

HoudiniPositions::HoudiniPositions(std::string_view text, const std::vector<Line>& rules) {
  std::vector<HoudiniRule> all;
  for (const Line& line : rules) {
    all.push_back(houdini_rule(text, line));
    if (all.back().equals == line.to || all.back().has_left || all.back().has_right) return;
  }
  for (const HoudiniRule& rule : all) {
    const std::string_view center = part_of(text, trimmed(text, rule.center));
    const bool is_plain = !center.empty() && (is_letter(center[0]) || is_digit(center[0]));
    // Parameters that are called x, y or z hide the position.
    const bool hides = names_coordinate(center.substr(std::min(center.find('('), center.size())));
    if (is_plain && !hides &&
        (names_coordinate(part_of(text, rule.condition)) ||
         arguments_name_coordinate(part_of(text, rule.successor))))
      counts_[center[0]];
  }
  std::set<std::pair<char, std::size_t>> always;  // replaced in every step
  for (const HoudiniRule& rule : all) {
    const std::string_view center = part_of(text, trimmed(text, rule.center));
    if (center.empty() || !has(center[0])) continue;
    const std::size_t count = parameter_count(center);
    counts_[center[0]].insert(count);
    if (rule.condition.from == rule.condition.to && rule.weight.from == rule.weight.to)
      always.emplace(center[0], count);
  }
  for (const auto& [symbol, count] : always) counts_[symbol].erase(count);
}

bool HoudiniPositions::reads(std::string_view text, const HoudiniRule& rule) const {
  const std::string_view center = part_of(text, trimmed(text, rule.center));
  return !center.empty() && has(center[0]) &&
         !names_coordinate(center.substr(std::min(center.find('('), center.size()))) &&
         (names_coordinate(part_of(text, rule.condition)) ||
          arguments_name_coordinate(part_of(text, rule.successor)));
}

void HoudiniPositions::put(Json& parameters) const {
  if (counts_.empty()) return;
  parameters["rule_order"] = "listed";
  for (const auto& [symbol, counts] : counts_) {
    for (const std::size_t count : counts) {
      std::string module(1, symbol);
      for (std::size_t i = 0; i < count; ++i)
        module.append(i == 0 ? "(p" : ",p").append(std::to_string(i)).append(i + 1 == count ? ")" : "");
      parameters["productions"].push_back(module + " -> ?P(0,0,0)" + module);
    }
  }
  parameters["productions"].push_back("?P(x,y,z) -> *");
}

}  // namespace seedmesh
