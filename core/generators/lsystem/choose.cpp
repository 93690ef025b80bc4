#include "core/generators/lsystem/choose.h"

namespace seedmesh::lsystem {

void refuse_argument(const Grammar& grammar, const Template& made, std::uint32_t index, double value) {
  const auto number = static_cast<std::uint32_t>(&made - grammar.templates.data());
  const auto within = [&](Range range) {
    return number >= range.first && number < range.first + range.count;
  };
  std::string pointer = "/axiom";
  for (const Rules* rules : {&grammar.productions, &grammar.interpretation}) {
    for (const Production& each : rules->productions) {
      if (within(each.successor)) pointer = each.pointer;
    }
  }
  Job::reject({pointer, "parameter " + std::to_string(index + 1) + " of `" + grammar.kinds[made.kind].symbol +
                            "` became " + (value != value ? "undefined (0/0 or the like)" : "infinite") +
                            "; expected a finite number"});
}

}  // namespace seedmesh::lsystem
