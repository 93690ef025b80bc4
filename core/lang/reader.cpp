#include "core/lang/reader.h"

#include <algorithm>
#include <array>

namespace seedmesh::lang {
namespace {

/// Whether the token ends every expression, even inside of brackets.
bool ends_any_expression(const Token& token) {
  if (token.kind == TokenKind::end) return true;
  constexpr std::array<std::string_view, 7> marks = {"->", "-->", "~>", ":", ";", "{", "}"};
  return token.kind == TokenKind::symbol && std::find(marks.begin(), marks.end(), token.text) != marks.end();
}

}  // namespace

Reader::Reader(std::span<const Token> tokens, std::size_t at, std::uint32_t max_depth)
    : tokens_(tokens), at_(at), first_(at), max_depth_(max_depth) {
  if (!tokens.empty()) end_.offset = tokens.back().offset + tokens.back().length;
}

void Reader::report(const Token& where, std::string message, IssueKind kind) {
  if (!errors_.empty() && errors_.back().offset == where.offset) return;
  errors_.push_back({where.offset, std::move(message), kind});
  if (errors_.size() >= max_errors) panic_ = Panic::expression;
}

void Reader::report_expected(const std::string& expected) {
  report(token(), "expected " + expected + ", found " + in_quotes(token()));
  panic_ = std::max(panic_, Panic::bracket);
}

void Reader::abandon(const Token& where, std::string message, IssueKind kind) {
  report(where, std::move(message), kind);
  panic_ = Panic::expression;
}

bool Reader::enter() {
  if (depth_ >= max_depth_) {
    abandon(token(), "nested deeper than " + std::to_string(max_depth_));
    return false;
  }
  ++depth_;
  return true;
}

void Reader::recover(Until until) {
  if (panic_ != Panic::bracket) return;
  std::size_t open = 0;
  for (; !ends_any_expression(token()); ++at_) {
    const bool ends = is_here(")") || (until == Until::bracket_or_comma && is_here(","));
    if (open == 0 && ends) {
      panic_ = Panic::none;
      return;
    }
    if (is_here("(")) ++open;
    if (is_here(")")) --open;
  }
}

void Reader::skip_expression() {
  if (panic_ == Panic::none) return;
  std::size_t open = 0;
  for (; !ends_any_expression(token()); ++at_) {
    const bool closes = is_here(")") || is_here("]");
    if (open == 0 && (closes || is_here(","))) return;
    if (is_here("(") || is_here("[")) ++open;
    if (closes) --open;
  }
}

std::string Reader::expected_value() const {
  return at_ > first_ ? "a value after " + in_quotes(tokens_[at_ - 1]) : "an expression";
}

std::vector<TextError> Reader::take_errors() {
  std::stable_sort(errors_.begin(), errors_.end(),
                   [](const TextError& a, const TextError& b) { return a.offset < b.offset; });
  return std::move(errors_);
}

}  // namespace seedmesh::lang
