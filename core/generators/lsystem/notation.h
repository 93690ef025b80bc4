#pragma once
/// The written form of modules and productions, taken apart but not yet understood:
///
///   production = [ new left "<<" ] [ left "<" ] predecessor [ ">" right ] [ ">>" new right ]
///                [ ":" [ before ] condition [ after ] ] arrow successor [ ":" weight ] ;
///   before     = "{" statements "}" ;               after = "{" statements "}" ;
///   arrow      = "->" | "-->" | "~>" | "→" ;      word = { module } ;
///   module     = symbol [ "(" expression { "," expression } ")" ] ;
///   symbol     = one character | "@" character | a longer name that is declared or the turtle's own ;
///   white space separates and means nothing else.
///
/// An empty successor, or one of "*" or "ε" alone, erases; so does an empty right side.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/lang/lexer.h"

namespace seedmesh::lsystem {

/// Bytes [from, to) of the text.
struct Slice {
  std::size_t from = 0, to = 0;
  bool empty() const { return from >= to; }
};

/// A module as written.
struct WrittenModule {
  std::string_view symbol;
  std::size_t offset = 0;
  std::vector<Slice> arguments;
};

/// A production cut into its parts; parts that are not there are empty slices.
struct WrittenProduction {
  Slice new_left, left, predecessor, right, new_right, condition, successor, weight;
  Slice before, after;  ///< statements round the condition, without their braces
  bool has_left = false, has_right = false, has_condition = false, has_weight = false;
};

/// A text longer than this is refused: what is written by hand or by a program for people is far shorter, and
/// a grammar costs about a hundred bytes a module while it is read.
constexpr std::size_t most_modules = 1'000'000;

/// The symbols of more than one character. The longest that stands at a place is read there.
class Symbols {
 public:
  Symbols();  ///< those of the turtle, such as @Di
  void declare(std::string_view name);
  /// Bytes of the symbol at text[at, to), which is not empty; 0 for an "@" alone.
  std::size_t length_at(std::string_view text, std::size_t at, std::size_t to) const;

 private:
  std::vector<std::string> names_;  ///< longest first
  bool begins_[256] = {};           ///< by first byte: some name begins so
};

/// The modules of text[slice]. Faults: an argument list that is not closed, an empty argument, characters
/// that are no symbol.
std::vector<WrittenModule> read_modules(std::string_view text, Slice slice, const Symbols& symbols,
                                        std::vector<lang::Fault>& faults);

/// The brace, bracket or parenthesis that closes the one at `open`, before `to`; `to` where none does.
std::size_t closing(std::string_view text, std::size_t open, std::size_t to);

std::size_t skip_spaces(std::string_view text, std::size_t at, std::size_t to);

/// Cuts a production at its arrow, context marks and colons. Faults: no arrow, no predecessor, two contexts
/// of one side.
WrittenProduction read_production(std::string_view text, std::vector<lang::Fault>& faults);

/// True when the slice holds nothing, or "*" or "ε" alone.
bool erases(std::string_view text, Slice slice);

}  // namespace seedmesh::lsystem
