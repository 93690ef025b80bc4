#pragma once
/// Interpreter for the compiled statements of a successor. The statements are compiled to steps, which read
/// and write the slots of one production.
#include <array>

#include "core/generators/lsystem/choose.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {

/// Runs the statements of all successors of one request. limits.modules bounds the sum of all loop
/// iterations, whether they write modules or not.
class CodeRunner {
 public:
  CodeRunner(const Grammar& grammar, Job& job) : grammar_(grammar), job_(job) {}

  /// Runs `steps`. `slots` has Grammar::most_slots elements and is changed. `write(template, turn)` is called
  /// for every module; `turn` is 0 outside loops, and a different number for each iteration of each loop. It
  /// becomes part of the module's key. Random functions draw from `stream` by step and iteration.
  template <class Write>
  void run(Range steps, double* slots, const Rng& stream, Write&& write) {
    std::array<Loop, deepest> loops;
    std::size_t depth = 0;
    std::uint64_t turn = 0;
    for (std::uint32_t at = steps.first; at < steps.first + steps.count;) {
      const Step& step = grammar_.steps[at];
      switch (step.action) {
        case Step::Action::write:
          for (const Template& each : grammar_.successor(step.templates)) write(each, turn);
          break;
        case Step::Action::set:
          slots[step.slot] = value(step, slots, stream, at, turn);
          break;
        case Step::Action::set_element:
          slots[element(step, slots, stream, at)] = value(step, slots, stream, at, turn);
          break;
        case Step::Action::jump:
          at = step.target;
          continue;
        case Step::Action::jump_unless:
          if (value(step, slots, stream, at, turn) == 0) {
            at = step.target;
            continue;
          }
          break;
        case Step::Action::enter_loop:
          loops[depth++] = {turn, 0};
          turn = key_at(turn, at);
          break;
        case Step::Action::next_turn:
          count_turn();
          turn = key_at(key_at(loops[depth - 1].outer, at), ++loops[depth - 1].turns);
          break;
        case Step::Action::leave_loop:
          turn = loops[--depth].outer;
          break;
      }
      ++at;
    }
  }

 private:
  static constexpr std::size_t deepest = 64;  // the limit of the compiler (compile_code.cpp)
  struct Loop {
    std::uint64_t outer = 0, turns = 0;
  };

  double value(const Step& step, const double* slots, const Rng& stream, std::uint32_t at,
               std::uint64_t turn) const {
    Rng rng = stream.at(at).at(turn);
    return grammar_.program.evaluate(step.value, slots, rng);
  }

  /// Returns the slot of an element of an array.
  std::uint32_t element(const Step& step, const double* slots, const Rng& stream, std::uint32_t at) const {
    Rng rng = stream.at(at).at(~std::uint64_t{0});
    const double index = grammar_.program.evaluate(step.index, slots, rng);
    if (index >= 0 && index < step.target) return step.slot + static_cast<std::uint32_t>(index);
    job_.refuse({IssueKind::evaluation, "/arrays",
                 "found the index " + number_text(index) + " of an array of " + std::to_string(step.target) +
                     " elements, which are counted from 0"});
  }

  void count_turn() {
    if ((++turns_ & 4095U) == 0) job_.check();
    if (turns_ > job_.limits().modules) {
      job_.refuse(limit_issue({Resource::modules, job_.limits().modules, turns_},
                              "the loops of the productions take more than " +
                                  std::to_string(job_.limits().modules) +
                                  " iterations, which is the limit of modules"));
    }
  }

  const Grammar& grammar_;
  Job& job_;
  std::uint64_t turns_ = 0;
};

/// Returns the key of a module that statements write.
inline std::uint64_t code_key(std::uint64_t parent, const Template& made, std::uint64_t turn) {
  const std::uint64_t key = child_key(parent, made);
  return turn == 0 ? key : key_at(key, turn);
}

}  // namespace seedmesh::lsystem
