#include "core/generators/lsystem/fractional_iterations.h"

#include <algorithm>

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t check_interval = 4096;

double between(double from, double to, double share) { return from + (to - from) * share; }

}  // namespace

void FractionalStep::module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t born) {
  const Module each{kind, parameters, key, born};
  const Rules& rules = grammar_.rules_at(step_);
  if (kind == grammar_.cut) cut_depth_ = std::max(cut_depth_, 1);
  if (cut_depth_ > 0 || !rules.rewrites(kind)) return stay(each);
  const Production* chosen = choose(
      grammar_, rules.candidates(kind), RewriteStreams(key, step_),
      [&](const Production&) { return parameters; }, drawing_.job());
  return chosen ? rewrite(each, *chosen, parameters) : stay(each);
}

void FractionalStep::word(const Word& word, Job& job) {
  Array<std::uint32_t> partner(job);
  pair_brackets(grammar_, word, partner);
  const Word unwritten(job);
  const std::vector<std::size_t> no_pieces;
  ContextMatcher contexts(grammar_, word, partner, unwritten, no_pieces, job);
  const Rules& rules = grammar_.rules_at(step_);
  const double nothing = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const Module each{word.kind[i], word.parameter.empty() ? &nothing : word.parameter.data() + word.at[i],
                      word.key.empty() ? 0 : word.key[i],
                      word.born.empty() ? 0U : std::uint32_t{word.born[i]}};
    if (each.kind == grammar_.cut) cut_depth_ = std::max(cut_depth_, 1);
    const Production* chosen = nullptr;
    if (cut_depth_ == 0 && rules.rewrites(each.kind)) {
      chosen = choose(
          grammar_, rules.candidates(each.kind), RewriteStreams(each.key, step_),
          [&](const Production& production) { return contexts.match(production, i); }, job);
    }
    if (chosen) {
      rewrite(each, *chosen, contexts.match(*chosen, i));
    } else {
      stay(each);
    }
  }
}

/// Draws a module that the step keeps or cuts.
void FractionalStep::stay(const Module& module) {
  if (cut_depth_ > 0) {
    if (module.kind == grammar_.open) ++cut_depth_;
    if (module.kind == grammar_.close) --cut_depth_;
  }
  const double share = cut_depth_ > 0 ? 1 - share_ : 1;
  drawing_.grow({module.kind, module.parameters, {module.key, 0}}, module.born, {share, 0, 1});
}

/// Several modules together make a polygon or a generalized cylinder, so these cannot fade module by module.
bool FractionalStep::can_fade(KindId kind) const {
  if (grammar_.interpretation.rewrites(kind)) return true;
  switch (grammar_.kinds[kind].command) {
    case Command::none:
    case Command::push:
    case Command::pop:
    case Command::cut:
    case Command::polygon_open:
    case Command::polygon_close:
    case Command::vertex:
    case Command::sweep_begin:
    case Command::sweep_control:
    case Command::sweep_end:
      return false;
    default:
      return true;
  }
}

bool FractionalStep::can_continue(KindId kind) const {
  return !(grammar_.interpretation.rewrites(kind) && grammar_.interpretation.random);
}

void FractionalStep::rewrite(const Module& module, const Production& production, const double* slots) {
  const std::span<const Template> successor = grammar_.successor(production.successor);
  const Template* continuation = nullptr;
  int depth = 0, braces = 0;
  for (const Template& each : successor) {
    const Command command = grammar_.kinds[each.kind].command;
    if (each.kind == grammar_.open) ++depth;
    if (each.kind == grammar_.close) --depth;
    if (command == Command::polygon_open) ++braces;
    if (command == Command::polygon_close) --braces;
    if (depth == 0 && braces == 0 && each.kind == module.kind && !continuation && can_continue(each.kind))
      continuation = &each;
  }
  if (!continuation && can_fade(module.kind)) {
    drawing_.fade({module.kind, module.parameters, {module.key, 0}}, module.born, 1 - share_);
  }
  depth = 0;
  for (const Template& each : successor) {
    if (each.kind == grammar_.open) ++depth;
    if (each.kind == grammar_.close) --depth;
    const std::uint64_t key = module.key == 0 ? 0 : child_key(module.key, each);
    double* own = parameters_.data();
    fill_arguments(grammar_, each, slots, key, own, drawing_.job());
    if (&each != continuation) {
      drawing_.grow({each.kind, own, {key, 0}}, step_ + share_, {share_, depth, 1});
      continue;
    }
    for (std::uint32_t i = 0; i < grammar_.kinds[each.kind].arity; ++i)
      own[i] = between(module.parameters[i], own[i], share_);
    drawing_.grow({each.kind, own, {key, module.key}}, between(module.born, step_ + 1.0, share_),
                  {1, 0, share_});
  }
}

}  // namespace seedmesh::lsystem
