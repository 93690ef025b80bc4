#pragma once
/// Cross-sections of generalised cylinders: closed outlines for a radius of 1 that are swept along a limb and blended
/// from joint to joint. Source: Prusinkiewicz, Mündermann, Karwowski and Lane, "The use of positional information in
/// the modeling of plants", 2001.
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace seedmesh {

/// A closed outline around the origin. Its points lie within the unit circle, and each is visible from the
/// origin.
struct Contour {
  std::vector<glm::vec2> points;  ///< anticlockwise seen along the heading; x to the turtle's left
};

/// Returns the reason why an outline cannot be a cross-section, with the numbers of its points; nullopt where it
/// can. Input as in requests: seen along the heading, x to the right of the turtle, y up.
std::optional<std::string> contour_error(std::span<const glm::dvec2> outline);

/// Converts a valid outline of a request, of either orientation.
Contour make_contour(std::span<const glm::dvec2> outline);

/// A vertex of a cross-section.
struct ContourCorner {
  glm::vec2 at;      ///< position for a radius of 1
  glm::vec2 normal;  ///< outward unit vector, the mean of both edges
  float round;       ///< length of the outline from its first point, for a radius of 1
};

/// Returns `sides` corners and then the first one again, from the corner that is farthest to the turtle's left.
/// The corners are the points of the outline, and further ones where its edges are longest. Needs at least as
/// many sides as points.
std::vector<ContourCorner> corners_of(const Contour& contour, std::uint32_t sides);

/// The same for the circle.
std::vector<ContourCorner> corners_of_circle(std::uint32_t sides);

/// Returns the least number of sides with which all points of all contours are kept.
std::uint32_t least_sides(std::span<const Contour> contours);

/// Returns the number of sides of a regular polygon. Its edges are as long as the shortest edge of all
/// contours, or as their smallest distance from the origin if that is less. scale_of() gets this number of
/// sides.
int fineness(std::span<const Contour> contours, std::uint32_t sides);

}  // namespace seedmesh
