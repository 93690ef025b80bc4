#pragma once
/// The member `specular` of requests, which several generators have for their materials.
#include <optional>

#include "core/model/model.h"

namespace seedmesh {

/// Sets colour and strength of the reflections of a material. Without a value the material stays as it is. `Given` is
/// a generated struct with `color` and `strength`.
template <class Given>
void set_specular(Material& material, const std::optional<Given>& given) {
  if (!given) return;
  const auto& color = given->color;
  material.specular_color = {linear_of_srgb(color.red), linear_of_srgb(color.green),
                             linear_of_srgb(color.blue)};
  material.specular = static_cast<float>(given->strength);
}

}  // namespace seedmesh
