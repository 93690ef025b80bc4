#pragma once
/// Fast derivation for systems of at most 96 kinds without parameters, random choices, conditions, variables,
/// statements and tables. Contexts have at most one symbol on each side. A table maps (left neighbour,
/// symbol, right neighbour) to the successor. Cost: two passes over one byte for each symbol and step.
#include <vector>

#include "core/generators/lsystem/word.h"

namespace seedmesh::lsystem {

class TableRewriter {
 public:
  /// Returns true where the grammar has this form.
  static bool fits(const Grammar& grammar);

  TableRewriter(const Grammar& grammar, Job& job);
  Word derive(std::uint32_t steps);

  /// Derives one step; the bytes are kinds. derive() repeats it, and the benchmark times it.
  void step(const Array<std::uint8_t>& in, Array<std::uint8_t>& out);
  Array<std::uint8_t> axiom() const;

 private:
  struct Entry {
    std::uint32_t first = 0;
    std::uint32_t length = 0;
  };
  /// Role of a symbol in the contexts of its neighbours.
  enum class Role : std::uint8_t { neighbour, ignored, open, close };

  void fill(const Production& production, KindId kind);
  void find_right_neighbours(const Array<std::uint8_t>& in);
  template <class RightOf>
  void rewrite(const Array<std::uint8_t>& in, Array<std::uint8_t>& out, RightOf&& right_of);
  std::size_t entry_index(std::size_t left, std::size_t kind, std::size_t right) const {
    return (left << (2 * bits_)) | (kind << bits_) | right;
  }

  const Grammar& grammar_;
  Job& job_;
  std::size_t kinds_;  ///< also the value of "no neighbour"
  unsigned bits_;      ///< bits of a number up to kinds_
  bool row_ = true;    ///< true where no brackets or ignored symbols are in use
  std::size_t longest_ = 1;
  std::vector<Entry> table_;
  std::vector<std::uint8_t> successors_;  ///< padded, so that a copy of eight bytes stays inside
  std::vector<Role> role_;
  Array<std::uint8_t> right_;
  std::vector<std::uint8_t> stack_;
};

}  // namespace seedmesh::lsystem
