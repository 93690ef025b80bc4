#pragma once
/// Splits the text of modules and productions into slices, without interpreting them:
///
///   production = [ label ] [ new left "<<" ] [ left "<" ] predecessor [ ">" right ] [ ">>" new right ]
///                [ ":" [ before ] condition [ after ] ] arrow successor [ ":" weight ] ;
///   before     = "{" statements "}" ;               after = "{" statements "}" ;
///   arrow      = "->" | "-->" | "~>" | "→" ;      word = { module } ;
///   module     = symbol [ "(" expression { "," expression } ")" ] ;
///   symbol     = one character | "@" character | a longer name that is declared or belongs to the turtle ;
///   label      = "p" digit { digit } ":" as in "The Algorithmic Beauty of Plants" ;
///
/// White space separates tokens and has no other meaning. A successor that is empty, "*" or "ε" erases the module. New
/// contexts are matched against the word that is being written in this step.
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/lang/lexer.h"

namespace seedmesh::lsystem {

/// Bytes [from, to) of the text.
struct Slice {
  std::size_t from = 0, to = 0;
  bool empty() const { return from >= to; }
};

/// A module in the text.
struct WrittenModule {
  std::string_view symbol;
  std::size_t offset = 0;
  std::vector<Slice> arguments;
};

/// The parts of a production; absent parts are empty slices.
struct WrittenProduction {
  Slice new_left, left, predecessor, right, new_right, condition, successor, weight;
  Slice before, after;  ///< statements around the condition, without braces
  bool has_left = false, has_right = false, has_condition = false, has_weight = false;
};

/// A text with more modules is refused. Real grammars are far shorter, and compilation needs about 100 bytes
/// for each module.
constexpr std::size_t most_modules = 1'000'000;

/// The symbols of more than one character. At each position the longest match is read.
class Symbols {
 public:
  Symbols();  ///< starts with the turtle's symbols, such as @Di
  void declare(std::string_view name);
  bool knows(std::string_view name) const;
  /// Returns the number of bytes of the symbol at `at` in text[at, to), which is not empty. Returns 0 for a
  /// single "@". Cost: linear in the symbol.
  std::size_t length_at(std::string_view text, std::size_t at, std::size_t to) const;

 private:
  /// Node of a prefix tree; node 0 is the root.
  struct Node {
    std::vector<std::pair<char, std::uint32_t>> next;
    bool ends = false;                   ///< true where a symbol ends here
    std::uint32_t behind(char c) const;  ///< child for `c`; 0: there is none
  };
  std::uint32_t first(char c) const { return first_[static_cast<unsigned char>(c)]; }

  std::vector<Node> nodes_{1};
  std::array<std::uint32_t, 256> first_{};  ///< children of the root by byte; 0: there is none
};

/// Returns the modules of text[slice]. Errors: an argument list that is not closed, an empty argument,
/// characters that are not symbols. Reading stops after lang::max_errors + 1 errors. The error beyond
/// max_errors is not reported; it shows that the list is cut.
std::vector<WrittenModule> read_modules(std::string_view text, Slice slice, const Symbols& symbols,
                                        std::vector<lang::TextError>& errors);

/// Returns the position of the brace, bracket or parenthesis that closes the one at `open`, or `to`.
std::size_t closing(std::string_view text, std::size_t open, std::size_t to);

std::size_t skip_spaces(std::string_view text, std::size_t at, std::size_t to);

/// Returns the number of bytes of the label and its colon before a production. Returns 0 if there is no
/// label, or if `symbols` has a module of that name, which is then the predecessor.
std::size_t label_length(std::string_view text, const Symbols& symbols);

/// Splits the production in text[from, ...) at its arrow, context marks and colons. Errors: no arrow, no
/// predecessor, two contexts on the same side.
WrittenProduction read_production(std::string_view text, std::vector<lang::TextError>& errors,
                                  std::size_t from = 0);

/// Returns the position of an arrow outside parentheses in text[slice], or slice.to.
std::size_t find_second_arrow(std::string_view text, Slice slice);

/// An index of the brackets, semicolons and comparison operators of a text. It is built in one pass. closing() takes
/// constant time, and the other queries O(log n).
class Marks {
 public:
  Marks() = default;
  explicit Marks(std::string_view text);
  /// Same result as the function closing().
  std::size_t closing(std::size_t open, std::size_t to) const;
  bool has_semicolon(Slice slice) const { return has(semicolons_, slice); }
  bool has_condition_operator(Slice slice) const { return has(comparisons_, slice); }  ///< one of < > = ! & |

 private:
  static bool has(const std::vector<std::uint32_t>& positions, Slice slice);
  std::vector<std::uint32_t> partner_;  ///< index of the closing partner of an opening bracket, by byte
  std::vector<std::uint32_t> semicolons_, comparisons_;
};

/// Returns true where the slice is empty, or "*" or "ε" alone.
bool erases(std::string_view text, Slice slice);

}  // namespace seedmesh::lsystem
