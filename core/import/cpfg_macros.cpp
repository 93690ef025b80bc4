#include "core/import/cpfg_macros.h"

#include <algorithm>

#include "core/generators/lsystem/notation.h"

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr std::size_t longest_expansion = 1'000'000;  // bytes in one line
constexpr int deepest_expansion = 50;
constexpr std::size_t most_macros = 1'000;  // the most constants of a request

std::string_view part(std::string_view text, Line line) {
  return text.substr(line.from, line.to - line.from);
}

/// The end of the name that begins at `at`; `at` if none does.
std::size_t name_end(std::string_view text, std::size_t at) {
  if (at >= text.size() || is_digit(text[at]) || !is_name_part(text[at])) return at;
  while (at < text.size() && is_name_part(text[at])) ++at;
  return at;
}

/// Whether the text is one operand in every context: a number, a name, a call, or in parentheses.
bool is_operand(std::string_view text) {
  std::vector<lang::TextError> errors;
  const std::vector<Token> tokens = lang::tokenize(text, 0, text.size(), errors);
  const std::size_t count = tokens.size() - 1;
  if (!errors.empty() || count == 0) return false;
  const bool is_single = tokens[0].kind == TokenKind::number || tokens[0].kind == TokenKind::name;
  if (count == 1) return is_single;
  if (count == 2) return lang::is_symbol(tokens[0], "-") && tokens[1].kind == TokenKind::number;
  std::size_t open = tokens[0].kind == TokenKind::name ? 1 : 0;
  if (!lang::is_symbol(tokens[open], "(")) return false;
  int depth = 0;
  for (; open < count; ++open) {
    if (lang::is_symbol(tokens[open], "(")) ++depth;
    if (lang::is_symbol(tokens[open], ")") && --depth == 0) break;
  }
  return open + 1 == count;
}

}  // namespace

bool is_name_part(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

void CpfgMacros::define(std::string_view text, Line line) {
  line = trimmed(text, line);
  std::size_t at = trimmed(text, {line.from + 1, line.to}).from;
  std::size_t end = at;
  while (end < line.to && is_letter(text[end])) ++end;
  if (part(text, {at, end}) != "define") {
    source_.report(line.from, "found " + lang::in_quotes(part(text, {line.from, end})) +
                                  "; the supported commands of the preprocessor are #define, #undef and #if");
    return;
  }
  at = trimmed(text, {end, line.to}).from;
  end = at;
  while (end < line.to && is_name_part(text[end])) ++end;
  if (end == at || is_digit(text[at])) {
    source_.report(at, "expected the name of a macro");
    return;
  }
  Macro macro;
  macro.at = at;
  const std::string name(part(text, {at, end}));
  if (end < line.to && text[end] == '(') {
    const std::size_t close = lsystem::closing(text, end, line.to);
    if (close == line.to) {
      source_.report(end, "found `(` without its `)`");
      return;
    }
    macro.has_parameters = true;
    macro.parameter_list = part(text, {end, close + 1});
    for (std::size_t from = end + 1; from < close;) {
      const std::size_t comma = std::min(text.substr(0, close).find(',', from), close);
      macro.parameters.emplace_back(part(text, trimmed(text, {from, comma})));
      from = comma + 1;
    }
    end = close + 1;
  }
  macro.body = part(text, trimmed(text, {end, line.to}));
  const auto known = macros_.find(name);
  if (known != macros_.end() && known->second.body == macro.body &&
      known->second.parameter_list == macro.parameter_list)
    return;
  if (known != macros_.end()) {
    source_.warn(at, "found a second macro " + lang::in_quotes(name) + "; it applies to the whole file here");
    known->second = std::move(macro);
  } else if (macros_.size() == most_macros) {
    source_.report(at, "found more than 1,000 macros");
  } else {
    macros_.emplace(name, std::move(macro));
  }
}

bool CpfgMacros::parses(lang::Names& names, const Macro& macro) const {
  const std::size_t outer = names.size();
  for (const std::string& parameter : macro.parameters) names.bind_constant(parameter, 1);
  std::vector<lang::TextError> errors;
  const std::vector<Token> tokens = lang::tokenize(macro.body, 0, macro.body.size(), errors);
  lang::Program program;
  std::size_t at = 0;
  program.parse(tokens, at, names, errors);
  names.forget_after(outer);
  return errors.empty() && tokens[at].kind == TokenKind::end;
}

void CpfgMacros::sort() {
  lang::Names names;
  for (const auto& [name, macro] : macros_) {
    if (!macro.has_parameters) {
      names.bind_constant(name, 1);
      continue;
    }
    lang::Names::Defined function;
    std::vector<lang::TextError> errors;
    const std::string definition = name + macro.parameter_list + " = 1";
    lang::read_definition(definition, function, errors);
    if (!errors.empty()) continue;
    function.body.clear();
    function.is_valid = false;  // calls are not checked here
    names.define(name, std::move(function));
  }
  for (auto& [name, macro] : macros_) {
    const bool has_name = !macro.has_parameters || names.find_function(name) != nullptr;
    macro.is_value = has_name && is_operand(macro.body) && parses(names, macro);
  }
}

std::vector<CpfgMacros::Expression> CpfgMacros::constants() {
  std::vector<Expression> found;
  for (const auto& [name, macro] : macros_) {
    if (!macro.is_value || macro.has_parameters) continue;
    TracedText body;
    body.write(macro.body, macro.at);
    found.push_back({name, expanded(body).text(), macro.at});
  }
  return found;
}

std::vector<CpfgMacros::Expression> CpfgMacros::functions() {
  std::vector<Expression> found;
  for (const auto& [name, macro] : macros_) {
    if (!macro.is_value || !macro.has_parameters) continue;
    TracedText body;
    body.write(macro.body, macro.at);
    found.push_back({name, name + macro.parameter_list + " = " + expanded(body).text(), macro.at});
  }
  return found;
}

void CpfgMacros::stop(std::size_t at, const char* why) {
  if (!std::exchange(is_stopped_, true)) source_.report(at, why);
}

TracedText CpfgMacros::expanded(const TracedText& text) {
  spent_ = 0;
  is_stopped_ = false;
  TracedText out = expand(text, 0);
  return is_stopped_ ? TracedText() : out;
}

TracedText CpfgMacros::expand(const TracedText& text, int depth) {
  TracedText out;
  for (std::size_t at = 0; at < text.size() && !is_stopped_;) {
    const std::size_t end = name_end(text.text(), at);
    const auto found = end > at ? macros_.find(text.text().substr(at, end - at)) : macros_.end();
    const std::size_t from = text.origin(at);
    if (found == macros_.end()) {
      // Letters behind a number belong to it, as in 1e3.
      std::size_t rest = std::max(end, at + 1);
      if (is_digit(text[at])) {
        while (rest < text.size() && is_name_part(text[rest])) ++rest;
      }
      out.copy(text, at, rest);
      at = rest;
    } else if (found->second.has_parameters) {
      if (expand_call(found->first, found->second, text, at, depth, out)) continue;
      out.copy(text, at, end);
      at = end;
    } else if (found->second.is_value) {
      out.copy(text, at, end);
      at = end;
    } else {
      spent_ += found->second.body.size() + 1;
      if (depth >= deepest_expansion) stop(from, "found macros that contain themselves");
      if (spent_ > longest_expansion) stop(from, "macros make this line longer than 1,000,000 bytes");
      if (is_stopped_) break;
      const TracedText body = expand(pasted(found->second, {}, from), depth + 1);
      out.copy(body, 0, body.size());
      at = end;
    }
  }
  return out;
}

/// Expands the macro with parameters at text[at]. It stays a call if the request has the function and every argument is
/// a single operand; otherwise its text is pasted. False: no parameters follow.
bool CpfgMacros::expand_call(const std::string& name, const Macro& macro, const TracedText& text,
                             std::size_t& at, int depth, TracedText& out) {
  const std::size_t open = lsystem::skip_spaces(text.text(), at + name.size(), text.size());
  if (open == text.size() || text[open] != '(') return false;
  const std::size_t from = text.origin(at);
  const std::size_t close = lsystem::closing(text.text(), open, text.size());
  if (close == text.size()) {
    stop(text.origin(open), "found `(` without its `)`");
    return true;
  }
  if (depth >= deepest_expansion) {
    stop(from, "found macros that contain themselves");
    return true;
  }
  std::vector<TracedText> arguments;
  bool are_operands = macro.is_value;
  int inner = 0;
  for (std::size_t i = open + 1, begin = i; i <= close; ++i) {
    if (text[i] == '(') ++inner;
    if (text[i] == ')' && i != close) --inner;
    if (i != close && (text[i] != ',' || inner > 0)) continue;
    const Line argument = trimmed(text.text(), {begin, i});
    arguments.push_back(expand(text.part(argument.from, argument.to), depth + 1));
    are_operands = are_operands && is_operand(arguments.back().text());
    begin = i + 1;
  }
  at = close + 1;
  if (arguments.size() != macro.parameters.size() && !are_operands) {
    source_.report(from, "found " + std::to_string(arguments.size()) + " arguments of the macro " +
                             lang::in_quotes(name) + "; it has " + std::to_string(macro.parameters.size()));
  } else if (are_operands) {
    out.write(name + "(", from);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (i > 0) out.write(",", from);
      out.copy(arguments[i], 0, arguments[i].size());
    }
    out.write(")", from);
  } else {
    const TracedText body = pasted(macro, arguments, from);
    spent_ += body.size();
    if (spent_ > longest_expansion) {
      stop(from, "macros make this line longer than 1,000,000 bytes");
      return true;
    }
    const TracedText expanded = expand(body, depth + 1);
    out.copy(expanded, 0, expanded.size());
  }
  return true;
}

TracedText CpfgMacros::pasted(const Macro& macro, const std::vector<TracedText>& arguments,
                              std::size_t from) const {
  TracedText out;
  for (std::size_t at = 0; at < macro.body.size();) {
    const std::size_t end = std::max(name_end(macro.body, at), at + 1);
    const std::string word = macro.body.substr(at, end - at);
    const auto found = std::find(macro.parameters.begin(), macro.parameters.end(), word);
    if (found == macro.parameters.end() || arguments.empty()) {
      out.write(word, from);
    } else {
      const TracedText& argument = arguments[static_cast<std::size_t>(found - macro.parameters.begin())];
      out.copy(argument, 0, argument.size());
    }
    at = end;
  }
  return out;
}

}  // namespace seedmesh
