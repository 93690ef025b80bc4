#pragma once
/// Runs what successors with statements consist of: steps over the slots of one production.
#include <array>
#include <vector>

#include "core/generators/lsystem/choose.h"

namespace seedmesh::lsystem {

/// One for all successors of a request: it bounds the turns of all their loops together, by limits.modules,
/// whether they write modules or not.
class CodeRunner {
 public:
  CodeRunner(const Grammar& grammar, Job& job) : grammar_(grammar), job_(job) {}

  /// `slots` has room for Grammar::most_slots. Calls write(template, turn) for every module; `turn` is 0
  /// outside loops and else different in every turn, for the module's key. Draws at `place` by step and turn.
  template <class Write>
  void run(Range steps, double* slots, const Rng& place, Write&& write) {
    std::array<Loop, deepest> loops;
    std::size_t depth = 0;
    std::uint64_t turn = 0;
    for (std::uint32_t at = steps.first; at < steps.first + steps.count;) {
      const Step& step = grammar_.steps[at];
      switch (step.does) {
        case Step::Does::write:
          for (const Template& each : grammar_.successor(step.templates)) write(each, turn);
          break;
        case Step::Does::set:
          slots[step.slot] = value(step, slots, place, at, turn);
          break;
        case Step::Does::jump:
          at = step.target;
          continue;
        case Step::Does::jump_unless:
          if (value(step, slots, place, at, turn) == 0) {
            at = step.target;
            continue;
          }
          break;
        case Step::Does::enter_loop:
          loops[depth++] = {turn, 0};
          turn = key_at(turn, at);
          break;
        case Step::Does::next_turn:
          count_turn();
          turn = key_at(key_at(loops[depth - 1].outer, at), ++loops[depth - 1].turns);
          break;
        case Step::Does::leave_loop:
          turn = loops[--depth].outer;
          break;
      }
      ++at;
    }
  }

 private:
  static constexpr std::size_t deepest = 64;  // as the compiler has it
  struct Loop {
    std::uint64_t outer = 0, turns = 0;
  };

  double value(const Step& step, const double* slots, const Rng& place, std::uint32_t at,
               std::uint64_t turn) const {
    Rng rng = place.at(at).at(turn);
    return grammar_.program.evaluate(step.value, slots, rng);
  }

  void count_turn() {
    if ((++turns_ & 4095U) == 0) job_.check();
    if (turns_ > job_.limits().modules) {
      Job::refuse("the loops of the productions take more than " + std::to_string(job_.limits().modules) +
                  " turns, which is the limit of modules");
    }
  }

  const Grammar& grammar_;
  Job& job_;
  std::uint64_t turns_ = 0;
};

/// The key of a module that code writes.
inline std::uint64_t code_key(std::uint64_t parent, const Template& made, std::uint64_t turn) {
  const std::uint64_t key = child_key(parent, made);
  return turn == 0 ? key : key_at(key, turn);
}

}  // namespace seedmesh::lsystem
