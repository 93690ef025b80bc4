#pragma once
/// Text -> tokens with byte offsets, for every notation of the project.
///
///   number   12   1.5   .5   5.   1e3   1e-3      (no sign; `1e` is the number 1 and the name e)
///   name     [A-Za-z_][A-Za-z0-9_]*
///   string   "..." on one line, with the escapes \" \\ \n \t
///   symbol   the longest of == != <= >= && || -> --> ~> << >>, else any one of the other ASCII signs
///
/// White space (the no-break space too) separates and is otherwise without meaning. There are no comments
/// here.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh::lang {

enum class TokenKind { number, name, string, symbol, end };

/// A piece of the text. The arrows → and ⟶ come as "->"; --> and ~> stay what they are.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;   ///< points into the source, except arrows; of a string what is between the quotes
  std::size_t offset = 0;  ///< byte in the source
  std::size_t length = 0;  ///< bytes in the source
  double number = 0;       ///< for TokenKind::number: the correctly rounded value
};

/// A fault in a text: where, and one sentence of what was found and what was expected.
struct Fault {
  std::size_t offset = 0;
  std::string message;
};

/// More tokens than this in one call are a Fault: it bounds the memory that a hostile text can take.
constexpr std::size_t max_tokens = 1'000'000;

/// One call adds at most this many faults, the last of which says that the rest was not read.
constexpr std::size_t max_faults = 100;

/// Tokens of text[from, to), ended by one TokenKind::end whose offset is `to`. Requires from <= to <=
/// text.size(). Unknown characters add a Fault and are left out; a number beyond the range of double adds a
/// Fault and comes as 0. Cost: linear; 48 bytes a token.
std::vector<Token> tokenize(std::string_view text, std::size_t from, std::size_t to,
                            std::vector<Fault>& faults);

/// True for the symbol `text`.
inline bool is_symbol(const Token& token, std::string_view text) {
  return token.kind == TokenKind::symbol && token.text == text;
}

/// What a message calls the token: `x` in backquotes, cut where it is long, or "the end".
std::string in_quotes(const Token& token);
std::string in_quotes(std::string_view text);

/// The characters a string token stands for, its escapes resolved.
std::string string_value(const Token& token);

}  // namespace seedmesh::lang
