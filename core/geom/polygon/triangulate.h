#pragma once
/// Triangulation of polygons with holes. The whole project uses this one.
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "core/base/job.h"

namespace seedmesh {

/// Cuts ears off one by one (Meisters, "Polygons have ears", 1975). Convex outlines become a fan. The object
/// keeps its working memory from one polygon to the next; a result is valid until the next call. All tests of
/// sides are exact. Cost: about n log n for outlines met in practice, by a grid over the reflex corners; n² for
/// hostile ones.
class Triangulator {
 public:
  /// Checks stop and deadline of `job`, which outlives the object; null: it runs to the end.
  explicit Triangulator(const Job* job = nullptr) : job_(job) {}

  /// Returns triangles (three numbers of points each, counter-clockwise) that fill a counter-clockwise outline. The
  /// outline may be concave and may touch itself; one that crosses itself is filled as far as possible. No triangle
  /// has an area of `least_area` or less; points that only such triangles use are left out.
  std::span<const std::uint32_t> run(std::span<const glm::dvec2> outline, double least_area);

  /// Returns triangles that fill a polygon with holes, as numbers of `points`. `points` contains the rings one after
  /// the other, with `ring_sizes` points each: the outer ring counter-clockwise, then the holes clockwise. If no two
  /// edges meet except at common ends, the triangles use every point, so that neighbours along an edge meet without
  /// gaps. Triangles of `least_area` or less occur only where no others are possible.
  std::span<const std::uint32_t> run(std::span<const glm::dvec2> points,
                                     std::span<const std::uint32_t> ring_sizes, double least_area);

 private:
  bool fan();
  void link();
  void cut_ears();
  double corner(std::uint32_t i) const;
  bool is_convex(std::uint32_t i) const;
  bool is_ear(std::uint32_t i) const;
  bool blocks(std::uint32_t other, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const;
  void keep(std::uint32_t i);
  void drop(std::uint32_t i);
  std::uint32_t unblock(std::uint32_t start);
  bool cut_thin_ear(std::uint32_t start);

  void fill_grid();
  std::size_t along(double value, int axis) const;
  std::size_t cell_of(const glm::dvec2& p) const { return along(p.y, 1) * side_ + along(p.x, 0); }

  void count_step() const;

  const Job* job_;
  mutable std::uint32_t steps_ = 0;  ///< corners tested since the last check of the job
  std::span<const glm::dvec2> points_;
  double least_ = 0;              ///< twice the least area
  bool uses_all_points_ = false;  ///< thin triangles are kept where no others are possible
  /// Tolerance, as twice an area, within which a straight corner counts as on a new edge; -1: exact.
  double slack_ = -1;
  std::size_t left_ = 0;
  std::vector<std::uint32_t> next_, before_;
  std::vector<std::uint8_t> is_cut_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint32_t> reflex_;
  std::vector<glm::dvec2> outline_;

  // The reflex corners in square cells, about one a cell.
  glm::dvec2 low_{0}, cells_by_extent_{0};
  std::size_t side_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

}  // namespace seedmesh
