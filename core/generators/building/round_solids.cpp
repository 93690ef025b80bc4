#include "core/generators/building/round_solids.h"

#include <array>
#include <vector>

#include "core/base/math.h"

namespace seedmesh::building {
namespace {

std::vector<std::uint32_t> ring(std::uint32_t first, std::uint32_t sides, bool is_reversed) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < sides; ++i) out.push_back(first + (is_reversed ? sides - 1 - i : i));
  return out;
}

}  // namespace

glm::dvec2 corner_of(const RoundForm& form, std::uint32_t i) {
  const math::SinCos at = math::sincos_degrees(form.first + 360.0 * i / form.sides);
  return {0.5 + 0.5 * at.cos, 0.5 - 0.5 * at.sin};
}

Solid disk_of(const RoundForm& form) {
  Solid solid;
  for (std::uint32_t i = 0; i < form.sides; ++i) {
    const glm::dvec2 p = corner_of(form, i);
    solid.points.emplace_back(p.x, 0, p.y);
  }
  add_face(solid, ring(0, form.sides, false));
  return solid;
}

Solid cylinder_of(const RoundForm& form) {
  Solid solid = extruded(disk_of(form), 1);
  for (std::size_t f = 2; f < solid.faces.size(); ++f) solid.faces[f].is_round = form.is_smooth;
  return solid;
}

Solid cone_of(const RoundForm& form) {
  const std::uint32_t sides = form.sides;
  Solid solid;
  solid.is_closed = true;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const glm::dvec2 p = corner_of(form, i);
    solid.points.emplace_back(p.x, 0, p.y);
  }
  solid.points.emplace_back(0.5, 1, 0.5);
  add_face(solid, ring(0, sides, true));
  for (std::uint32_t i = 0; i < sides; ++i)
    add_face(solid, std::array{i, (i + 1) % sides, sides}, form.is_smooth);
  return solid;
}

Solid sphere_of(const RoundForm& form, std::uint32_t rows) {
  const std::uint32_t sides = form.sides;
  Solid solid;
  solid.is_closed = true;
  for (std::uint32_t r = 1; r < rows; ++r) {
    const math::SinCos up = math::sincos_degrees(-90 + 180.0 * r / rows);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const glm::dvec2 p = corner_of(form, i) - 0.5;
      solid.points.emplace_back(0.5 + p.x * up.cos, 0.5 + 0.5 * up.sin, 0.5 + p.y * up.cos);
    }
  }
  const auto low = static_cast<std::uint32_t>(solid.points.size()), high = low + 1;
  solid.points.emplace_back(0.5, 0, 0.5);
  solid.points.emplace_back(0.5, 1, 0.5);
  const std::uint32_t last = (rows - 2) * sides;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    add_face(solid, std::array{next, i, low}, true);
    for (std::uint32_t r = 0; r + 2 < rows; ++r) {
      add_face(solid,
               std::array{r * sides + i, r * sides + next, (r + 1) * sides + next, (r + 1) * sides + i},
               true);
    }
    add_face(solid, std::array{last + i, last + next, high}, true);
  }
  return solid;
}

}  // namespace seedmesh::building
