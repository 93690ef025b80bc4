#include "core/import/houdini_names.h"

#include <algorithm>

#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

bool is_name(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

/// Calls use(word, offset) for each name and each other byte.
template <class Use>
void each_word(std::string_view text, Use&& use) {
  for (std::size_t from = 0; from < text.size();) {
    std::size_t to = from;
    while (to < text.size() && is_name(text[to])) ++to;
    to = std::max(to, from + 1);
    use(std::string(text.substr(from, to - from)), from);
    from = to;
  }
}

}  // namespace

bool HoudiniNames::is_formal(std::string_view name) const {
  bool found = has_position_ && (name == "x" || name == "y" || name == "z");
  int depth = 0;
  each_word(formal_, [&](const std::string& word, std::size_t) {
    if (word == "(") ++depth;
    if (word == ")") --depth;
    found = found || (depth > 0 && word == name);
  });
  return found;
}

void HoudiniNames::note(std::string_view text, std::size_t at) {
  each_word(text, [&](const std::string& word, std::size_t from) {
    if (is_letter(word[0]) && !is_formal(word)) names_.emplace(word, at + from);
  });
}

std::string HoudiniNames::with_index(const std::string& arguments, std::size_t index) const {
  std::string out;
  each_word(arguments, [&](const std::string& word, std::size_t) {
    out += word == "i" && !is_formal(word) ? std::to_string(index) : word;
  });
  return out;
}

void HoudiniNames::put(double gravity, Json& parameters, ForeignText& source) const {
  if (names_.contains("t")) {
    parameters["variables"]["t"] = 0;
    parameters["end_each"] = "t = t + 1;";
  }
  if (names_.contains("T")) parameters["constants"]["T"] = gravity;
  for (const char* each : {"i", "J", "K", "M", "x", "y", "z", "A", "W", "L", "U", "V", "g"}) {
    const auto found = names_.find(each);
    if (found == names_.end()) continue;
    source.warn(found->second,
                lang::in_quotes(found->first) + " is a variable of the node without a counterpart; it is 0");
    parameters["constants"][each] = 0;
  }
  if (const auto found = names_.find("in"); found != names_.end()) {
    source.warn(found->second,
                "`in()` tests whether a point is in a geometry, which does not exist here; it is 0");
    parameters["functions"] = {"in(x, y, z) = 0"};
  }
}

void HoudiniArities::note(char symbol, const std::string& arguments) {
  std::size_t count = arguments.empty() ? 0 : 1;
  int depth = 0;
  for (const char each : arguments) {
    if (each == '(') ++depth;
    if (each == ')') --depth;
    if (each == ',' && depth == 1) ++count;
  }
  arities_.insert({symbol, count});
}

Json HoudiniArities::interpretation() const {
  Json rules = Json::array();
  constexpr const char* parameters[] = {"", "(l)", "(l,w)", "(l,w,s)", "(l,w,s,d)"};
  for (const auto& [symbol, count] : arities_) {
    if (count > 4) continue;
    const bool half = symbol == 'H' || symbol == 'h';
    const char draws = symbol == 'H' ? 'F' : symbol == 'h' ? 'f' : symbol;
    if (!half && count < 2) continue;
    std::string rule = symbol + std::string(parameters[count]) + " -> ";
    if (count > 1) rule += "!(w)";
    rule += half && count == 0 ? std::string("@Di(0.5)") + draws + "@Dd(0.5)"
                               : draws + std::string(half ? "(l/2)" : "(l)");
    rules.push_back(rule);
  }
  return rules;
}

}  // namespace seedmesh
