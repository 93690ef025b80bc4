#include "core/lang/reader.h"

#include <algorithm>
#include <array>

namespace seedmesh::lang {
namespace {

/// Where a text that went wrong starts to make sense again, whatever is open.
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

void Reader::fault(const Token& where, std::string message) {
  if (!faults_.empty() && faults_.back().offset == where.offset) return;
  faults_.push_back({where.offset, std::move(message)});
  if (faults_.size() >= max_faults) damage_ = Damage::total;
}

void Reader::break_off(const std::string& expected) {
  fault(token(), "expected " + expected + ", found " + in_quotes(token()));
  damage_ = std::max(damage_, Damage::local);
}

void Reader::give_up(const Token& where, std::string message) {
  fault(where, std::move(message));
  damage_ = Damage::total;
}

bool Reader::enter() {
  if (depth_ >= max_depth_) {
    give_up(token(), "nested deeper than " + std::to_string(max_depth_));
    return false;
  }
  ++depth_;
  return true;
}

void Reader::recover(Until until) {
  if (damage_ != Damage::local) return;
  std::size_t open = 0;
  for (; !ends_any_expression(token()); ++at_) {
    const bool ends = is_here(")") || (until == Until::bracket_or_comma && is_here(","));
    if (open == 0 && ends) {
      damage_ = Damage::none;
      return;
    }
    if (is_here("(")) ++open;
    if (is_here(")")) --open;
  }
}

void Reader::skip_to_end_of_damage() {
  if (damage_ == Damage::none) return;
  std::size_t open = 0;
  for (; !ends_any_expression(token()); ++at_) {
    const bool closes = is_here(")") || is_here("]");
    if (open == 0 && (closes || is_here(","))) return;
    if (is_here("(") || is_here("[")) ++open;
    if (closes) --open;
  }
}

std::string Reader::place_for_message() const {
  return at_ > first_ ? "a value after " + in_quotes(tokens_[at_ - 1]) : "an expression";
}

std::vector<Fault> Reader::take_faults() {
  std::stable_sort(faults_.begin(), faults_.end(),
                   [](const Fault& a, const Fault& b) { return a.offset < b.offset; });
  return std::move(faults_);
}

}  // namespace seedmesh::lang
