#include "core/generators/building/restricted_grammar.h"

#include <algorithm>

namespace seedmesh::building {
namespace {

class RestrictionCheck {
 public:
  RestrictionCheck(const Grammar& grammar, bool is_unimarker)
      : grammar_(grammar), is_unimarker_(is_unimarker) {}

  std::vector<lang::TextError> run() {
    for (const Rule& rule : grammar_.rules) each_choice(rule.body, 0);
    return std::move(errors_);
  }

 private:
  /// The greatest number of markers of one choice of the body, after `before` markers.
  std::uint32_t each_choice(std::uint32_t index, std::uint32_t before) {
    const Body& body = grammar_.bodies[index];
    std::uint32_t most = before;
    for (std::uint32_t b = 0; b < body.branch_count; ++b) {
      const Branch& branch = grammar_.branches[body.first_branch + b];
      for (std::uint32_t c = 0; c < branch.choice_count; ++c)
        most = std::max(most, markers_of(grammar_.choices[branch.first_choice + c], before));
    }
    return most;
  }

  std::uint32_t markers_of(const Choice& choice, std::uint32_t markers) {
    for (std::uint32_t i = 0; i < choice.step_count; ++i) {
      const Step& step = grammar_.steps[choice.first_step + i];
      if (step.op == Op::nil)
        report(step, "the rule removes the shape, which a non-erasing grammar does not allow");
      const bool is_marker =
          step.op == Op::symbol && !step.is_leaf && !grammar_.symbols[step.symbol].rules.empty();
      if (is_marker && ++markers > 1 && is_unimarker_) {
        report(step, "`" + grammar_.symbols[step.symbol].name +
                         "` is a second symbol with a rule in this successor; a unimarker grammar has one");
      }
      markers = parts_of(step.first_part, step.part_count, markers);
    }
    return markers;
  }

  std::uint32_t parts_of(std::uint32_t first, std::uint32_t count, std::uint32_t markers) {
    for (std::uint32_t p = first; p < first + count; ++p) {
      const Part& part = grammar_.parts[p];
      if (part.is_group) {
        markers = parts_of(part.first_part, part.part_count, markers);
      } else if (part.body != none) {
        markers = each_choice(part.body, markers);
      }
    }
    return markers;
  }

  void report(const Step& step, std::string message) {
    if (errors_.size() < lang::max_errors) errors_.push_back({step.offset, std::move(message)});
  }

  const Grammar& grammar_;
  bool is_unimarker_;
  std::vector<lang::TextError> errors_;
};

}  // namespace

std::vector<lang::TextError> errors_of_restriction(const Grammar& grammar, bool is_unimarker) {
  return RestrictionCheck(grammar, is_unimarker).run();
}

}  // namespace seedmesh::building
