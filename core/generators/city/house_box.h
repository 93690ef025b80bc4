#pragma once
/// The rectangle of a house in the plan, for what must keep away from it.
#include <array>
#include <glm/geometric.hpp>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// A house as a box with its axes, metres.
struct HouseBox {
  glm::dvec2 centre{0}, x{1, 0}, y{0, 1}, half{0};

  bool contains(const glm::dvec2& p, double margin) const {
    const glm::dvec2 off = p - centre;
    return std::abs(glm::dot(off, x)) < half.x + margin && std::abs(glm::dot(off, y)) < half.y + margin;
  }
};

inline HouseBox box_of(const House& house) {
  const math::SinCos turn = math::sincos_degrees(house.turn);
  return {house.position,
          {turn.cos, turn.sin},
          {-turn.sin, turn.cos},
          glm::dvec2(house.width, house.depth) / 2.0};
}

/// Returns the part of the line a b, as shares, that lies within 0.4 m of a house; empty where none does.
std::optional<std::array<double, 2>> covered(const HouseBox& house, const glm::dvec2& a, const glm::dvec2& b);

}  // namespace seedmesh::city
