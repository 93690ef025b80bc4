#pragma once
/// The position of a parser in its tokens, its errors so far, and panic-mode error recovery (Aho, Lam, Sethi, Ullman,
/// "Compilers", 2nd edition, 4.1.4): after an error, tokens are skipped up to one where parsing can go on.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// What has to be skipped after an error.
enum class Panic {
  none,
  bracket,     ///< up to the next bracket or comma of the open call
  expression,  ///< the rest of the expression
};

class Reader {
 public:
  /// Brackets, calls, signs and powers that nest deeper than `max_depth` are an error.
  Reader(std::span<const Token> tokens, std::size_t at, std::uint32_t max_depth);

  std::size_t at() const { return at_; }
  const Token& token(std::size_t ahead = 0) const {
    return at_ + ahead < tokens_.size() ? tokens_[at_ + ahead] : end_;
  }
  bool is_here(std::string_view symbol) const { return is_symbol(token(), symbol); }
  void advance(std::size_t count = 1) { at_ += count; }

  /// Reports an error and continues. Of several errors in a row at one offset only the first is kept, since the others
  /// follow from it.
  void report(const Token& where, std::string message, IssueKind kind = IssueKind::syntax);
  /// Reports that something else was expected at this token, and enters Panic::bracket.
  void report_expected(const std::string& expected);
  /// Reports an error that ends the expression: enters Panic::expression.
  void abandon(const Token& where, std::string message, IssueKind kind = IssueKind::out_of_range);
  bool is_sound() const { return panic_ == Panic::none; }
  bool has_errors() const { return !errors_.empty(); }

  /// Enters one level of nesting, which leave() leaves. Returns false if it would be too deep; the expression
  /// is then abandoned.
  bool enter();
  void leave() { --depth_; }
  std::uint32_t remaining_depth() const { return max_depth_ - depth_; }

  enum class Until { bracket, bracket_or_comma };
  /// In Panic::bracket, skips to the `)` (or comma) that belongs to the innermost open bracket, and leaves
  /// the panic if it is found.
  void recover(Until until);
  /// After an error: skips to the first token that does not belong to the expression; see Program::parse.
  void skip_expression();

  /// Returns what a message "expected ..." names here: "an expression" before the first token, else "a value
  /// after `x`".
  std::string expected_value() const;

  /// Moves the errors out, in the order of the text.
  std::vector<TextError> take_errors();

 private:
  std::span<const Token> tokens_;
  std::size_t at_, first_;
  std::uint32_t max_depth_, depth_ = 0;
  Panic panic_ = Panic::none;
  std::vector<TextError> errors_;
  Token end_;
};

}  // namespace seedmesh::lang
