#pragma once
/// Tokens of a ShapeML file, and the translation of its expressions to CGA.
#include <set>
#include <string>
#include <vector>

#include "core/import/foreign_text.h"
#include "core/import/traced_text.h"
#include "core/lang/lexer.h"

namespace seedmesh {

/// The attribute in the place of `index`, in files that use it.
inline constexpr char shapeml_index[] = "own_shape_index";
/// The attribute that `hide` sets, in files that use it.
inline constexpr char shapeml_hidden[] = "own_hidden";

class ShapemlText {
 public:
  explicit ShapemlText(ForeignText& source);

  const lang::Token& at(std::size_t i) const { return tokens_[std::min(i, tokens_.size() - 1)]; }
  bool is(std::size_t i, std::string_view symbol) const { return lang::is_symbol(at(i), symbol); }
  bool is_name(std::size_t i) const { return at(i).kind == lang::TokenKind::name; }
  void error(std::size_t i, const std::string& message) { source_.report(at(i).offset, message); }

  /// Returns the index of the next token `symbol` at the level of brackets of token i, or else that of the end token.
  std::size_t find(std::size_t i, std::string_view symbol) const;
  /// Returns the arguments of a call as ranges of tokens.
  std::vector<std::pair<std::size_t, std::size_t>> arguments(std::size_t i) const;
  /// Behind the integer at token `i`, a number, a name or a call; `i`: it is none that is known to be an integer.
  std::size_t behind_integer(std::size_t i, std::size_t to) const;
  /// Whether an expression consists of integers only.
  bool is_integer(std::size_t from, std::size_t to) const;
  /// Writes the expression of the tokens from `from` to before `to`, with names translated to those of CGA.
  void expression(std::size_t from, std::size_t to, TracedText& out);

 protected:
  ForeignText& source_;
  std::string text_;                  ///< without comments
  std::set<std::string> made_names_;  ///< to which tokens point
  std::vector<lang::Token> tokens_;
  std::vector<std::size_t> partner_;  ///< for an opening bracket: the index of its closing bracket
  TracedText declarations_;
  std::set<std::string, std::less<>> integers_;             ///< params and constants that are integers
  std::set<std::string, std::less<>> needed_, attributes_;  ///< functions and attributes that expressions use
  std::set<std::string, std::less<>> set_names_,
      declared_;  ///< attributes that set() makes; params and constants
};

}  // namespace seedmesh
