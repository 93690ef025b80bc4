#pragma once
/// The surface of the finished city: the height of every part of the partition. On level ground carriageways are at
/// height 0. On a terrain, carriageways and sidewalks follow the profiles of the streets. The ground of a block joins
/// their outer edges and the natural ground by embankments with a slope of at most 1:2 (height to width). Where the
/// heights of these streets differ too much for such a slope, the border of the block lies above or below the sidewalk.
/// A wall then stands between the two.
#include <span>

#include "core/generators/city/border_heights.h"
#include "core/generators/city/edge_table.h"
#include "core/generators/city/markings.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/tunnels.h"

namespace seedmesh::city {

constexpr double kerb_height = 0.13;  // m
constexpr double water_depth = 1.2;   // depth of water below the lowest point of its shore, m

class Surface {
 public:
  /// Keeps a reference to the plan, which must not change. `wall_height` is that of a town wall.
  Surface(const CityPlan& plan, double wall_height, Job& job);

  bool is_level() const { return plan_.heights.is_level(); }
  const CityPlan& plan() const { return plan_; }
  double wall_height() const { return wall_height_; }

  /// Returns the height of a part at a position in metres on it.
  double height(std::uint32_t part, const glm::dvec2& metres) const;

  /// Appends the positions in metres strictly between two corners of a part, from `a` to `b`, at which its
  /// outline has further vertices. Both parts that have the edge get the same positions. Kerbs have the vertices
  /// of the strips of their street; other edges have further vertices only on a terrain.
  void points_between(const CmPoint& a, const CmPoint& b, std::vector<glm::dvec2>& points) const;

  /// Returns the tunnels; there are none on level ground.
  const Tunnels& tunnels() const { return tunnels_; }

  /// Returns the strips of an edge's carriageway.
  const StreetStrips& strips(std::uint32_t edge) const { return strips_[edge]; }

  /// `a` and `b` are consecutive corners of a part. Returns the part on the other side of the edge between them, or
  /// no_index at the border of the area. On level ground without town walls, only carriageways and water are found.
  std::uint32_t part_beyond(const CmPoint& a, const CmPoint& b) const;

  /// Frees the strips, once all carriageways are made.
  void release_strips() { strips_ = {}; }
  /// Frees all that only the meshes of the ground need. Afterwards, points_between(), strips() and part_beyond() must
  /// not be called.
  void release_edges();

  /// Returns the height of the floor of a building, which is that of the highest ground below it. Sets `lowest` to
  /// the height of the lowest ground below it.
  double floor_height(const Footing& footing, double& lowest) const;

 private:
  /// The ground of a block, or of a part without a block.
  struct Ground {
    std::vector<std::uint32_t> parts;
    BorderHeights border;
  };

  /// The further vertices of an edge of a carriageway, from the lesser of its ends to the greater.
  struct DividedEdge {
    std::uint32_t first = 0, count = 0;  ///< range in `edge_points_`
  };

  void find_edges(const Job& job);
  void divide_carriageways(const Job& job);
  void divide_edge(const CmPoint& from, const CmPoint& to, std::span<const glm::dvec2> points);
  double street_height(const Part& part, const glm::dvec2& metres) const;
  std::vector<BorderPoint> border_of(const Ground& ground) const;
  void limit_border(Ground& ground) const;
  double ground_height(const Ground& ground, const glm::dvec2& metres) const;
  void limit_natural_ground(const Job& job);
  double natural_height(const glm::dvec2& metres) const;
  double level_of_water(const Part& part) const;

  const CityPlan& plan_;
  double wall_height_;
  EdgeTable
      part_of_edge_;  ///< the edges of all parts; on level ground without town walls, of carriageways and water only
  Tunnels tunnels_;
  std::vector<StreetStrips> strips_;  ///< strips of each edge
  EdgeTable divided_at_;              ///< indices into `divided_`, from the lesser end to the greater
  std::vector<DividedEdge> divided_;
  std::vector<glm::dvec2> edge_points_;
  std::vector<Ground> grounds_;
  std::vector<std::uint32_t> ground_of_;  ///< index into `grounds_` of each part
  std::vector<double> water_level_;       ///< height of the water of each part
  // Natural heights on a lattice, limited to slopes that need no wall.
  glm::dvec2 low_{0};
  double cell_ = 1;
  std::int32_t columns_ = 0, rows_ = 0;
  std::vector<double> natural_;
};

}  // namespace seedmesh::city
