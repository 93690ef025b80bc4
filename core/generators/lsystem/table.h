#pragma once
/// Fast derivation of words of plain symbols (no parameters, no chance) whose productions look at most at one
/// neighbour on each side: what happens to a symbol is looked up by (left neighbour, symbol, right
/// neighbour). Two passes a step over one byte a symbol.
#include <vector>

#include "core/generators/lsystem/word.h"

namespace seedmesh::lsystem {

class TableRewriter {
 public:
  /// True when the grammar is of this sort.
  static bool fits(const Grammar& grammar);

  TableRewriter(const Grammar& grammar, Job& job);
  Word derive(std::uint32_t steps);

  /// One step on plain bytes, kinds as values: what derive() repeats, and what the bench times.
  void step(const Array<std::uint8_t>& in, Array<std::uint8_t>& out);
  Array<std::uint8_t> axiom() const;

 private:
  struct Entry {
    std::uint32_t first = 0;
    std::uint32_t length = 0;
  };
  /// What a symbol means to its neighbours.
  enum class Role : std::uint8_t { neighbour, ignored, open, close };

  void fill(const Production& production, KindId kind);
  void find_right_neighbours(const Array<std::uint8_t>& in);
  template <class RightOf>
  void rewrite(const Array<std::uint8_t>& in, Array<std::uint8_t>& out, RightOf&& right_of);
  std::size_t place(std::size_t left, std::size_t kind, std::size_t right) const {
    return (left << (2 * bits_)) | (kind << bits_) | right;
  }

  const Grammar& grammar_;
  Job& job_;
  std::size_t kinds_;  ///< also stands for "no neighbour"
  unsigned bits_;      ///< of a number up to kinds_
  bool row_ = true;    ///< all symbols in use are neighbours to each other: no brackets, none ignored
  std::size_t longest_ = 1;
  std::vector<Entry> table_;
  std::vector<std::uint8_t> successors_;  ///< padded, so that eight bytes may always be copied
  std::vector<Role> role_;
  Array<std::uint8_t> right_;
  std::vector<std::uint8_t> stack_;
};

}  // namespace seedmesh::lsystem
