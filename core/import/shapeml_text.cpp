#include "core/import/shapeml_text.h"

#include <algorithm>

#include "core/import/shapeml_expand.h"
#include "core/import/shapeml_names.h"

namespace seedmesh {
namespace {

using lang::Token;
using lang::TokenKind;

/// The text with blanks instead of comments.
std::string without_comments_of(std::string_view text) {
  std::string out(text);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] == '"') {
      for (++i; i < out.size() && out[i] != '"' && out[i] != '\n'; ++i) i += out[i] == '\\' ? 1 : 0;
    } else if (out.compare(i, 2, "//") == 0) {
      for (; i < out.size() && out[i] != '\n'; ++i) out[i] = ' ';
    } else if (out.compare(i, 2, "/*") == 0) {
      const std::size_t end = std::min(out.find("*/", i + 2), out.size());
      for (const std::size_t last = std::min(end + 2, out.size()); i < last; ++i)
        out[i] = out[i] == '\n' ? '\n' : ' ';
      --i;
    }
  }
  return out;
}

/// Reports each `#` that is not `#include "name"` at the beginning of a line, and puts blanks in place of its line. ShapeML
/// has no other directive, and its comments begin with `//`.
std::string without_other_directives(std::string text, ForeignText& source) {
  constexpr std::string_view key = "include";
  for (std::size_t i = 0, line = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line = i + 1;
    if (text[i] == '"') {
      for (++i; i < text.size() && text[i] != '"' && text[i] != '\n'; ++i) i += text[i] == '\\' ? 1 : 0;
    }
    if (i >= text.size() || text[i] != '#') continue;
    const Line word = trimmed(text, {i + 1, std::min(text.find('\n', i), text.size())});
    const std::string_view words = std::string_view(text).substr(word.from, word.to - word.from);
    const bool is_include = words.starts_with(key) && words.find('"') < words.rfind('"');
    if (is_include && trimmed(text, {line, i}).from == i) continue;
    source.report(
        i,
        "found `#`, which begins no comment in ShapeML; expected `//`, or `#include` with the name of a "
        "file in quotes on a line of its own");
    for (; i < text.size() && text[i] != '\n'; ++i) text[i] = ' ';
    --i;
  }
  return text;
}

std::string_view closing_of(std::string_view opening) {
  return opening == "(" ? ")" : opening == "{" ? "}" : "]";
}

}  // namespace

ShapemlText::ShapemlText(ForeignText& source)
    : source_(source), text_(without_other_directives(without_comments_of(source.text()), source)) {
  std::vector<lang::TextError> errors;
  tokens_ = lang::tokenize(text_, 0, text_.size(), errors);
  for (const lang::TextError& error : errors) source_.report(error.offset, error.message);
  expand_shapeml_operations(tokens_, made_names_, source_);
  std::vector<std::size_t> constants;
  for (std::size_t i = 0; i + 2 < tokens_.size(); ++i) {
    const std::string_view word = at(i).text;
    if (!is_name(i)) continue;
    if (word == "index") attributes_.insert(shapeml_index);
    if (word == "hide" || word == "show") attributes_.insert(shapeml_hidden);
    if (word == "set" && is(i + 1, "(") && at(i + 2).kind == TokenKind::string)
      set_names_.insert(lang::string_value(at(i + 2)));
    if ((word == "param" || word == "const" || word == "func") && is_name(i + 1))
      declared_.insert(std::string(at(i + 1).text));
    if ((word == "param" || word == "const") && is_name(i + 1) && is(i + 2, "=")) constants.push_back(i + 1);
    if (word != "rule" || !is(i + 2, "(")) continue;
    for (std::size_t k = i + 3; k + 1 < tokens_.size() && !is(k, ")"); ++k)
      declared_.insert(std::string(at(k).text));
  }
  partner_.assign(tokens_.size(), tokens_.size() - 1);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < tokens_.size(); ++i) {
    if (is(i, "(") || is(i, "{") || is(i, "[")) open.push_back(i);
    if (!is(i, ")") && !is(i, "}") && !is(i, "]")) continue;
    const bool fits = !open.empty() && closing_of(at(open.back()).text) == at(i).text;
    if (!fits && source_.error_count() == 0)
      error(i, "found " + in_quotes(at(i)) + " without its opening bracket");
    if (open.empty()) continue;
    partner_[open.back()] = i;
    open.pop_back();
  }
  if (!open.empty() && source_.error_count() == 0) {
    error(open.back(), "found " + in_quotes(at(open.back())) + " without its `" +
                           std::string(closing_of(at(open.back()).text)) + "`");
  }
  for (const std::size_t i : constants) {
    if (is_integer(i + 2, find(i, ";"))) integers_.insert(std::string(at(i).text));
  }
}

std::size_t ShapemlText::find(std::size_t i, std::string_view symbol) const {
  while (i + 1 < tokens_.size() && !is(i, symbol))
    i = is(i, "(") || is(i, "{") || is(i, "[") ? partner_[i] + 1 : i + 1;
  return std::min(i, tokens_.size() - 1);
}

std::vector<std::pair<std::size_t, std::size_t>> ShapemlText::arguments(std::size_t i) const {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  if (!is(i + 1, "(")) return out;
  const std::size_t close = partner_[i + 1];
  for (std::size_t k = i + 2; k < close;) {
    std::size_t end = k;
    while (end < close && !is(end, ","))
      end = is(end, "(") || is(end, "{") ? std::min(partner_[end] + 1, close) : end + 1;
    out.emplace_back(k, end);
    k = end + 1;
  }
  return out;
}

std::size_t ShapemlText::behind_integer(std::size_t i, std::size_t to) const {
  if (at(i).kind == TokenKind::number)
    return at(i).text.find_first_of(".eE") == std::string_view::npos ? i + 1 : i;
  if (!is_name(i) || i >= to) return i;
  const bool is_call = is(i + 1, "(");
  if (is_call) return at(i).text == "int" || at(i).text == "rand_int" ? partner_[i + 1] + 1 : i;
  return at(i).text == "index" || at(i).text == "depth" || integers_.contains(at(i).text) ? i + 1 : i;
}

bool ShapemlText::is_integer(std::size_t from, std::size_t to) const {
  for (std::size_t i = from; i < to;) {
    const std::size_t behind = behind_integer(i, to);
    const bool is_sign =
        is(i, "+") || is(i, "-") || is(i, "*") || is(i, "/") || is(i, "%") || is(i, "(") || is(i, ")");
    if (behind == i && !is_sign) return false;
    i = std::max(behind, i + 1);
  }
  return from < to;
}

void ShapemlText::expression(std::size_t from, std::size_t to, TracedText& out) {
  for (std::size_t i = from; i < to; ++i) {
    // ShapeML cuts the quotient of integers.
    const std::size_t sign = behind_integer(i, to);
    const std::size_t behind =
        sign > i && sign < to && is(sign, "/") ? behind_integer(sign + 1, to) : sign + 1;
    const bool follows_factor = i > from && (is(i - 1, "*") || is(i - 1, "/") || is(i - 1, "%"));
    if (sign > i && behind > sign + 1 && behind <= to && !follows_factor) {
      out.write(" trunc((", at(i).offset);
      expression(i, sign, out);
      out.write(") / (", at(sign).offset);
      expression(sign + 1, behind, out);
      out.write("))", at(behind - 1).offset);
      i = behind - 1;
      continue;
    }
    const Token& token = at(i);
    const std::size_t offset = token.offset;
    const bool is_call = is(i + 1, "(");
    if (i > from) out.write(" ", offset);
    if (token.kind == TokenKind::string) {
      std::string text(token.text);
      if (text == "partial") text = "part";  // an answer of occlusion
      if (text.size() == 4 && text[0] == '#')
        text = {'#', text[1], text[1], text[2], text[2], text[3], text[3]};
      out.write("\"" + text + "\"", offset);
    } else if (token.kind != TokenKind::name) {
      out.write(token.text, offset);
    } else if (token.text == "occlusion") {
      out.write(is_call ? "Shape.occ" : "Shape.occ(\"all\")", offset);
    } else if (token.text == "get" && is_call && at(i + 2).kind == TokenKind::string) {
      const std::string name = "own_" + lang::string_value(at(i + 2));
      attributes_.insert(name);
      out.write(name, offset);
      i = std::min(partner_[i + 1], to);
    } else if (!is_call && set_names_.contains(token.text) && !declared_.contains(token.text)) {
      attributes_.insert("own_" + std::string(token.text));
      out.write("own_" + std::string(token.text), offset);
    } else if (token.text == "clamp" && is_call) {
      // It has its bounds first in ShapeML.
      needed_.insert("clamp_between");
      out.write("clamp_between", offset);
    } else {
      const auto names = shapeml_names();
      const auto found = std::ranges::find(names, token.text, &ShapemlName::name);
      for (const ShapemlFunction& each : shapeml_functions()) {
        if (is_call && each.name == token.text) needed_.insert(std::string(each.name));
      }
      out.write(found == names.end() ? token.text : found->rules, offset);
    }
  }
}

}  // namespace seedmesh
