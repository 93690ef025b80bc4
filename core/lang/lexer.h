#pragma once
/// Text -> tokens with byte offsets, for every notation of the project.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh::lang {

enum class TokenKind { number, name, string, symbol, end };

/// A piece of the text. `symbol` is one operator or bracket: the longest of == != <= >= && || -> --> ~> << >> and single
/// characters. The arrows → and ⟶ come as "->".
struct Token {
  TokenKind kind = TokenKind::end;
  std::string_view text;   ///< points into the source, except arrows
  std::size_t offset = 0;  ///< byte in the source
  std::size_t length = 0;  ///< bytes in the source
  double number = 0;       ///< for TokenKind::number: the correctly rounded value
};

/// A fault in a text: where, and one sentence of what was found and what was expected.
struct Fault {
  std::size_t offset = 0;
  std::string message;
};

/// Tokens of text[from, to), ended by one TokenKind::end whose offset is `to`. White space separates. Unknown characters and
/// numbers out of range add a Fault and are left out. Cost: linear.
std::vector<Token> tokenize(std::string_view text, std::size_t from, std::size_t to, std::vector<Fault>& faults);

}  // namespace seedmesh::lang
