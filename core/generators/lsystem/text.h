#pragma once
/// Formats words as text: symbols without spaces, parameters with six significant digits: A(1,2.5)[+F].
#include <string>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

/// Appends modules to a text until it has `most` bytes, and counts all modules.
class TextWriter {
 public:
  TextWriter(const Grammar& grammar, std::size_t most)
      : grammar_(grammar), most_(most), counts_(grammar.kinds.size()) {}
  void module(KindId kind, const double* parameters);

  std::string text;
  bool truncated = false;
  /// Numbers of modules, indexed by kind.
  const std::vector<std::uint64_t>& counts() const { return counts_; }

 private:
  const Grammar& grammar_;
  std::size_t most_;
  std::vector<std::uint64_t> counts_;
};

/// Returns true for systems without parameters, random choices, conditions, contexts and cuts: D0L systems.
bool is_plain(const Grammar& grammar);

/// Returns the word of a D0L system as text, truncated between modules at `most` bytes. The derivation of a
/// symbol over n steps is written once and then copied. Cost: linear in the text.
Array<char> plain_text(const Grammar& grammar, std::uint32_t steps, std::size_t most, const Job& job);

}  // namespace seedmesh::lsystem
