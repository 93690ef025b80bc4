#pragma once
/// Derivation of whole words, for systems whose productions look at their neighbours. Flat arrays: one row of
/// kinds, one of parameters, and keys and birth steps where somebody needs them.
#include "core/base/array.h"
#include "core/generators/lsystem/code.h"
#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

struct Word {
  Array<KindId> kind;
  Array<std::uint32_t> at;  ///< by module: where its parameters start; empty when no kind has parameters
  Array<double> parameter;
  Array<std::uint64_t> key;   ///< empty unless keyed
  Array<std::uint16_t> born;  ///< step that wrote the module
  explicit Word(const Job& job) : kind(job), at(job), parameter(job), key(job), born(job) {}
  std::size_t size() const { return kind.size(); }
};

/// A derivation that is looked at, or written into, between its steps.
class Derivation {
 public:
  Derivation(const Grammar& grammar, bool keyed, Job& job);
  void step();

  Word word;

 private:
  const Grammar& grammar_;
  bool keyed_;
  Job& job_;
  CodeRunner code_;
  std::uint32_t step_ = 0;
};

/// The word after `steps` steps from the axiom. Refuses a word longer than limits.modules before it is
/// stored. After each step, and after the axiom, decomposition rules are used on what was written, and on
/// what they write, as deep as Grammar::decomposition_depth; what they write belongs to the same step.
/// Contexts follow the book: a left context leads up through [ past sibling branches; a right context passes
/// branches it does not name and never leaves through ]; a [ ] group in it matches the beginning of a branch.
/// Cost: linear in the sum of the words' lengths; systems of plain symbols with contexts of one symbol run
/// from a table.
Word derive_word(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job);

}  // namespace seedmesh::lsystem
