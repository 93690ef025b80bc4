#pragma once
/// A flat outline cut into triangles.
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace seedmesh {

/// Triangles (three numbers of points each, counter-clockwise) that fill a counter-clockwise outline, concave
/// ones and such that touch themselves too; an outline that crosses itself is filled as far as it goes. No
/// triangle has an area of `least_area` or less; points that only such triangles would use are left out. Ears
/// are cut off one by one (Meisters, "Polygons have ears", 1975), with a grid over the reflex corners: about
/// n log n for outlines met in practice.
std::vector<std::uint32_t> triangulate(std::span<const glm::dvec2> outline, double least_area);

}  // namespace seedmesh
