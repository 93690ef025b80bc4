#pragma once
/// Cross-sections of generalized cylinders (Prusinkiewicz, Mündermann, Karwowski and Lane, "The use of
/// positional information in the modeling of plants", 2001): closed outlines drawn once for a radius of 1 and
/// swept along a limb, which blends one into the next.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seedmesh {

/// A closed outline about the origin, seen along the heading: x to the turtle's right, y to its up. Its
/// points lie within the unit circle and every one can be seen from the origin.
struct Contour {
  std::vector<glm::vec2> points;  ///< anticlockwise about the heading: x goes to the turtle's left
};

/// Why an outline cannot be a cross-section, said of its points; nothing where it can. Bends and rings are
/// judged by the circle round it, and its ends are closed from the middle.
std::optional<std::string> contour_fault(std::span<const glm::dvec2> outline);

/// The outline as the tube writer wants it, whichever way round it was drawn. No fault.
Contour make_contour(std::span<const glm::dvec2> outline);

/// A vertex of a cross-section.
struct ContourCorner {
  glm::vec2 at;      ///< for a radius of 1
  glm::vec2 normal;  ///< outward unit vector, the mean of both edges'
  float round;       ///< way round the outline from its first point up to here, for a radius of 1
};

/// `sides` corners and the first one again: the outline's own points, and between them more where its edges
/// are longest, from the one that lies furthest to the turtle's left. At least as many sides as points.
std::vector<ContourCorner> corners_of(const Contour& contour, std::uint32_t sides);

/// The same of the circle.
std::vector<ContourCorner> corners_of_circle(std::uint32_t sides);

/// Sides that no cross-section may go below, for all its points to stay.
std::uint32_t least_sides(std::span<const Contour> contours);

/// How many sides a regular polygon has whose edges are as short as the shortest edge or the narrowest place
/// of any of these: by it the lengths are chosen that a model cannot tell from nothing.
int fineness(std::span<const Contour> contours, std::uint32_t sides);

}  // namespace seedmesh
