#pragma once
/// Removes T-junctions between rectangles in one plane. If the corner of a rectangle lies on an edge of
/// another, that edge gets a corner, too. Without it, gaps of single pixels would be visible. A side with
/// many such corners, such as a long sill below windows, gets a narrow strip behind it instead.
#include <array>
#include <span>
#include <vector>

#include "core/generators/building/body_surface.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

class CoplanarRectangles {
 public:
  /// Takes the `drawn` shapes that are rectangles. Corners within a millionth of the diagonal are equal.
  /// Cost: n log n for n rectangles.
  CoplanarRectangles(const Shapes& shapes, std::span<const std::uint32_t> drawn, double diagonal, Job& job);

  /// Returns the number of triangles of the i-th drawn shape beyond two.
  std::size_t extra_triangles(std::size_t i) const {
    return places_[i] == none ? 0 : rects_[places_[i]].more;
  }

  /// Sets `points` to the corners of a rectangle in the world, counter-clockwise. Clears `points` if the shape is no
  /// rectangle.
  void outline(std::size_t i, std::vector<glm::dvec3>& points) const;

  /// Sets `surface` to the rectangle with all its corners, in the frame of axes(i). Returns false if the
  /// shape is no rectangle, or is narrower than the tolerance.
  bool fill(std::size_t i, BodySurface& surface) const;
  const glm::dmat3& axes(std::size_t i) const { return frames_[rects_[places_[i]].frame]; }

 private:
  using Corner = std::pair<std::uint32_t, std::uint32_t>;
  /// Corners on one line: indices into Lines::at.
  struct Range {
    std::uint32_t first = 0, count = 0;
  };
  /// All corners of a plane, sorted by one of their coordinates and then by the other.
  struct Lines {
    std::vector<std::uint32_t> begins;  ///< start of each line, and the end
    std::vector<std::uint32_t> at;      ///< the other coordinate

    /// The corners on a line strictly between two positions.
    Range between(std::uint32_t line, std::uint32_t from, std::uint32_t to) const;
  };
  struct Plane {
    double at = 0;
    std::vector<double> u, v;  ///< coordinates of corners, rising
    Lines by_u, by_v;          ///< corners as positions in u and v
  };
  struct Rect {
    std::uint32_t drawn = 0, frame = 0, plane = 0;
    int axis = 1;  ///< axis of the normal
    double at = 0;
    glm::dvec2 low{0}, high{0};
    Corner first, last;            ///< lowest and highest corner
    std::uint32_t more = 0;        ///< triangles besides the two
    std::array<Range, 4> sides{};  ///< corners of others, upwards or to the right: bottom, right, top, left
    std::array<bool, 4> is_backed{};  ///< sides with a strip behind them
  };

  std::uint32_t frame_of(const glm::dmat3& axes);
  void add_plane(std::span<Rect> rects, double tolerance);
  static void add_lines(std::span<const Rect> rects, Plane& plane);
  static Lines lines_of(std::vector<std::uint64_t>& corners, std::size_t count);
  void find_sides(Rect& rect, const Plane& plane) const;
  void ring(const Rect& rect, std::vector<Corner>& corners) const;
  void add_strip(const Rect& rect, int side, BodySurface& surface) const;
  glm::dvec3 place(const Rect& rect, const Corner& corner) const;

  double diagonal_ = 1;
  std::vector<glm::dmat3> frames_;
  std::vector<Plane> planes_;
  std::vector<Rect> rects_;
  std::vector<std::uint32_t> places_;  ///< row in rects_, by drawn shape
};

}  // namespace seedmesh::building
