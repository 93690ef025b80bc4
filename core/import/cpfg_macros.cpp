#include "core/import/cpfg_macros.h"

#include <algorithm>

#include "core/generators/lsystem/notation.h"

namespace seedmesh {
namespace {

constexpr std::size_t longest_expansion = 1'000'000;  // bytes that macros may write into one line
constexpr int deepest_expansion = 50;
constexpr std::size_t most_macros = 1'000;  // as many as a request may have constants

std::string_view part(std::string_view text, Line line) {
  return text.substr(line.from, line.to - line.from);
}

bool is_expression(const lang::Names& names, const std::string& body) {
  std::vector<lang::Fault> faults;
  const std::vector<lang::Token> tokens = lang::tokenize(body, 0, body.size(), faults);
  lang::Program program;
  std::size_t at = 0;
  program.parse(tokens, at, names, faults);
  return faults.empty() && tokens[at].kind == lang::TokenKind::end;
}

}  // namespace

bool is_name_part(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

void CpfgMacros::define(std::string_view text, Line line) {
  line = trimmed(text, line);
  std::size_t at = trimmed(text, {line.from + 1, line.to}).from;
  std::size_t end = at;
  while (end < line.to && is_letter(text[end])) ++end;
  if (part(text, {at, end}) != "define") {
    source_.fault(line.from, "found " + lang::in_quotes(part(text, {line.from, end})) +
                                 "; of the preprocessor only #define is understood");
    return;
  }
  at = trimmed(text, {end, line.to}).from;
  end = at;
  while (end < line.to && is_name_part(text[end])) ++end;
  if (end == at || is_digit(text[at])) {
    source_.fault(at, "expected the name of a macro");
    return;
  }
  Macro macro;
  macro.at = at;
  const std::string name(part(text, {at, end}));
  if (end < line.to && text[end] == '(') {
    const std::size_t close = lsystem::closing(text, end, line.to);
    if (close == line.to) {
      source_.fault(end, "found `(` without its `)`");
      return;
    }
    macro.has_parameters = true;
    macro.parameters = part(text, {end, close + 1});
    end = close + 1;
  }
  macro.body = part(text, trimmed(text, {end, line.to}));
  if (macros_.size() == most_macros) {
    source_.fault(at, "found more than 1,000 macros");
  } else if (!macros_.emplace(name, std::move(macro)).second) {
    source_.fault(at, "found a second macro of this name");
  }
}

void CpfgMacros::sort() {
  lang::Names names;
  for (const auto& [name, macro] : macros_) {
    if (macro.has_parameters) {
      define_function(names, name, macro);
    } else {
      names.bind_constant(name, 1);
    }
  }
  for (auto& [name, macro] : macros_) {
    macro.is_expression = macro.has_parameters || is_expression(names, macro.body);
  }
}

void CpfgMacros::define_function(lang::Names& names, const std::string& name, const Macro& macro) {
  const std::string definition = name + macro.parameters + " = " + macro.body;
  lang::Names::Defined function;
  std::vector<lang::Fault> faults;
  lang::read_definition(definition, function, faults);
  if (!faults.empty()) {
    source_.fault(macro.at, "found a macro with parameters that is no function: " + faults[0].message);
    return;
  }
  function.body.clear();
  function.is_sound = false;  // calls are not judged here
  names.define(name, std::move(function));
  functions_.push_back({name, definition, macro.at});
}

std::vector<CpfgMacros::Expression> CpfgMacros::constants() const {
  std::vector<Expression> found;
  for (const auto& [name, macro] : macros_) {
    if (macro.is_expression && !macro.has_parameters) found.push_back({name, macro.body, macro.at});
  }
  return found;
}

std::string CpfgMacros::expanded(std::string_view text, std::size_t at_text, bool& changed) {
  std::string out(text);
  changed = false;
  for (int round = 0; round < deepest_expansion; ++round) {
    std::string next;
    bool again = false;
    for (std::size_t at = 0; at < out.size();) {
      std::size_t end = at;
      while (end < out.size() && is_name_part(out[end])) ++end;
      const auto macro = end > at ? macros_.find(out.substr(at, end - at)) : macros_.end();
      if (macro != macros_.end() && !macro->second.is_expression) {
        next += macro->second.body;
        again = true;
      } else {
        next += out.substr(at, std::max<std::size_t>(end - at, 1));
      }
      at = std::max(end, at + 1);
      if (next.size() > longest_expansion) {
        source_.fault(at_text, "macros make this line longer than 1,000,000 bytes");
        return {};
      }
    }
    out = std::move(next);
    changed = changed || again;
    if (!again) return out;
  }
  source_.fault(at_text, "found macros that contain themselves");
  return {};
}

}  // namespace seedmesh
