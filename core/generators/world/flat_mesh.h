#pragma once
/// A mesh of convex polygons that face upwards, clipped to a tile: water and roads.
#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "core/generators/world/glb.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

class FlatMesh {
 public:
  using Point = glm::dvec3;  ///< east, north, height; absolute

  /// `base`: the height of position 0, a multiple of the step of the frame.
  FlatMesh(const TileFrame& frame, double base, const std::array<std::uint8_t, 4>& color)
      : frame_(frame), base_(base), color_(color) {}

  /// A convex polygon, counter-clockwise from above.
  void add(const std::vector<Point>& polygon);
  void add_rectangle(double west, double south, double east, double north, double height);
  /// The part of a convex polygon that lies in the tile.
  void add_clipped(std::vector<Point> polygon);
  /// The ribbon between two points with widths; it reaches beyond the second by a share of its width, so that bends
  /// have no gap.
  void add_ribbon(const Point& from, double from_width, const Point& to, double to_width);

  TileMesh take() { return std::move(mesh_); }

 private:
  TileVertex vertex_of(const Point& p) const;

  const TileFrame& frame_;
  double base_;
  std::array<std::uint8_t, 4> color_;
  TileMesh mesh_;
};

}  // namespace seedmesh::world
