#pragma once
/// Warnings that follow from the last word and from its drawing.
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/generators/lsystem/grammar.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh::lsystem {

/// Warns of unmatched braces, which draw nothing.
void warn_of_braces(std::uint64_t open, std::uint64_t stray, std::vector<Warning>& warnings);

/// Adds a warning if `counts`, the numbers of modules of each kind in the last word, show unmatched braces.
/// Adds another if they show that nothing is drawn.
void warn_of_word(const Grammar& grammar, const std::vector<std::uint64_t>& counts,
                  std::vector<Warning>& warnings);

/// Warns of limbs that are nearly as wide as all limbs together are long. Books and cpfg give widths in pixels.
void warn_of_thick(const Limbs& limbs, std::vector<Warning>& warnings);

}  // namespace seedmesh::lsystem
