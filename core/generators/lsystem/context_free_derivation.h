#pragma once
/// Derivation without storing the word: rewrites a context-free system depth first and passes each final
/// module to a sink. Memory grows with the number of steps, not with the length of the word. Random keys
/// depend on the path of derivation, so the result equals that of parallel rewriting.
#include <concepts>
#include <vector>

#include "core/generators/lsystem/choose.h"

namespace seedmesh::lsystem {

/// A sink that can replace the derivation of a module by a result of its own. takes(kind, step) is called for a
/// module that was written at `step`, before it is rewritten. It returns true if the sink has written all that the
/// module derives to.
template <class Sink>
concept ReplacesDerivations = requires(Sink& sink, KindId kind, std::uint32_t step) {
  { sink.replaces(kind, step) } -> std::same_as<bool>;
};

/// Sink has void module(KindId, const double* parameters, std::uint64_t key, std::uint32_t step), called in
/// the order of the word. `step` is the derivation step that wrote the module, 0 for the axiom.
template <class Sink>
class ContextFreeDerivation {
 public:
  /// With `keyed` false, all keys are 0 and cost nothing.
  ContextFreeDerivation(const Grammar& grammar, std::uint32_t steps, bool keyed, Job& job, Sink& sink)
      : grammar_(grammar),
        rules_(grammar.productions),
        steps_(steps),
        keyed_(keyed),
        job_(job),
        meter_(job, Resource::modules),
        sink_(sink),
        width_(grammar.widest),
        parameters_((std::size_t{steps} + 2) * grammar.widest + 1) {}

  void run() { write(grammar_.axiom, nullptr, job_.rng().key(), 0); }

  /// Derives one module without parameters that was written at `step`.
  void run(KindId kind, std::uint32_t step) { rewrite(kind, parameters_.data(), 0, step); }

 private:
  /// Writes the axiom or a successor that appears at `step`, and rewrites each module up to the last step.
  void write(Range successor, const double* slots, std::uint64_t parent, std::uint32_t step) {
    double* own = parameters_.data() + std::size_t{step} * width_;
    const Template* each = grammar_.templates.data() + successor.first;
    for (const Template* end = each + successor.count; each != end; ++each) {
      if (grammar_.cuts && skips(each->kind, step)) continue;
      const std::uint64_t key = keyed_ ? child_key(parent, *each) : 0;
      fill_arguments(grammar_, *each, slots, key, own, job_);
      if (step < steps_ && rules_.rewrites(each->kind)) {
        if constexpr (ReplacesDerivations<Sink>) {
          if (sink_.replaces(each->kind, step)) continue;
        }
        rewrite(each->kind, own, key, step);
      } else {
        meter_.spend();
        sink_.module(each->kind, own, key, step);
      }
    }
  }

  void rewrite(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
    if ((++rewritten_ & 4095U) == 0) {
      job_.check();
      if (rewritten_ > 4 * job_.limits().modules) {
        job_.refuse(limit_issue({Resource::modules, 4 * job_.limits().modules, rewritten_},
                                "rewrites more modules than " + std::to_string(rewritten_ - 1)));
      }
    }
    const std::span<const Production> candidates = rules_.candidates(kind);
    for (std::uint32_t now = step; now < steps_; ++now) {
      const Production* production = choose(
          grammar_, candidates, RewriteStreams(key, now), [&](const Production&) { return parameters; },
          job_);
      if (production) return write(production->successor, parameters, key, now + 1);
      // without random conditions, a failed match fails in every later step
      if (!rules_.redraws[kind]) break;
    }
    meter_.spend();
    sink_.module(kind, parameters, key, step);
  }

  /// Handles the cut symbol %. A % that was written in one step removes the rest of its branch in the next
  /// step.
  bool skips(KindId kind, std::uint32_t step) {
    if (kind == grammar_.open) ++depth_;
    if (kind == grammar_.close && --depth_ < cut_depth_) cut_depth_ = no_cut;
    if (cut_depth_ != no_cut) return true;
    if (kind == grammar_.cut && step < steps_) cut_depth_ = depth_;
    return cut_depth_ != no_cut;
  }

  static constexpr int no_cut = -1;

  const Grammar& grammar_;
  const Rules& rules_;
  std::uint32_t steps_;
  bool keyed_;
  Job& job_;
  Meter meter_;
  Sink& sink_;
  std::size_t width_;
  std::vector<double> parameters_;  ///< one row for each step
  std::uint64_t rewritten_ = 0;
  int depth_ = 0;
  int cut_depth_ = no_cut;
};

}  // namespace seedmesh::lsystem
