#include "core/generators/lsystem/word.h"

#include <algorithm>

#include "core/generators/lsystem/code.h"
#include "core/generators/lsystem/contexts.h"
#include "core/generators/lsystem/table.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t look_every = 4096;

/// Appends modules to a word whose length is bounded.
class Writer {
 public:
  Writer(const Grammar& grammar, bool keyed, CodeRunner& code, Job& job)
      : word(job),
        grammar_(grammar),
        code_(code),
        job_(job),
        parameters_(grammar.widest > 0),
        keyed_(keyed),
        decomposes_(!grammar.decomposition.productions.empty()),
        limit_(job.limits().modules) {}

  /// Room for a module: gives the place of its parameters.
  double* add(KindId kind, std::uint64_t key, std::uint32_t step) {
    if (word.size() >= limit_)
      Job::refuse("needs more than " + std::to_string(limit_) + " modules, which is the limit, in step " +
                  std::to_string(step));
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

  /// Writes the axiom.
  void write(Range successor, std::uint64_t key) {
    for (const Template& each : grammar_.successor(successor)) {
      place(each, nullptr, keyed_ ? child_key(key, each) : 0, 0, 0);
    }
  }

  /// Writes what `production` makes of a module of key `parent`. `slots` has room for the locals.
  void write(const Production& production, double* slots, std::uint64_t parent, std::uint32_t step,
             std::uint32_t depth = 0) {
    if (production.code.count == 0) {
      for (const Template& each : grammar_.successor(production.successor)) {
        place(each, slots, keyed_ ? child_key(parent, each) : 0, step, depth);
      }
      return;
    }
    // The word's step tells the draws of one rewriting from those of the next.
    code_.run(production.code, slots, Draws(parent, step).code(),
              [&](const Template& each, std::uint64_t turn) {
                place(each, slots, keyed_ ? code_key(parent, each, turn) : 0, step, depth);
              });
  }

  Word word;

 private:
  void place(const Template& each, const double* slots, std::uint64_t key, std::uint32_t step,
             std::uint32_t depth) {
    if (decomposes_ && depth < grammar_.decomposition_depth && grammar_.decomposition.rewrites(each.kind)) {
      return decompose(each, slots, key, step, depth);
    }
    fill_arguments(grammar_, each, slots, key, add(each.kind, key, step));
  }

  /// A stream of its own, so that a rule that is added draws nothing from those of the derivation.
  void decompose(const Template& each, const double* slots, std::uint64_t key, std::uint32_t step,
                 std::uint32_t depth) {
    if ((++decomposed_ & 4095U) == 0) job_.check();
    if (decomposed_ > 4 * limit_)
      Job::refuse("decomposes more than " + std::to_string(decomposed_ - 1) + " modules in step " +
                  std::to_string(step) + "; four times the limit of modules is the most");
    const Rules& rules = grammar_.decomposition;
    std::vector<double> own(grammar_.most_slots + most_parameters);
    fill_arguments(grammar_, each, slots, key, own.data());
    const std::uint64_t stream = keyed_ ? key_at(key, 40 + depth) : 0;
    const Draws draws(stream, depth);
    const Production* chosen =
        choose(grammar_, rules, rules.of_kind[each.kind], draws,
               [&](const Production& rule) { return prepare(rule, own.data(), draws); });
    if (chosen) {
      if (chosen->weighted) prepare(*chosen, own.data(), draws);
      return write(*chosen, own.data(), stream, step, depth + 1);
    }
    double* parameters = add(each.kind, key, step);
    std::copy(own.data(), own.data() + grammar_.kinds[each.kind].arity, parameters);
  }

 public:
  /// Runs what a production does before its condition.
  double* prepare(const Production& production, double* slots, const Draws& draws) {
    if (slots && production.before.count > 0) {
      code_.run(production.before, slots, draws.place.at(5), [](const Template&, std::uint64_t) {});
    }
    return slots;
  }

 private:
  static constexpr std::size_t most_parameters = 64;  // of a kind, whether a production knows it or not
  const Grammar& grammar_;
  CodeRunner& code_;
  Job& job_;
  bool parameters_, keyed_, decomposes_;
  std::uint64_t limit_;
  std::uint64_t decomposed_ = 0;
};

/// One step of a derivation.
class Rewriting {
 public:
  Rewriting(const Grammar& grammar, const Word& in, std::uint32_t step, bool keyed, CodeRunner& code,
            Job& job)
      : grammar_(grammar),
        in_(in),
        step_(step),
        keyed_(keyed),
        job_(job),
        rules_(grammar.rules_at(step)),
        writer_(grammar, keyed, code, job),
        partner_(job),
        contexts_(grammar, in, partner_, writer_.word, pieces_, job) {}

  Word run() {
    pair_brackets(grammar_, in_, partner_);
    contexts_.set_partner(partner_);
    if (grammar_.backward) return run_backward();
    int cut_depth = 0;  // brackets open inside the part that is cut away, plus one; 0: nothing is cut
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (i % look_every == 0) job_.check();
      if (!is_cut(i, cut_depth)) rewrite(i);
    }
    return std::move(writer_.word);
  }

 private:
  bool is_cut(std::size_t i, int& cut_depth) const {
    const KindId kind = in_.kind[i];
    if (kind == grammar_.cut) cut_depth = std::max(cut_depth, 1);
    if (cut_depth == 0) return false;
    if (kind == grammar_.open) ++cut_depth;
    return kind != grammar_.close || --cut_depth > 0;
  }

  void rewrite(std::size_t i) {
    const KindId kind = in_.kind[i];
    if (!rules_.rewrites(kind)) return writer_.copy(in_, i);
    const std::uint64_t key = keyed_ ? in_.key[i] : 0;
    const Draws draws(key, step_);
    double* slots = nullptr;
    const auto match = [&](const Production& each) {
      return slots = writer_.prepare(each, contexts_.match(each, i), draws);
    };
    const Production* chosen = choose(grammar_, rules_, rules_.of_kind[kind], draws, match);
    if (!chosen) return writer_.copy(in_, i);
    if (chosen->weighted) match(*chosen);  // others were tried after it
    writer_.write(*chosen, slots, key, step_ + 1);
  }

  /// From the last module to the first; what each becomes stays in its own order.
  Word run_backward() {
    Array<std::uint8_t> cut(job_, in_.size(), 0);
    if (grammar_.cuts) {
      int cut_depth = 0;
      for (std::size_t i = 0; i < in_.size(); ++i) cut[i] = is_cut(i, cut_depth) ? 1 : 0;
    }
    for (std::size_t i = in_.size(); i-- > 0;) {
      if (i % look_every == 0) job_.check();
      if (cut[i] != 0) continue;
      const std::size_t begin = writer_.word.size();
      rewrite(i);
      if (writer_.word.size() > begin) pieces_.push_back(begin);
    }
    return turned_round();
  }

  Word turned_round() {
    const Word& written = writer_.word;
    Word word(job_);
    const bool parameters = grammar_.widest > 0;
    std::size_t end = written.size();
    for (std::size_t piece = pieces_.size(); piece-- > 0;) {
      for (std::size_t i = pieces_[piece]; i < end; ++i) {
        const KindId kind = written.kind[i];
        word.kind.push_back(kind);
        word.born.push_back(written.born[i]);
        if (keyed_) word.key.push_back(written.key[i]);
        if (!parameters) continue;
        word.at.push_back(static_cast<std::uint32_t>(word.parameter.size()));
        word.parameter.append({written.parameter.data() + written.at[i], grammar_.kinds[kind].arity});
      }
      end = pieces_[piece];
    }
    return word;
  }

  const Grammar& grammar_;
  const Word& in_;
  std::uint32_t step_;
  bool keyed_;
  Job& job_;
  const Rules& rules_;
  Writer writer_;
  Array<std::uint32_t> partner_;
  std::vector<std::size_t> pieces_;  ///< where the successor of each module begins, when written backward
  ContextMatcher contexts_;
};

}  // namespace

Derivation::Derivation(const Grammar& grammar, bool keyed, Job& job)
    : word(job), grammar_(grammar), keyed_(keyed), job_(job), code_(grammar, job) {
  Writer axiom(grammar, keyed, code_, job);
  axiom.write(grammar.axiom, job.rng().key());
  word = std::move(axiom.word);
}

void Derivation::step() { word = Rewriting(grammar_, word, step_++, keyed_, code_, job_).run(); }

Word derive_word(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job) {
  if (!keyed && TableRewriter::fits(grammar)) return TableRewriter(grammar, job).derive(steps);
  Derivation derivation(grammar, keyed, job);
  for (std::uint32_t step = 0; step < steps; ++step) derivation.step();
  job.spend(Resource::modules, derivation.word.size());
  return std::move(derivation.word);
}

}  // namespace seedmesh::lsystem
