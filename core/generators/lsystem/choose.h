#pragma once
/// Which production rewrites a module, and the keys of what it writes.
#include <cmath>

#include "core/generators/lsystem/grammar.h"

namespace seedmesh::lsystem {

/// The key of a module written by a module of key `parent`: a choice in one branch never moves one in
/// another.
constexpr std::uint64_t child_key(std::uint64_t parent, const Template& child) {
  return mix(parent ^ child.place);
}

/// Streams of one rewriting: the condition, the choice and the arguments draw apart.
struct Draws {
  Rng place;
  Draws(std::uint64_t key, std::uint32_t step) : place(key_at(key, step)) {}
  Rng condition() const { return place.at(1); }
  Rng choice() const { return place.at(2); }
  Rng code() const { return place.at(4); }
};

inline bool holds(const Grammar& grammar, const Production& production, const double* slots,
                  const Draws& draws) {
  if (!production.conditional) return true;
  if (production.condition.is_constant) return production.condition.value != 0;
  Rng rng = draws.condition();
  return grammar.program.evaluate(production.condition, slots, rng) != 0;
}

/// A weight at the moment of choice: what is negative or not a number counts as none.
inline double weight_of(const Grammar& grammar, const Production& production, const double* slots) {
  if (production.weight.is_constant) return production.weight.value;
  Rng none(0);
  const double weight = grammar.program.evaluate(production.weight, slots, none);
  return weight > 0 && std::isfinite(weight) ? weight : 0;
}

/// Walks the productions `range` of `rules` in order. `match(production)` tells whether its contexts fit and
/// returns its slots, or null. The first that matches wins if it has no weight, else one draw decides among
/// all weighted ones that match.
template <class Match>
const Production* choose(const Grammar& grammar, const Rules& rules, Range range, const Draws& draws,
                         Match&& match) {
  const Production* last = nullptr;
  double total = 0;
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Production& each = rules.productions[i];
    const double* slots = match(each);
    if (!slots || !holds(grammar, each, slots, draws)) continue;
    if (!each.weighted) {
      if (!last) return &each;
      continue;
    }
    total += weight_of(grammar, each, slots);
    last = &each;
  }
  if (!last || !(total > 0)) return nullptr;
  Rng rng = draws.choice();
  double dart = rng.unit() * total;
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    const Production& each = rules.productions[i];
    if (!each.weighted) continue;
    const double* slots = match(each);
    if (!slots || !holds(grammar, each, slots, draws)) continue;
    const double weight = weight_of(grammar, each, slots);
    if (weight > 0) last = &each;
    if ((dart -= weight) < 0) break;
  }
  return last;  // rounding can let the dart fly past the last edge
}

/// The text that writes modules of this kind: the axiom, or the first production that does; "" where none.
std::string writer_of(const Grammar& grammar, KindId kind);

/// Throws Stop (Code::invalid) with the place of the argument.
[[noreturn]] void refuse_argument(const Grammar& grammar, const Template& made, std::uint32_t index,
                                  double value);

/// The arguments of a kind that carries frames.
void fill_framed_arguments(const Grammar& grammar, const Template& made, const double* slots, Rng& rng,
                           double* out);

/// Evaluates the arguments of a template into `out`; a value that is not finite refuses the request at the
/// production.
inline void fill_arguments(const Grammar& grammar, const Template& made, const double* slots,
                           std::uint64_t key, double* out) {
  const std::uint32_t arity = grammar.kinds[made.kind].arity;
  if (arity == 0) return;
  Rng rng = Rng(key).at(3);
  if (!grammar.frames.empty() && !grammar.kinds[made.kind].frames.empty())
    return fill_framed_arguments(grammar, made, slots, rng, out);
  for (std::uint32_t i = 0; i < arity; ++i) {
    const lang::Expression& argument = grammar.arguments[made.first_argument + i];
    const double value =
        argument.is_constant ? argument.value : grammar.program.evaluate(argument, slots, rng);
    if (!std::isfinite(value)) refuse_argument(grammar, made, i, value);
    out[i] = value + 0.0;  // -0 becomes 0
  }
}

}  // namespace seedmesh::lsystem
