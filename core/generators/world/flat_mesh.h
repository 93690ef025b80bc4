#pragma once
/// A mesh of convex polygons that face upwards, for water and roads. Only add_clipped(), add_draped() and
/// add_ribbon() clip to the tile.
#include <array>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "core/generators/world/glb.h"
#include "core/generators/world/terrain_grid.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

class FlatMesh {
 public:
  using Point = glm::dvec3;  ///< east, north, height; absolute

  /// `base`: height in metres of the quantized height 0. It must be a multiple of frame.step.
  FlatMesh(const TileFrame& frame, double base, const std::array<std::uint8_t, 4>& color)
      : frame_(frame), base_(base), color_(color) {}

  /// Adds a convex polygon, counter-clockwise seen from above.
  void add(const std::vector<Point>& polygon);
  void add_rectangle(double west, double south, double east, double north, double height);
  /// The colour of what is added from now on. A vertex keeps the first of its colours.
  void set_color(const std::array<std::uint8_t, 4>& color) { color_ = color; }
  /// Adds a rectangle whose corners, from the south-west counter-clockwise, have these colours.
  void add_rectangle(const glm::dvec2& low, const glm::dvec2& high, double height,
                     const std::array<std::array<std::uint8_t, 4>, 4>& colors);
  /// Adds the part of a convex polygon that lies in the tile.
  void add_clipped(std::vector<Point> polygon);
  /// Adds a strip from one point to another, with a width at each. It extends past the second point by a fifth of its
  /// width, which closes gaps at bends.
  void add_ribbon(const Point& from, double from_width, const Point& to, double to_width);

  /// Adds a convex polygon with the heights of the terrain below it, `lift` metres above its triangles. Clips to the tile.
  void add_draped(std::vector<Point> polygon, const TerrainGrid& grid, double lift);

  /// Returns the mesh. Polygons share vertices with equal positions.
  TileMesh take() { return std::move(mesh_); }

 private:
  TileVertex vertex_of(const Point& p) const;
  std::uint32_t index_of(const Point& p);

  const TileFrame& frame_;
  double base_;
  std::array<std::uint8_t, 4> color_;
  TileMesh mesh_;
  std::map<std::array<std::int16_t, 3>, std::uint32_t> known_;  ///< vertices by position
};

}  // namespace seedmesh::world
