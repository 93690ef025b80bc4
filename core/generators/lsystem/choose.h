#pragma once
/// Chooses the production that rewrites a module, and derives the random keys of the modules that it writes.
#include <cmath>
#include <span>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

/// Returns the key of a module that the module with key `parent` writes. Keys depend on the parent alone, so
/// a random choice in one branch never changes another branch.
constexpr std::uint64_t child_key(std::uint64_t parent, const Template& child) {
  return mix(parent ^ child.occurrence);
}

/// Random streams of one rewriting step. The condition, the choice and the code draw from separate streams.
struct RewriteStreams {
  Rng stream;
  RewriteStreams(std::uint64_t key, std::uint32_t step) : stream(key_at(key, step)) {}
  Rng condition() const { return stream.at(1); }
  Rng choice() const { return stream.at(2); }
  Rng code() const { return stream.at(4); }
};

inline bool holds(const Grammar& grammar, const Production& production, const double* slots,
                  const RewriteStreams& draws) {
  if (!production.conditional) return true;
  if (production.condition.is_constant) return production.condition.value != 0;
  Rng rng = draws.condition();
  return grammar.program.evaluate(production.condition, slots, rng) != 0;
}

/// Evaluates the weight of a production. A negative or non-finite weight counts as 0.
inline double weight_of(const Grammar& grammar, const Production& production, const double* slots) {
  if (production.weight.is_constant) return production.weight.value;
  Rng none(0);
  const double weight = grammar.program.evaluate(production.weight, slots, none);
  return weight > 0 && std::isfinite(weight) ? weight : 0;
}

/// Throws Stop (Code::invalid), because the weights of the productions that match a module sum to `total`
/// instead of 1. `last` is the last of these productions.
[[noreturn]] void refuse_weights(const Grammar& grammar, const Production& last, double total,
                                 const Job& job);

/// Returns the one of `candidates` that rewrites a module, or null. `match(production)` returns the slots of the
/// production, or null where its contexts do not match. If the first matching production has no weight, it is
/// returned. Otherwise one random number chooses among all matching productions with weights. If
/// Grammar::contexts_first is set, those without a context count only if none with a context matches. Throws
/// Stop if the weights have to sum to 1 and do not. Cost: linear in `candidates`.
template <class Match>
const Production* choose(const Grammar& grammar, std::span<const Production> candidates,
                         const RewriteStreams& draws, Match&& match, const Job& job) {
  const Production* last = nullptr;
  double total = 0;
  for (const Production& each : candidates) {
    if (last && grammar.contexts_first && last->has_context() && !each.has_context()) {
      candidates = candidates.first(static_cast<std::size_t>(&each - candidates.data()));
      break;
    }
    const double* slots = match(each);
    if (!slots || !holds(grammar, each, slots, draws)) continue;
    if (!each.weighted) {
      if (!last) return &each;
      continue;
    }
    total += weight_of(grammar, each, slots);
    last = &each;
  }
  if (last && grammar.weights_sum_to_1 && std::abs(total - 1) > 1e-6)
    refuse_weights(grammar, *last, total, job);
  if (!last || !(total > 0)) return nullptr;
  Rng rng = draws.choice();
  double dart = rng.unit() * total;
  for (const Production& each : candidates) {
    if (!each.weighted) continue;
    const double* slots = match(each);
    if (!slots || !holds(grammar, each, slots, draws)) continue;
    const double weight = weight_of(grammar, each, slots);
    if (weight > 0) last = &each;
    if ((dart -= weight) < 0) break;
  }
  return last;  // rounding can leave `dart` at or above 0 after the last weight
}

/// Returns the pointer of the text that writes modules of this kind: the axiom, or the first production that
/// does. Returns "" where no text does.
std::string writer_of(const Grammar& grammar, KindId kind);

/// Throws Stop (Code::invalid) for an argument that is not finite. The pointer is that of the text that
/// contains the argument.
[[noreturn]] void refuse_argument(const Grammar& grammar, const Template& made, std::uint32_t index,
                                  double value, const Job& job);

/// Evaluates the arguments of a template whose kind has frames as parameters. `out` has Kind::arity elements.
void fill_framed_arguments(const Grammar& grammar, const Template& made, const double* slots, Rng& rng,
                           double* out, const Job& job);

/// Evaluates the arguments of a template into `out`, which has Kind::arity elements. A value that is not
/// finite ends the request by refuse_argument().
inline void fill_arguments(const Grammar& grammar, const Template& made, const double* slots,
                           std::uint64_t key, double* out, const Job& job) {
  const std::uint32_t arity = grammar.kinds[made.kind].arity;
  if (arity == 0) return;
  Rng rng = Rng(key).at(3);
  if (!grammar.frames.empty() && !grammar.kinds[made.kind].frames.empty())
    return fill_framed_arguments(grammar, made, slots, rng, out, job);
  for (std::uint32_t i = 0; i < arity; ++i) {
    const lang::Expression& argument = grammar.arguments[made.first_argument + i];
    const double value =
        argument.is_constant ? argument.value : grammar.program.evaluate(argument, slots, rng);
    if (!std::isfinite(value)) refuse_argument(grammar, made, i, value, job);
    out[i] = value + 0.0;  // -0 becomes 0
  }
}

}  // namespace seedmesh::lsystem
