#include "core/generators/building/operator_arguments.h"

#include <cmath>

namespace seedmesh::building {

const std::string& word_at(Derivation& d, const Step& step, std::uint32_t i) {
  const Argument& argument = argument_at(d, step, i);
  return argument.word != none ? d.grammar.words[argument.word] : text_of(d, argument);
}

std::string word_or(Derivation& d, const Step& step, std::uint32_t i, std::string_view other) {
  return i < step.argument_count ? word_at(d, step, i) : std::string(other);
}

double number_or(Derivation& d, const Step& step, std::uint32_t i, double other) {
  if (i >= step.argument_count) return other;
  const Argument& argument = argument_at(d, step, i);
  if (argument.word != none) {
    reject(d, step.offset,
           "found " + lang::in_quotes(d.grammar.words[argument.word]) + ", expected a number");
  }
  return number_of(d, argument.value);
}

int uv_set_at(Derivation& d, const Step& step, std::uint32_t i) {
  const double set = number_or(d, step, i, 0);
  if (!(set >= 0 && set <= 9 && set == std::floor(set))) {
    reject(d, step.offset,
           "found the set of texture coordinates " + text_of_number(set) + ", expected one from 0 to 9");
  }
  return static_cast<int>(set);
}

void take_box_of_asset(Derivation& d, const Step& step, ShapeState& state) {
  if (!state.has_asset()) return;
  warn(d, step.offset, "rules cannot use the faces of an inserted part or asset; its box is used");
  state.geometry = box_geometry;
}

Solid solid_in_metres(const Derivation& d, const ShapeState& state) {
  Solid solid = solid_of(d, state);
  for (glm::dvec3& p : solid.points) p *= state.size;
  return solid;
}

}  // namespace seedmesh::building
