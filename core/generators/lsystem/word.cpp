#include "core/generators/lsystem/word.h"

#include <algorithm>

#include "core/generators/lsystem/code.h"
#include "core/generators/lsystem/contexts.h"
#include "core/generators/lsystem/table.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t check_interval = 4096;

/// Appends modules to a word of bounded length.
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

  /// Appends a module and returns the position of its parameters.
  double* add(KindId kind, std::uint64_t key, std::uint32_t step) {
    if (word.size() >= limit_) {
      job_.refuse(limit_issue({Resource::modules, limit_, limit_ + 1},
                              "step " + std::to_string(step) + " needs more than " + std::to_string(limit_) +
                                  " modules, which is the limit"));
    }
    word.kind.push_back(kind);
    word.born.push_back(static_cast<std::uint16_t>(step));
    if (keyed_) word.key.push_back(key);
    if (!parameters_) return nullptr;
    word.at.push_back(static_cast<std::uint32_t>(word.parameter.size()));
    return word.parameter.extend(grammar_.kinds[kind].arity);
  }

  void copy(const Word& from, std::size_t position) {
    const KindId kind = from.kind[position];
    double* parameters = add(kind, keyed_ ? from.key[position] : 0, from.born[position]);
    for (std::uint32_t i = 0; i < grammar_.kinds[kind].arity; ++i)
      parameters[i] = from.parameter[from.at[position] + i];
  }

  /// Appends the axiom. `slots` are the variables.
  void write(Range successor, std::uint64_t key, double* slots) {
    for (const Template& each : grammar_.successor(successor)) {
      add_template(each, slots, keyed_ ? child_key(key, each) : 0, 0);
    }
  }

  /// Appends the successor of `production` for a module with key `parent`. `slots` includes the locals and is
  /// changed.
  void write(const Production& production, double* slots, std::uint64_t parent, std::uint32_t step) {
    if (production.code.count == 0) {
      for (const Template& each : grammar_.successor(production.successor)) {
        add_template(each, slots, keyed_ ? child_key(parent, each) : 0, step);
      }
      return;
    }
    // The step separates the random numbers of successive rewritings.
    code_.run(production.code, slots, RewriteStreams(parent, step).code(),
              [&](const Template& each, std::uint64_t turn) {
                add_template(each, slots, keyed_ ? code_key(parent, each, turn) : 0, step);
              });
  }

  Word word;

 private:
  void add_template(const Template& each, double* slots, std::uint64_t key, std::uint32_t step) {
    if (decomposes_ && grammar_.decomposition.rewrites(each.kind))
      return decompose(each, slots, key, step, 0);
    fill_arguments(grammar_, each, slots, key, add(each.kind, key, step), job_);
  }

  /// A module that decomposition rules have written and may rewrite again.
  struct Pending {
    KindId kind = 0;
    std::uint32_t depth = 0;
    std::uint64_t key = 0;
    std::size_t first = 0;  ///< index of its first parameter in `values_`
  };

  void push(const Template& each, const double* slots, std::uint64_t key, std::uint32_t depth,
            std::vector<Pending>& list, std::vector<double>& values) {
    const std::size_t first = values.size();
    values.resize(first + grammar_.kinds[each.kind].arity);
    fill_arguments(grammar_, each, slots, key, values.data() + first, job_);
    list.push_back({each.kind, depth, key, first});
    if (list.size() > limit_) {
      job_.refuse(limit_issue({Resource::modules, limit_, limit_ + 1},
                              "a decomposition needs more than " + std::to_string(limit_) + " modules"));
    }
  }

  /// Decomposes a module and what comes of it, the leftmost first, without recursion. Decomposition has a separate
  /// random stream, so that adding a rule does not change the derivation. `slots` begin with the variables, which the
  /// rules may change.
  void decompose(const Template& each, double* slots, std::uint64_t key, std::uint32_t step,
                 std::uint32_t depth) {
    const std::size_t shared = grammar_.variables.size();
    const std::size_t base = pending_.size();
    push(each, slots, key, depth, pending_, values_);
    std::vector<double> own(grammar_.most_slots + shared + most_parameters);
    while (pending_.size() > base) {
      const Pending module = pending_.back();
      pending_.pop_back();
      const std::uint32_t arity = grammar_.kinds[module.kind].arity;
      std::copy_n(slots, shared, own.data());
      std::copy_n(values_.data() + module.first, arity, own.data() + shared);
      values_.resize(module.first);
      if (module.depth < grammar_.decomposition_depth && grammar_.decomposition.rewrites(module.kind) &&
          split(module, own, step)) {
        std::copy_n(own.data(), shared, slots);
        continue;
      }
      std::copy_n(own.data(), shared, slots);
      double* parameters = add(module.kind, module.key, step);
      if (arity > 0) std::copy_n(own.data() + shared, arity, parameters);
    }
  }

  /// Puts what a rule writes for the module on the stack, the last module first. False: no rule applies.
  bool split(const Pending& module, std::vector<double>& own, std::uint32_t step) {
    if ((++decomposed_ & 4095U) == 0) job_.check();
    if (decomposed_ > 4 * limit_) {
      job_.refuse(limit_issue({Resource::modules, 4 * limit_, decomposed_},
                              "decomposes more than " + std::to_string(decomposed_ - 1) +
                                  " modules in step " + std::to_string(step) +
                                  "; the maximum is four times the limit of modules"));
    }
    const Rules& rules = grammar_.decomposition;
    const std::uint64_t stream = keyed_ ? key_at(module.key, 40 + module.depth) : 0;
    const RewriteStreams draws(stream, module.depth);
    const Production* chosen = choose(
        grammar_, rules.candidates(module.kind), draws,
        [&](const Production& rule) { return prepare(rule, own.data(), draws); }, job_);
    if (!chosen) return false;
    if (chosen->weighted) prepare(*chosen, own.data(), draws);
    written_.clear();
    fresh_.clear();
    if (chosen->code.count == 0) {
      for (const Template& each : grammar_.successor(chosen->successor))
        push(each, own.data(), keyed_ ? child_key(stream, each) : 0, module.depth + 1, written_, fresh_);
    } else {
      code_.run(chosen->code, own.data(), RewriteStreams(stream, step).code(),
                [&](const Template& each, std::uint64_t turn) {
                  push(each, own.data(), keyed_ ? code_key(stream, each, turn) : 0, module.depth + 1,
                       written_, fresh_);
                });
    }
    for (std::size_t i = written_.size(); i-- > 0;) {
      Pending next = written_[i];
      const double* const from = fresh_.data() + next.first;
      next.first = values_.size();
      values_.insert(values_.end(), from, from + grammar_.kinds[next.kind].arity);
      pending_.push_back(next);
    }
    return true;
  }

 public:
  /// Runs the statements of a production before its condition.
  double* prepare(const Production& production, double* slots, const RewriteStreams& draws) {
    if (slots && production.before.count > 0) {
      code_.run(production.before, slots, draws.stream.at(5), [](const Template&, std::uint64_t) {});
    }
    return slots;
  }

 private:
  static constexpr std::size_t most_parameters = 64;  // largest number of parameters of a kind
  const Grammar& grammar_;
  CodeRunner& code_;
  Job& job_;
  bool parameters_, keyed_, decomposes_;
  std::uint64_t limit_;
  std::uint64_t decomposed_ = 0;
  std::vector<Pending> pending_, written_;  ///< modules of a decomposition: still to do; of one rule
  std::vector<double> values_, fresh_;      ///< their parameters
};

/// One derivation step.
class Rewriting {
 public:
  struct Turn {
    std::uint32_t step;
    bool is_keyed;
  };
  Rewriting(const Grammar& grammar, const Word& in, const Turn& turn, CodeRunner& code,
            std::span<double> variables, Job& job)
      : grammar_(grammar),
        in_(in),
        step_(turn.step),
        keyed_(turn.is_keyed),
        job_(job),
        rules_(grammar.rules_at(turn.step)),
        variables_(variables),
        writer_(grammar, turn.is_keyed, code, job),
        partner_(job),
        contexts_(grammar, in, partner_, writer_.word, pieces_, job) {
    std::copy(variables.begin(), variables.end(), contexts_.variables());
  }

  Word run() {
    pair_brackets(grammar_, in_, partner_);
    contexts_.set_partner(partner_);
    if (grammar_.backward) return run_backward();
    int cut_depth = 0;  // depth of open brackets inside the removed part, plus one; 0: no removal
    for (std::size_t i = 0; i < in_.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      if (!is_cut(i, cut_depth)) i += rewrite(i);
    }
    keep_variables();
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

  void keep_variables() { std::copy_n(contexts_.variables(), variables_.size(), variables_.begin()); }

  /// Returns how many further modules were replaced with module `i`.
  std::size_t rewrite(std::size_t i) {
    const KindId kind = in_.kind[i];
    if (!rules_.rewrites(kind)) return copy(i);
    if (!variables_.empty()) keep_variables();
    const std::uint64_t key = keyed_ ? in_.key[i] : 0;
    const RewriteStreams draws(key, step_);
    double* slots = nullptr;
    const auto match = [&](const Production& each) {
      return slots = writer_.prepare(each, contexts_.match(each, i), draws);
    };
    const Production* chosen = choose(grammar_, rules_.candidates(kind), draws, match, job_);
    if (!chosen) return copy(i);
    if (chosen->weighted) {  // later candidates have overwritten the slots
      std::copy(variables_.begin(), variables_.end(), contexts_.variables());
      match(*chosen);
    }
    writer_.write(*chosen, slots, key, step_ + 1);
    return chosen->rest.size();
  }

  std::size_t copy(std::size_t i) {
    writer_.copy(in_, i);
    return 0;
  }

  /// Runs from the last module to the first. Each successor keeps its order.
  Word run_backward() {
    Array<std::uint8_t> cut(job_, in_.size(), 0);
    if (grammar_.cuts) {
      int cut_depth = 0;
      for (std::size_t i = 0; i < in_.size(); ++i) cut[i] = is_cut(i, cut_depth) ? 1 : 0;
    }
    for (std::size_t i = in_.size(); i-- > 0;) {
      if (i % check_interval == 0) job_.check();
      if (cut[i] != 0) continue;
      const std::size_t begin = writer_.word.size();
      rewrite(i);
      if (writer_.word.size() > begin) pieces_.push_back(begin);
    }
    keep_variables();
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
  std::span<double> variables_;
  Writer writer_;
  Array<std::uint32_t> partner_;
  std::vector<std::size_t> pieces_;  ///< start of the successor of each module, when writing backward
  ContextMatcher contexts_;
};

}  // namespace

Derivation::Derivation(const Grammar& grammar, bool keyed, Job& job)
    : word(job), grammar_(grammar), keyed_(keyed), job_(job), code_(grammar, job), slots_(grammar.variables) {
  slots_.resize(std::max<std::size_t>(grammar.most_slots, slots_.size()) + 1);
  Writer axiom(grammar, keyed, code_, job);
  axiom.write(grammar.axiom, job.rng().key(), slots_.data());
  word = std::move(axiom.word);
  word.variables = grammar.variables;
}

/// Runs statements between two steps.
void Derivation::run(Range statements, std::uint64_t stream) {
  if (statements.count == 0) return;
  code_.run(statements, slots_.data(), job_.rng().at("between").at(stream),
            [](const Template&, std::uint64_t) {});
}

void Derivation::step() {
  const std::span<double> variables(slots_.data(), grammar_.variables.size());
  run(grammar_.start_each, 2 * std::uint64_t{step_});
  word = Rewriting(grammar_, word, {step_, keyed_}, code_, variables, job_).run();
  run(grammar_.end_each, 2 * std::uint64_t{step_} + 1);
  word.variables.assign(variables.begin(), variables.end());
  ++step_;
}

Word derive_word(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job) {
  if (!keyed && TableRewriter::fits(grammar)) return TableRewriter(grammar, job).derive(steps);
  Derivation derivation(grammar, keyed, job);
  for (std::uint32_t step = 0; step < steps; ++step) derivation.step();
  job.spend(Resource::modules, derivation.word.size());
  return std::move(derivation.word);
}

}  // namespace seedmesh::lsystem
