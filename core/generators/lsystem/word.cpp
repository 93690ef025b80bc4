#include "core/generators/lsystem/word.h"

#include <algorithm>

#include "core/generators/lsystem/choose.h"
#include "core/generators/lsystem/contexts.h"
#include "core/generators/lsystem/table.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t look_every = 4096;

/// Appends modules to a word whose length is bounded.
class Writer {
 public:
  Writer(const Grammar& grammar, bool keyed, Job& job)
      : word(job),
        grammar_(grammar),
        parameters_(grammar.widest > 0),
        keyed_(keyed),
        limit_(job.limits().modules) {}

  /// Room for a module: gives the place of its parameters.
  double* add(KindId kind, std::uint64_t key, std::uint32_t step) {
    if (word.size() >= limit_)
      Job::refuse("needs more than " + std::to_string(limit_) + " modules, which is the limit");
    word.kind.push_back(kind);
    word.born.push_back(static_cast<std::uint16_t>(step));
    if (keyed_) word.key.push_back(key);
    if (!parameters_) return nullptr;
    word.at.push_back(static_cast<std::uint32_t>(word.parameter.size()));
    return word.parameter.extend(grammar_.kinds[kind].arity);
  }

  void copy(const Word& from, std::size_t place) {
    const KindId kind = from.kind[place];
    double* parameters = add(kind, keyed_ ? from.key[place] : 0, from.born[place]);
    for (std::uint32_t i = 0; i < grammar_.kinds[kind].arity; ++i)
      parameters[i] = from.parameter[from.at[place] + i];
  }

  void write(Range successor, const double* slots, std::uint64_t parent, std::uint32_t step) {
    for (const Template& each : grammar_.successor(successor)) {
      const std::uint64_t key = keyed_ ? child_key(parent, each) : 0;
      fill_arguments(grammar_, each, slots, key, add(each.kind, key, step));
    }
  }

  Word word;

 private:
  const Grammar& grammar_;
  bool parameters_, keyed_;
  std::uint64_t limit_;
};

Word rewrite(const Grammar& grammar, const Word& in, std::uint32_t step, bool keyed, Job& job) {
  Writer writer(grammar, keyed, job);
  Array<std::uint32_t> partner(job);
  pair_brackets(grammar, in, partner);
  ContextMatcher contexts(grammar, in, partner);
  const Rules& rules = grammar.productions;
  int cut_depth = 0;  // brackets open inside the part that is cut away, plus one; 0: nothing is cut
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (i % look_every == 0) job.check();
    const KindId kind = in.kind[i];
    if (kind == grammar.cut) cut_depth = std::max(cut_depth, 1);
    if (cut_depth > 0) {
      if (kind == grammar.open) ++cut_depth;
      if (kind != grammar.close || --cut_depth > 0) continue;
    }
    const std::uint64_t key = keyed ? in.key[i] : 0;
    const Production* chosen = nullptr;
    const double* slots = nullptr;
    if (rules.rewrites(kind)) {
      chosen = choose(grammar, rules, rules.of_kind[kind], Draws(key, step),
                      [&](const Production& each) { return slots = contexts.match(each, i); });
    }
    if (!chosen) {
      writer.copy(in, i);
      continue;
    }
    if (chosen->weighted) slots = contexts.match(*chosen, i);  // others were tried after it
    writer.write(chosen->successor, slots, key, step + 1);
  }
  return std::move(writer.word);
}

}  // namespace

Derivation::Derivation(const Grammar& grammar, bool keyed, Job& job)
    : word(job), grammar_(grammar), keyed_(keyed), job_(job) {
  Writer axiom(grammar, keyed, job);
  axiom.write(grammar.axiom, nullptr, job.rng().key(), 0);
  word = std::move(axiom.word);
}

void Derivation::step() { word = rewrite(grammar_, word, step_++, keyed_, job_); }

Word derive_word(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job) {
  if (!keyed && TableRewriter::fits(grammar)) return TableRewriter(grammar, job).derive(steps);
  Derivation derivation(grammar, keyed, job);
  for (std::uint32_t step = 0; step < steps; ++step) derivation.step();
  job.spend(Resource::modules, derivation.word.size());
  return std::move(derivation.word);
}

}  // namespace seedmesh::lsystem
