#pragma once
/// Derives whole words, for systems with contexts. A word is a set of flat arrays: kinds, parameters, and
/// optional keys and birth steps.
#include "core/base/array.h"
#include "core/generators/lsystem/code.h"
#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

struct Word {
  Array<KindId> kind;
  Array<std::uint32_t> at;  ///< first parameter of each module; empty where no kind has parameters
  Array<double> parameter;
  Array<std::uint64_t> key;       ///< empty without keys
  Array<std::uint16_t> born;      ///< derivation step that wrote the module
  std::vector<double> variables;  ///< Grammar::variables after the step that wrote the word
  explicit Word(const Job& job) : kind(job), at(job), parameter(job), key(job), born(job) {}
  std::size_t size() const { return kind.size(); }
};

/// A derivation whose word can be read and changed between steps. Each step runs Grammar::start_each, rewrites the
/// word from left to right, and runs Grammar::end_each. All productions share the variables. A value that a
/// production sets is visible in the same step, to modules on the right of the rewritten one.
class Derivation {
 public:
  Derivation(const Grammar& grammar, bool keyed, Job& job);
  void step();

  Word word;

 private:
  const Grammar& grammar_;
  bool keyed_;
  Job& job_;
  void run(Range statements, std::uint64_t stream);

  CodeRunner code_;
  std::vector<double> slots_;  ///< slots of statements between steps; the variables are the first
  std::uint32_t step_ = 0;
};

/// Returns the word after `steps` steps from the axiom. Refuses a word longer than limits.modules before it
/// is stored. After the axiom and each step, decomposition rules are applied to what was written, at most
/// Grammar::decomposition_depth times; their output belongs to the same step. Contexts follow Prusinkiewicz
/// and Lindenmayer 1990, section 1.8. A left context is searched toward the root, across [ and without
/// sibling branches. A right context skips branches that it does not name, and never extends beyond ]; a [ ]
/// group in it matches the start of a branch. Cost: linear in the sum of the lengths of all words. Plain
/// symbols with contexts of one symbol use table.h.
Word derive_word(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job);

}  // namespace seedmesh::lsystem
