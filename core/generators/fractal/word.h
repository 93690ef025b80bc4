#pragma once
/// Words out of blocks, after Kogovšek's Word_Test: the thesis gives the word TEST and says that its blocks
/// turn by where they stand, and nothing more; letters and turns are ours.
#include <string_view>
#include <vector>

#include "core/generators/fractal/affine.h"

namespace seedmesh::fractal {

/// The block of every lit dot of the word, which fills the width of the unit frame: letters of 5 by 7 dots,
/// one dot apart, round the middle. Small letters count as capital ones. Empty: a character has no letter, or
/// nothing is lit.
std::vector<Affine> word_maps(std::string_view text);

/// Has the character dots?
bool has_letter(char character);

}  // namespace seedmesh::fractal
