/// The request that the parts of a cpfg file make.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/import/cpfg_reader.h"
#include "core/import/cpfg_view.h"

namespace seedmesh {
namespace {

constexpr double most_steps = 1'000;  // of a request

}  // namespace

void CpfgReader::put(const std::string& name, Json value, std::vector<TextRun> runs) {
  out_.origins.push_back({"/parameters/" + name, std::move(runs)});
  parameters_[name] = std::move(value);
}

void CpfgReader::put_constant(const std::string& name, const TracedText& value) {
  names_.reset();
  constants_.emplace(name, value.text());
  out_.origins.push_back({"/parameters/constants/" + name, value.runs()});
}

void CpfgReader::put_rules() {
  static const char* const names[] = {"productions", "decomposition", "interpretation"};
  add_cpfg_rules_for_surfaces(rules_, words_);
  for (std::size_t part = 0; part < std::size(names); ++part) {
    for (const CpfgRule& rule : rules_[part]) {
      const auto other = words_.inside().find(rule.predecessor[0]);
      if (rule.is_for_one_letter() && other != words_.inside().end()) {
        words_.warn_once(rule.at, other->second,
                         "is one symbol here: the rule for " +
                             lang::in_quotes(std::string_view(rule.predecessor.text()).substr(0, 1)) +
                             " rewrites a part of it only in cpfg");
      }
      Json& list = parameters_[names[part]];
      if (list.is_null()) list = Json::array();
      const TracedText written = rule.written();
      out_.origins.push_back(
          {std::string("/parameters/") + names[part] + "/" + std::to_string(list.size()), written.runs()});
      list.push_back(written.text());
    }
  }
  put_rule_order();
}

/// cpfg tries rules in the order of the file. That matters where one without a context comes before one with a context.
void CpfgReader::put_rule_order() {
  std::set<char> plain;
  for (const CpfgRule& rule : rules_[0]) {
    if (rule.is_strict) parameters_["strict_predecessors"] = true;
    const char symbol = rule.predecessor[0];
    if (!rule.has_context()) {
      plain.insert(symbol);
    } else if (plain.contains(symbol)) {
      parameters_["rule_order"] = "listed";
    }
  }
}

void CpfgReader::put_surfaces() {
  for (const auto& [symbol, at] : words_.surfaces()) {
    const std::string name = CpfgWords::surface_name(symbol);
    parameters_["surfaces"][name] = {{"shape", "simple"}};
    source_.warn(
        at, lang::in_quotes("~" + name) + " is a surface of another file of cpfg; a leaf of 1 m replaces it",
        "/parameters/surfaces/" + name);
  }
  for (const auto& [name, at] : words_.rounds())
    parameters_["surfaces"][name] = {{"shape", name == "_O" ? "sphere" : "disc"}};
}

void CpfgReader::put_symbols() {
  for (const auto& [name, line] : symbols_) {
    const TracedText whole = expanded(line);
    if (name == "ignore" && whole.text().find_first_of("[]") != std::string::npos)
      source_.warn(line.from, "brackets count in contexts, also where they are ignored in cpfg");
    put(name, words_.listed(whole.text()), {{0, line.from, false}});
  }
}

Imported CpfgReader::made() {
  put_rules();
  put_variables();
  put_surfaces();
  put_symbols();
  for (const CpfgMacros::Expression& each : macros_.constants()) {
    TracedText text;
    text.write(each.text, each.at);
    constants_.emplace(each.name, words_.expression(text, {0, text.size()}).text());
    out_.origins.push_back({"/parameters/constants/" + each.name, {{0, each.at, false}}});
  }
  if (!has_axiom_) source_.report(0, "found no axiom");
  if (length_.from == length_.to) {
    source_.report(0, "found no derivation length");
  } else if (const std::optional<double> value = number(expression(length_), length_.from)) {
    if (!(*value >= 0) || *value != std::floor(*value)) {
      source_.report(length_.from, "expected a derivation length that is a whole number");
    } else {
      if (*value > most_steps) {
        source_.warn(length_.from,
                     "the derivation length " + number_text(*value) + " becomes 1000, the greatest one here");
      }
      put("iterations", static_cast<int>(std::min(*value, most_steps)), {{0, length_.from, false}});
    }
  }
  for (const auto& [name, value] : constants_) parameters_["constants"][name] = value;
  for (const CpfgMacros::Expression& each : macros_.functions()) {
    Json& list = parameters_["functions"];
    if (list.is_null()) list = Json::array();
    out_.origins.push_back({"/parameters/functions/" + std::to_string(list.size()), {{0, each.at, false}}});
    TracedText text;
    text.write(each.text, each.at);
    list.push_back(words_.expression(text, {0, text.size()}).text());
  }
  put_cpfg_files(options_.files, parameters_, source_);
  out_.request["generator"] = "lsystem";
  out_.request["parameters"] = std::move(parameters_);
  return std::move(out_);
}

}  // namespace seedmesh
