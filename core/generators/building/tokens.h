#pragma once
/// Rules as tokens.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/generators/building/load_files.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {

/// The tokens of rules. Comments are left out, the signs ≥ ≤ ≠ are >= <= !=, and every bracket knows its
/// partner.
class Tokens {
 public:
  Tokens(const Tokens&) = delete;
  Tokens& operator=(const Tokens&) = delete;
  /// Imported files come behind the main file, with prefixes (load_files.h).
  Tokens(const RuleText& text, std::string_view style, std::vector<lang::TextError>& faults);
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
  /// Whether a name belongs to an imported file that the request does not have.
  bool is_missing(std::string_view name) const;
  bool has_imports() const { return loaded_.has_imports; }
  /// Whether a comparison of each value of an array begins at token i: `.==` and the like.
  bool is_each_comparison(std::size_t i) const;
  /// The closing partner of an opening bracket; the end if it has none.
  std::size_t partner(std::size_t i) const { return partner_[i]; }
  /// The token behind the expression that begins at i; i if none begins there.
  std::size_t behind_expression(std::size_t i) const;

 private:
  std::size_t behind_operand(std::size_t i) const;

  const RuleText& files_;
  std::string text_;  ///< without comments; tokens point into it
  std::size_t main_size_ = 0;
  LoadedTokens loaded_;
  std::vector<lang::Token>& tokens_ = loaded_.tokens;
  std::vector<std::size_t> partner_;
};

}  // namespace seedmesh::building
