#pragma once
/// Splits the text of rules into tokens.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/generators/building/load_files.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {

/// The tokens of rules. Comments are left out, and the signs ≥ ≤ ≠ are >= <= !=. For each opening bracket, the index of
/// its closing bracket is stored.
class Tokens {
 public:
  Tokens(const Tokens&) = delete;
  Tokens& operator=(const Tokens&) = delete;
  /// Tokens of imported files follow those of the main file. Their names get the prefix of the import (load_files.h).
  Tokens(const RuleText& text, std::string_view style, std::vector<lang::TextError>& errors);
  /// Gives token i another text, which has to outlive the tokens.
  void rename(std::size_t i, std::string_view text) { tokens_[i].text = text; }
  const lang::Token& at(std::size_t i) const { return tokens_[i < tokens_.size() ? i : tokens_.size() - 1]; }
  bool is(std::size_t i, std::string_view symbol) const { return lang::is_symbol(at(i), symbol); }
  bool is_name(std::size_t i, std::string_view name) const {
    return at(i).kind == lang::TokenKind::name && at(i).text == name;
  }
  bool is_arrow(std::size_t i) const { return is(i, "-->") || is(i, "~>") || is(i, "->"); }
  bool is_end(std::size_t i) const { return at(i).kind == lang::TokenKind::end; }
  std::size_t end() const { return tokens_.size() - 1; }
  int line_of(std::size_t offset) const;
  bool is_main(std::size_t i) const { return at(i).offset <= main_size_; }  ///< a token of the main file
  const std::string& start() const { return loaded_.start; }
  const std::vector<lang::TextError>& warnings() const { return loaded_.warnings; }
  /// Returns whether the prefix of a name is an import whose file is missing from the request.
  bool is_missing(std::string_view name) const;
  bool has_imports() const { return loaded_.has_imports; }
  /// Returns whether token i starts an elementwise array comparison, such as `.==`.
  bool is_each_comparison(std::size_t i) const;
  /// Returns the index of the closing bracket of an opening one; the end if it has none.
  std::size_t partner(std::size_t i) const { return partner_[i]; }
  /// Returns the index of the token after the expression that begins at i; i if none begins there.
  std::size_t after_expression(std::size_t i) const;

 private:
  std::size_t after_operand(std::size_t i) const;

  const RuleText& files_;
  std::string text_;  ///< text without comments; tokens point into it
  std::size_t main_size_ = 0;
  LoadedTokens loaded_;
  std::vector<lang::Token>& tokens_ = loaded_.tokens;
  std::vector<std::size_t> partner_;
};

}  // namespace seedmesh::building
