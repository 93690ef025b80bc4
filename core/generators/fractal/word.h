#pragma once
/// Words made of blocks, after Word_Test of Kogovšek (2014). The thesis gives the word TEST and states that its
/// blocks are rotated according to their position. The shapes of the letters and the angles are our own.
#include <string_view>
#include <vector>

#include "core/generators/fractal/affine.h"

namespace seedmesh::fractal {

/// Returns one affine map for each dot of the word. The word is centred and as wide as the unit frame. Letters have 5
/// by 7 dots with a gap of one dot. Lower-case letters are drawn as upper-case ones. The result is empty if a
/// character has no letter or there are no dots.
std::vector<Affine> word_maps(std::string_view text);

/// Whether there is a letter for the character.
bool has_letter(char character);

}  // namespace seedmesh::fractal
