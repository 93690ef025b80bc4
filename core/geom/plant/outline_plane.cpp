#include "core/geom/plant/outline_plane.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace seedmesh {

bool FlatOutline::read(const Outlines& outlines, const Outline& outline,
                       std::span<const std::uint32_t> numbers, double least_area) {
  vertex.clear();
  number.clear();
  flat.clear();
  for (std::uint32_t k = outline.first; k < outline.first + outline.count; ++k) {
    if (!number.empty() && number.back() == numbers[k]) continue;
    vertex.push_back(k);
    number.push_back(numbers[k]);
  }
  while (number.size() > 1 && number.front() == number.back()) {
    number.pop_back();
    vertex.pop_back();
  }
  return number.size() >= 3 && flatten(outlines, least_area);
}

bool FlatOutline::flatten(const Outlines& outlines, double least_area) {
  const std::size_t count = vertex.size();
  const glm::dvec3 origin = outlines.vertex[vertex[0]];
  const auto from_first = [&](std::size_t i) { return glm::dvec3(outlines.vertex[vertex[i]]) - origin; };
  glm::dvec3 sum{0};  // Newell's normal: its length is twice the area
  for (std::size_t i = 1; i + 1 < count; ++i) sum += glm::cross(from_first(i), from_first(i + 1));
  const double length = std::sqrt(glm::dot(sum, sum));
  if (!(length > least_area)) return false;
  normal = sum / length;
  glm::dvec3 along{0};
  double best = 0;
  for (std::size_t i = 1; i < count && best == 0; ++i) {
    along = from_first(i) - normal * glm::dot(from_first(i), normal);
    best = glm::dot(along, along);
  }
  u = along / std::sqrt(best);
  const glm::dvec3 v = glm::cross(normal, u);
  for (std::size_t i = 0; i < count; ++i) {
    flat.emplace_back(glm::dot(from_first(i), u), glm::dot(from_first(i), v));
  }
  return true;
}

}  // namespace seedmesh
