#pragma once
/// The written form of modules and productions, taken apart but not yet understood:
///
///   production = [ new left "<<" ] [ left "<" ] predecessor [ ">" right ] [ ">>" new right ]
///                [ ":" [ before ] condition [ after ] ] arrow successor [ ":" weight ] ;
///   before     = "{" statements "}" ;               after = "{" statements "}" ;
///   arrow      = "->" | "-->" | "~>" | "→" ;      word = { module } ;
///   module     = symbol [ "(" expression { "," expression } ")" ] ;
///   symbol     = one character | "@" character | a longer name that is declared or the turtle's own ;
///   label      = "p" digit { digit } ":" before a production, as the book prints it ;
///   white space separates and means nothing else.
///
/// An empty successor, or one of "*" or "ε" alone, erases; so does an empty right side.
#include <array>
#include <cstdint>
#include <string>
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
  bool knows(std::string_view name) const;
  /// Bytes of the symbol at text[at, to), which is not empty; 0 for an "@" alone. Cost: what of the text
  /// begins a name.
  std::size_t length_at(std::string_view text, std::size_t at, std::size_t to) const;

 private:
  /// What a name may go on with; node 0 is where all begin.
  struct Node {
    std::vector<std::pair<char, std::uint32_t>> next;
    bool ends = false;                   ///< a name
    std::uint32_t behind(char c) const;  ///< 0: none
  };
  std::uint32_t first(char c) const { return first_[static_cast<unsigned char>(c)]; }

  std::vector<Node> nodes_{1};
  std::array<std::uint32_t, 256> first_{};  ///< of node 0, by byte; 0: none
};

/// The modules of text[slice]. Faults: an argument list that is not closed, an empty argument, characters
/// that are no symbol; no more of them than one text may have (lang::has_room).
std::vector<WrittenModule> read_modules(std::string_view text, Slice slice, const Symbols& symbols,
                                        std::vector<lang::Fault>& faults);

/// The brace, bracket or parenthesis that closes the one at `open`, before `to`; `to` where none does.
std::size_t closing(std::string_view text, std::size_t open, std::size_t to);

std::size_t skip_spaces(std::string_view text, std::size_t at, std::size_t to);

/// Bytes of the label with its colon before a production; 0 where there is none, or where `symbols` has a
/// module of that name.
std::size_t label_length(std::string_view text, const Symbols& symbols);

/// Cuts the production in text[from, ...) at its arrow, context marks and colons. Faults: no arrow, no
/// predecessor, two contexts of one side.
WrittenProduction read_production(std::string_view text, std::vector<lang::Fault>& faults,
                                  std::size_t from = 0);

/// Where an arrow stands outside parentheses in text[slice]; slice.to where none does.
std::size_t find_second_arrow(std::string_view text, Slice slice);

/// What a reader of statements asks of a text again and again, worked out in one walk.
class Marks {
 public:
  Marks() = default;
  explicit Marks(std::string_view text);
  /// As closing(), at once.
  std::size_t closing(std::size_t open, std::size_t to) const;
  bool has_semicolon(Slice slice) const { return has(semicolons_, slice); }
  bool has_comparison(Slice slice) const { return has(comparisons_, slice); }  ///< one of < > = ! & |

 private:
  static bool has(const std::vector<std::uint32_t>& places, Slice slice);
  std::vector<std::uint32_t> partner_;  ///< by byte: of an opening bracket what closes it
  std::vector<std::uint32_t> semicolons_, comparisons_;
};

/// True when the slice holds nothing, or "*" or "ε" alone.
bool erases(std::string_view text, Slice slice);

}  // namespace seedmesh::lsystem
