#pragma once
/// The members `specular` and `emission` of requests, which several generators have for their materials.
#include <array>
#include <optional>

#include "core/model/model.h"

namespace seedmesh {

/// Returns the opaque linear colour of a sRGB colour with the members red, green and blue.
template <class Given>
glm::vec4 linear_color(const Given& color) {
  return {linear_of_srgb(color.red), linear_of_srgb(color.green), linear_of_srgb(color.blue), 1};
}

/// Sets colour and strength of the reflections of a material. Without a value the material stays as it is. `Given` is
/// a generated struct with `color` and `strength`.
template <class Given>
void set_specular(Material& material, const std::optional<Given>& given) {
  if (!given) return;
  material.specular_color = linear_color(given->color);
  material.specular = static_cast<float>(given->strength);
}

/// Sets the light that a material sends out, like set_specular.
template <class Given>
void set_emission(Material& material, const std::optional<Given>& given) {
  if (!given) return;
  material.emissive = glm::vec3(linear_color(given->color)) * static_cast<float>(given->strength);
}

/// Returns (packed colour, strength) of `specular` and of `emission`. Materials with equal members have equal keys. A
/// missing member gives -1.
template <class Given>
std::array<double, 4> light_key(const Given& given) {
  std::array<double, 4> key{-1, -1, -1, -1};
  const auto set = [&key](std::size_t first, const auto& member) {
    if (!member) return;
    key[first] = 65'536.0 * member->color.red + 256.0 * member->color.green + member->color.blue;
    key[first + 1] = member->strength;
  };
  set(0, given.specular);
  set(2, given.emission);
  return key;
}

}  // namespace seedmesh
