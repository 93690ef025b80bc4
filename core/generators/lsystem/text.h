#pragma once
/// Words as text: symbols without spaces, parameters with six significant digits: A(1,2.5)[+F].
#include <string>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

/// Appends modules to a text until it has `most` bytes, and counts them all.
class TextWriter {
 public:
  TextWriter(const Grammar& grammar, std::size_t most)
      : grammar_(grammar), most_(most), counts_(grammar.kinds.size()) {}
  void module(KindId kind, const double* parameters);

  std::string text;
  bool truncated = false;
  const std::vector<std::uint64_t>& counts() const { return counts_; }  ///< by kind

 private:
  const Grammar& grammar_;
  std::size_t most_;
  std::vector<std::uint64_t> counts_;
};

/// True for systems without parameters, chance, conditions, contexts and cuts: D0L systems.
bool is_plain(const Grammar& grammar);

/// The word of a D0L system as text, cut at `most` bytes between modules. What a symbol becomes in n steps is
/// written once and copied wherever the symbol stands again, so that the cost is that of copying the text.
Array<char> plain_text(const Grammar& grammar, std::uint32_t steps, std::size_t most, const Job& job);

}  // namespace seedmesh::lsystem
