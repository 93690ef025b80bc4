#pragma once
/// Arguments of operations that can be words or expressions.
#include "core/generators/building/evaluate.h"

namespace seedmesh::building {

/// Returns the i-th argument of a step, which has to be given.
inline const Argument& argument_at(const Derivation& d, const Step& step, std::uint32_t i) {
  return d.grammar.arguments[step.first_argument + i];
}
/// Whether the i-th argument is given and is a word.
inline bool is_word(const Derivation& d, const Step& step, std::uint32_t i) {
  return i < step.argument_count && argument_at(d, step, i).word != none;
}
/// Returns the word of the i-th argument, or the text that it evaluates to; other arguments are rejected.
const std::string& word_at(Derivation& d, const Step& step, std::uint32_t i);
/// The same, or another word if the argument is not given.
std::string word_or(Derivation& d, const Step& step, std::uint32_t i, std::string_view other);
/// Returns the i-th argument as a number, or another number if it is not given.
double number_or(Derivation& d, const Step& step, std::uint32_t i, double other);
/// Returns the set of texture coordinates from 0 to 9 that the i-th argument names.
int uv_set_at(Derivation& d, const Step& step, std::uint32_t i);

/// Gives the shape the material with the name of an image, with a warning if the request does not have it.
void use_image(Derivation& d, const Step& step, ShapeState& state, const std::string& path);

/// Gives the shape a part, an asset or a solid by name, as i() does.
void insert_named_geometry(Derivation& d, const Step& step, ShapeState& state, const std::string& name);

/// Replaces an inserted part or asset by its box, with a warning: rules have no access to its faces.
void take_box_of_asset(Derivation& d, const Step& step, ShapeState& state);

/// Returns the geometry of a state in metres of its scope, as take_solid() reads it.
Solid solid_in_metres(const Derivation& d, const ShapeState& state);

}  // namespace seedmesh::building
