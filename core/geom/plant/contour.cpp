#include "core/geom/plant/contour.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

// The least distance between points, and of edges from points and from the origin: smaller faces would be
// degenerate.
constexpr double closest = 0.02;

double cross_of(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

template <class Vec>
auto length_of(const Vec& v) {
  return std::sqrt(glm::dot(v, v));
}

/// The outward normal of an edge of an anticlockwise outline.
glm::vec2 normal_of(const glm::vec2& a, const glm::vec2& b) {
  const glm::vec2 along = b - a;
  return glm::vec2{along.y, -along.x} * (1 / length_of(along));
}

/// The number of pieces of each edge, `sides` in all. Pieces are added where they are longest.
std::vector<std::uint32_t> pieces_of(const std::vector<glm::vec2>& points, std::uint32_t sides) {
  std::vector<float> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lengths.push_back(length_of(points[(i + 1) % points.size()] - points[i]));
  }
  std::vector<std::uint32_t> pieces(points.size(), 1);
  for (std::size_t count = points.size(); count < sides; ++count) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (lengths[i] * static_cast<float>(pieces[longest]) >
          lengths[longest] * static_cast<float>(pieces[i])) {
        longest = i;
      }
    }
    ++pieces[longest];
  }
  return pieces;
}

/// Rotates the list so that the corner nearest to the x axis is first, as for the circle: corners that are
/// blended then lie side by side.
void begin_at_left(std::vector<ContourCorner>& corners, float whole) {
  std::size_t first = 0;
  float most = -2;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const float cosine = corners[i].at.x / length_of(corners[i].at);
    if (cosine > most + 1e-4F) {
      most = cosine;
      first = i;
    }
  }
  const float before = corners[first].round;
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
  for (ContourCorner& corner : corners) {
    corner.round -= before;
    if (corner.round < 0) corner.round += whole;
  }
}

}  // namespace

std::optional<std::string> contour_error(std::span<const glm::dvec2> outline) {
  const std::size_t count = outline.size();
  const auto point = [](std::size_t i) { return "point " + std::to_string(i); };
  double area = 0;
  for (std::size_t i = 0; i < count; ++i) area += cross_of(outline[i], outline[(i + 1) % count]);
  const double sense = area < 0 ? -1 : 1;
  int turns = 0;  // crossings of the positive x axis, upward less downward
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % count];
    if (glm::dot(a, a) > 1) return point(i) + " is outside the circle of radius 1";
    const double length = length_of(b - a);
    if (!(length >= closest)) return point(i) + " is closer than 0.02 to the next";
    if (!(sense * cross_of(a, b) >= closest * length)) {
      return "the edge that begins at " + point(i) +
             " is not visible from the centre (0, 0), or is closer than 0.02 to it; every point must be "
             "visible from there";
    }
    if ((a.y < 0) != (b.y < 0) && a.x * b.y - a.y * b.x != 0) {
      const bool is_right = (a.x * b.y - b.x * a.y) / (b.y - a.y) > 0;
      if (is_right) turns += b.y > a.y ? 1 : -1;
    }
  }
  if (turns != static_cast<int>(sense)) return "the outline winds around the centre more than once";
  return std::nullopt;
}

Contour make_contour(std::span<const glm::dvec2> outline) {
  Contour contour;
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    area += cross_of(outline[i], outline[(i + 1) % outline.size()]);
    contour.points.push_back(glm::vec2(-outline[i].x, outline[i].y) + 0.0F);
  }
  if (area > 0) std::reverse(contour.points.begin() + 1, contour.points.end());  // mirrored
  return contour;
}

std::vector<ContourCorner> corners_of(const Contour& contour, std::uint32_t sides) {
  const std::vector<glm::vec2>& points = contour.points;
  assert(sides >= points.size());
  const std::vector<std::uint32_t> pieces = pieces_of(points, sides);
  std::vector<ContourCorner> corners;
  float round = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec2 &before = points[(i + points.size() - 1) % points.size()], &at = points[i];
    const glm::vec2& next = points[(i + 1) % points.size()];
    const glm::vec2 ahead = normal_of(at, next), both = normal_of(before, at) + ahead;
    const float step = length_of(next - at) / static_cast<float>(pieces[i]);
    for (std::uint32_t k = 0; k < pieces[i]; ++k) {
      const float share = static_cast<float>(k) / static_cast<float>(pieces[i]);
      corners.push_back({at + (next - at) * share, k == 0 ? both * (1 / length_of(both)) : ahead, round});
      round += step;
    }
  }
  begin_at_left(corners, round);
  corners.push_back({corners[0].at, corners[0].normal, round});
  return corners;
}

std::vector<ContourCorner> corners_of_circle(std::uint32_t sides) {
  std::vector<ContourCorner> corners;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double turn = 2 * math::pi * i / sides;
    const math::SinCos angle = math::sincos(turn);
    const glm::vec2 at{static_cast<float>(angle.cos), static_cast<float>(angle.sin)};
    corners.push_back({at, at, static_cast<float>(turn)});
  }
  corners.push_back({corners[0].at, corners[0].normal, static_cast<float>(2 * math::pi)});
  return corners;
}

std::uint32_t least_sides(std::span<const Contour> contours) {
  std::size_t most = 3;
  for (const Contour& contour : contours) most = std::max(most, contour.points.size());
  return static_cast<std::uint32_t>(most);
}

int fineness(std::span<const Contour> contours, std::uint32_t sides) {
  float finest = static_cast<float>(2 * math::pi) / static_cast<float>(sides);
  for (const Contour& contour : contours) {
    const std::vector<ContourCorner> corners = corners_of(contour, sides);
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const glm::vec2 &a = corners[i].at, &b = corners[i + 1].at;
      const float length = length_of(b - a);
      finest = std::min({finest, length, (a.x * b.y - a.y * b.x) / length});
    }
  }
  return static_cast<int>(std::ceil(static_cast<float>(2 * math::pi) / finest));
}

}  // namespace seedmesh
