#pragma once
/// The ground around some positions: land, cut by rivers and lakes. A Ground contains the water within reach of a
/// rectangle; the height of a position is the same from each Ground whose rectangle contains it.
#include <cstdint>
#include <limits>
#include <vector>

#include "core/generators/world/land.h"
#include "core/generators/world/region.h"
#include "core/generators/world/valley.h"
#include "core/generators/world/world.h"

namespace seedmesh::world {

/// A rectangle in absolute metres.
struct Rectangle {
  double west = 0, south = 0, east = 0, north = 0;
};

struct GroundSample {
  double height = 0;
  Land land;
  /// Metres to the nearest bank of a river or lake; below 0 in its water.
  double shore = std::numeric_limits<double>::infinity();
  double road = std::numeric_limits<double>::infinity();   ///< metres to the edge of the nearest road
  double house = std::numeric_limits<double>::infinity();  ///< metres to the nearest house
  double cut = 0;                                          ///< depth by which valleys lower the land, metres
  double works = 0;  ///< absolute difference of height between the earthworks of roads and the ground, metres
  int field = -1;    ///< index into WorldFields::colors; -1 outside of fields
  bool is_hedge = false;  ///< whether it is at the border of a field
  double settled = 0;     ///< 1 in a settlement, 0 beyond its cleared land
  bool is_town = false;   ///< within the radius of a town
};

struct RoadPoint;

/// A piece of a road.
struct RoadPiece {
  double from_east = 0, from_north = 0, from_height = 0, to_east = 0, to_north = 0, to_height = 0;
  double width = 0;
  bool is_bridge = false;
  double from_works = 0, to_works = 0;  ///< absolute difference of height from the ground, metres
};

/// The disc that a house covers.
struct HouseMark {
  double east = 0, north = 0, radius = 0;
};

/// A settlement with fields around it.
struct Farmland {
  double east = 0, north = 0, radius = 0;
  bool is_town = false;  ///< no fields within its radius
};

/// A piece of a river.
struct Reach {
  RiverPoint from, to;
  /// Middle of the piece, and `far`: the squared distance from the middle beyond which the piece has no effect.
  double middle_east = 0, middle_north = 0, far = 0;
  double x = 0, y = 0, by = 0;  ///< vector from `from` to `to`, and 1 / its squared length (0 if it has none)
};

class Ground {
 public:
  /// Makes ground without rivers and lakes.
  explicit Ground(const World& world) : world_(&world) {}
  /// Makes ground with the rivers and lakes that can change the heights within the rectangle.
  Ground(const World& world, const Rectangle& rectangle, Job& job);
  /// Makes ground with the rivers and lakes within `reach` metres of the rectangle.
  Ground(const World& world, const Rectangle& rectangle, Job& job, double reach);
  /// Returns ground with fields and the earthworks of roads, which extend 56 m.
  static Ground with_roads(const World& world, const Rectangle& rectangle, Job& job);
  /// Returns ground with the earthworks only of roads between settlements.
  static Ground with_main_roads(const World& world, const Rectangle& rectangle, Job& job);
  /// Returns ground with roads and houses.
  static Ground with_works(const World& world, const Rectangle& rectangle, Job& job);
  /// Returns the ground at a position in absolute metres, which has to lie within the rectangle.
  GroundSample at(double east, double north) const;
  double height(double east, double north) const { return at(east, north).height; }

  const std::vector<Reach>& reaches() const { return reaches_; }
  const std::vector<Lake>& lakes() const { return lakes_; }
  const std::vector<RoadPiece>& road_pieces() const { return pieces_; }

 private:
  /// For each square of a grid over the rectangle, the indices of the road pieces that reach it.
  struct Bins {
    double west = 0, south = 0, cell = 1;
    int count = 0;
    std::vector<std::vector<std::uint32_t>> pieces;
    std::size_t cell_of(double away) const;
  };
  void add_pieces(const Rectangle& box, double reach, const std::vector<RoadPoint>& points, double width);
  void sort_pieces(const Rectangle& box);
  const std::vector<std::uint32_t>& pieces_at(double east, double north) const;
  void add_works(GroundSample& sample, double east, double north) const;
  void add_field(GroundSample& sample, double east, double north) const;

  const World* world_;
  std::vector<Reach> reaches_;
  std::vector<Lake> lakes_;
  std::vector<RoadPiece> pieces_;
  Bins bins_;
  std::vector<HouseMark> houses_;
  std::vector<Farmland> farmland_;
};

}  // namespace seedmesh::world
