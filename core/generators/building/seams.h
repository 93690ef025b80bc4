#pragma once
/// Rectangles side by side in one plane: where the corner of one lies on an edge of another, that edge gets a
/// corner too. Without it the two edges are drawn apart by a hair, and what is behind shines through
/// (T-junctions). A side with many such corners, as of a long sill below its windows, gets none: a narrow
/// strip behind it closes what gapes.
#include <span>
#include <vector>

#include "core/generators/building/patch.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

class Seams {
 public:
  /// Of those `drawn` shapes that are rectangles, by planes whose axes have the same directions. Corners
  /// within a millionth of the diagonal are one. Cost: n log n of the rectangles.
  Seams(const Shapes& shapes, std::span<const std::uint32_t> drawn, double diagonal, Job& job);

  /// How many triangles the i-th of the drawn has more than two.
  std::size_t more_on(std::size_t i) const { return places_[i] == none ? 0 : rects_[places_[i]].more; }

  /// The corners round a rectangle, counter-clockwise, in the world. Nothing where it is none.
  void outline(std::size_t i, std::vector<glm::dvec3>& points) const;

  /// The rectangle with all its corners in the frame of axes(i). False where it is none, or too narrow for
  /// the lattice of its plane.
  bool fill(std::size_t i, Patch& patch) const;
  const glm::dmat3& axes(std::size_t i) const { return frames_[rects_[places_[i]].frame]; }

 private:
  using Corner = std::pair<std::uint32_t, std::uint32_t>;
  struct Plane {
    double at = 0;
    std::vector<double> u, v;        ///< where there are corners
    std::vector<Corner> by_u, by_v;  ///< places in u and v, by lines along v and along u
  };
  struct Rect {
    std::uint32_t drawn = 0, frame = 0, plane = 0;
    int axis = 1;  ///< of the normal
    double at = 0;
    glm::dvec2 low{0}, high{0};
    Corner first, last;      ///< of the lattice
    std::uint32_t more = 0;  ///< triangles besides the two
    bool is_backed[4] = {};  ///< sides with a strip behind them: bottom, right, top, left
  };

  std::uint32_t frame_of(const glm::dmat3& axes);
  void add_plane(std::span<Rect> rects, double tolerance);
  void count_more(Rect& rect, const Plane& plane) const;
  std::span<const Corner> on_side(const Rect& rect, const Plane& plane, int side) const;
  void ring(const Rect& rect, std::vector<Corner>& corners) const;
  void add_strip(const Rect& rect, int side, Patch& patch) const;
  glm::dvec3 place(const Rect& rect, const Corner& corner) const;

  double diagonal_ = 1;
  std::vector<glm::dmat3> frames_;
  std::vector<Plane> planes_;
  std::vector<Rect> rects_;
  std::vector<std::uint32_t> places_;  ///< by drawn shape, into rects_
};

}  // namespace seedmesh::building
