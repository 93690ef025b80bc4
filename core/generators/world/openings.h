#pragma once
/// Windows, doors and chimneys of plain houses: meshes in a file that all tiles share, and their copies in a tile.
#include <memory>

#include "core/generators/world/asset.h"
#include "core/generators/world/instances.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {

/// An opening in a wall: its place, the direction out of the wall, and its size in metres.
struct Opening {
  double east = 0, north = 0, foot = 0;  ///< the middle of its lower edge, absolute
  double x = 0, y = 1;                   ///< unit vector east and north
  double width = 1, height = 1;
};

/// The openings of the houses of a tile.
class Openings {
 public:
  explicit Openings(const TileFrame& frame) : frame_(frame) {}

  void add_window(const Opening& opening);
  void add_door(const Opening& opening);
  /// Adds a chimney of this height. The opening has its middle, its foot and the direction of its front.
  void add_chimney(const Opening& opening);
  /// Adds a node for each kind that has copies.
  void add_to(Glb& glb, const World& world, Job& job) const;

 private:
  void add(Instances& copies, const Opening& opening, double width, double height) const;

  const TileFrame& frame_;
  Instances windows_, doors_, chimneys_;
};

/// Returns the meshes of a window, a door and a chimney from the store; makes them if the store has none. All worlds have the
/// same.
std::shared_ptr<const Asset> opening_asset(const World& world, const Job& job);

}  // namespace seedmesh::world
