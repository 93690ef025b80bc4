#pragma once
/// The lexer of every notation of the project: text to tokens with byte offsets.
///
///   number   12   1.5   .5   5.   1e3   1e-3      (no sign; `1e` is the number 1 and the name e)
///   name     [A-Za-z_][A-Za-z0-9_]*
///   string   "..." on one line, with the escapes \" \\ \n \t \u0041
///   symbol   the longest of == != <= >= && || -> --> ~> << >>, else any one of the other ASCII signs
///
/// White space, the no-break space included, only separates tokens. There are no comments.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace seedmesh::lang {

enum class TokenKind { number, name, string, symbol, end };

/// A token. The arrows → and ⟶ become "->"; --> and ~> stay as they are.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;   ///< part of the source, except for arrows; of a string, without its quotes
  std::size_t offset = 0;  ///< byte in the source
  std::size_t length = 0;  ///< bytes in the source
  /// Of TokenKind::number: the correctly rounded value. Of TokenKind::string: 0, or its number in a table of
  /// texts (TaggedValue), which the caller writes there if its expressions may have texts.
  double number = 0;
};

/// An error in a text: its byte offset, and what was found and what was expected.
struct TextError {
  std::size_t offset = 0;
  std::string message;
  IssueKind kind = IssueKind::syntax;
};

/// The most tokens of one call, which bounds the memory that a hostile text can take.
constexpr std::size_t max_tokens = 1'000'000;

/// The most errors that one call adds. The last of them states that the rest of the text was not read.
constexpr std::size_t max_errors = 100;

/// The tokens of text[from, to), followed by one TokenKind::end at offset `to`. Requires from <= to <= text.size().
/// An unknown character adds an error and no token. A number beyond the range of a double adds an error and has the
/// value 0. Cost: linear; 48 bytes for each token.
std::vector<Token> tokenize(std::string_view text, std::size_t from, std::size_t to,
                            std::vector<TextError>& errors);

/// Whether the token is the symbol `text`.
inline bool is_symbol(const Token& token, std::string_view text) {
  return token.kind == TokenKind::symbol && token.text == text;
}

/// Returns the token as a message names it: `x` in backquotes, shortened to 40 bytes, or "the end".
std::string in_quotes(const Token& token);
std::string in_quotes(std::string_view text);

/// Returns the value of a string token, with its escapes resolved.
std::string string_value(const Token& token);

}  // namespace seedmesh::lang
