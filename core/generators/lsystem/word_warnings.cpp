#include "core/generators/lsystem/word_warnings.h"

#include <algorithm>
#include <cmath>

#include "core/generators/lsystem/growth.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

std::uint64_t count_of(const Grammar& grammar, const std::vector<std::uint64_t>& counts, Command command) {
  std::uint64_t sum = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    const Kind& each = grammar.kinds[kind];
    const bool is_there = command != Command::organ || each.surface != Kind::none;
    if (each.command == command && is_there) sum += std::min(saturated, counts[kind]);
  }
  return sum;
}

}  // namespace

void warn_of_braces(std::uint64_t open, std::uint64_t stray, std::vector<Warning>& warnings) {
  const auto amount = [](std::uint64_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
  };
  if (open > 0) {
    warnings.push_back({"/axiom",
                        amount(open, "polygon") + (open == 1 ? " is" : " are") +
                            " not closed in the last word and not drawn: found `{` without its `}`",
                        0, 0});
  }
  if (stray > 0) {
    warnings.push_back(
        {"/axiom", "found " + amount(stray, "`}`") + " without a `{` before it in the last word", 0, 0});
  }
}

void warn_of_word(const Grammar& grammar, const std::vector<std::uint64_t>& counts,
                  std::vector<Warning>& warnings) {
  const std::uint64_t open = count_of(grammar, counts, Command::polygon_open);
  const std::uint64_t closed = count_of(grammar, counts, Command::polygon_close);
  if (open < saturated && closed < saturated)
    warn_of_braces(open > closed ? open - closed : 0, closed > open ? closed - open : 0, warnings);
  constexpr Command drawing[] = {Command::draw,       Command::draw_plain,    Command::polygon_close,
                                 Command::organ,      Command::sweep_control, Command::sweep_end,
                                 Command::draw_frame, Command::place_object,  Command::place_in_frame};
  if (std::any_of(std::begin(drawing), std::end(drawing),
                  [&](Command each) { return count_of(grammar, counts, each) > 0; }))
    return;
  warnings.push_back(
      {"/axiom", "nothing will be drawn: the last word has no F or G, no polygon and no organ", 0, 0});
}

void warn_of_thick(const Limbs& limbs, std::vector<Warning>& warnings) {
  constexpr std::size_t fewest = 16;  // fewer internodes are a post, a disc or a similar part
  constexpr float most = 0.75F;       // width, as a share of the largest extent
  if (limbs.size() < fewest) return;
  glm::vec3 low = limbs.position[0], high = low;
  float widest = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    low = glm::min(low, limbs.position[i]);
    high = glm::max(high, limbs.position[i]);
    if (limbs.parent[i] != Limbs::none)
      widest = std::max(widest, 2 * std::max(limbs.radius[i], limbs.base_radius[i]));
  }
  const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  if (!(widest > most * extent)) return;
  const auto metres = [](float value) {
    return number_text(std::round(100.0 * static_cast<double>(value)) / 100) + " m";
  };
  warnings.push_back({"/width",
                      "the widest internode has a diameter of " + metres(widest) +
                          ", and the axes of all limbs extend over " + metres(extent) +
                          "; widths are in metres, while those of figures are often in pixels",
                      0, 0});
}

}  // namespace seedmesh::lsystem
