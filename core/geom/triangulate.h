#pragma once
/// A flat outline cut into triangles.
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace seedmesh {

/// Keeps its working memory from one outline to the next.
class Triangulator {
 public:
  /// Triangles (three numbers of points each, counter-clockwise) that fill a counter-clockwise outline,
  /// concave ones and such that touch themselves too; an outline that crosses itself is filled as far as it
  /// goes. No triangle has an area of `least_area` or less; points that only such triangles would use are
  /// left out. The answer is valid until the next call.
  ///
  /// Convex outlines become a fan; from others ears are cut off one by one (Meisters, "Polygons have ears",
  /// 1975), with a grid over the reflex corners: about n log n for outlines met in practice.
  std::span<const std::uint32_t> run(std::span<const glm::dvec2> outline, double least_area);

 private:
  bool fan();
  void link();
  void cut_ears();
  double corner(std::uint32_t i) const;
  bool is_ear(std::uint32_t i) const;
  void keep(std::uint32_t i);
  void drop(std::uint32_t i);
  std::uint32_t unblock(std::uint32_t start);

  void fill_grid();
  std::size_t along(double value, int axis) const;
  std::size_t cell_of(const glm::dvec2& p) const { return along(p.y, 1) * side_ + along(p.x, 0); }

  std::span<const glm::dvec2> points_;
  double least_ = 0;  ///< twice the least area
  std::size_t left_ = 0;
  std::vector<std::uint32_t> next_, before_;
  std::vector<std::uint8_t> is_cut_;
  std::vector<std::uint32_t> triangles_;
  std::vector<std::uint32_t> reflex_;

  // The reflex corners in square cells, about one a cell.
  glm::dvec2 low_{0}, cells_by_extent_{0};
  std::size_t side_ = 1;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

}  // namespace seedmesh
