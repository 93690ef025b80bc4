#pragma once
/// The files of OGC 3D Tiles 1.1 (22-025r4) that name the tiles of a world: explicit tilesets, an implicit one, and
/// subtrees. Boxes are upright, in metres: x = east, y = north, z = up.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace seedmesh::tiles {

/// A tile of a quadtree: x runs east and y north, from 0 to 2^level - 1.
struct Address {
  int level = 0;
  std::int64_t x = 0, y = 0;
};

bool operator==(const Address& a, const Address& b);

/// The box of a tile with all of its contents, and its geometric error, in metres.
struct Bounds {
  double west = 0, south = 0, low = 0, east = 0, north = 0, high = 0, geometric_error = 0;
};

/// Returns the bounds of a tile. A box lies inside that of its parent, and its error is smaller.
using BoundsOf = std::function<Bounds(const Address&)>;

/// Levels of an explicit tileset and of a subtree. Clients create all tiles of a file in one frame.
constexpr int levels_a_tileset = 4;
constexpr int levels_a_subtree = 5;

/// How a file names the other files: `<prefix>c/3/1/7.glb`, `<prefix>e/4/0/2.json`, `<prefix>s/5/3/3.subtree`.
struct Naming {
  std::string_view prefix;  ///< relative to the address of the file; ends with "/" or is empty
  int levels = 0;           ///< levels of the tree; its last level has no children
  int first_content = 0;    ///< tiles above this level have no content
  std::function<bool(const Address&)> has_tile = {};  ///< whether the tree has a tile; empty: it has all
};

/// Returns an explicit tileset of at most four levels from `root` down. Tiles below the last of these levels
/// refer to further tilesets, whose roots have the same box and error.
std::string explicit_tileset(const Address& root, const Naming& naming, const BoundsOf& bounds_of);

/// Returns an implicit tileset. Most clients ignore the metadata and halve the box and error of the root for
/// each level. The box is therefore exactly the square of side `extent` in plan. `error` divided by 2^level
/// is never below the error of a tile.
std::string implicit_tileset(double extent, double error, const Naming& naming, const BoundsOf& bounds_of);

/// Returns the number of tiles of the first `levels` levels of a subtree: (4^levels - 1) / 3.
std::uint32_t tiles_of(int levels);

/// Returns a binary subtree of five levels, whose tiles are those of a tree of `levels` levels without holes. Metadata
/// are the box and the error of each tile (TILE_BOUNDING_BOX, TILE_GEOMETRIC_ERROR), by rising Morton index.
std::string subtree(const Address& root, int levels, const BoundsOf& bounds_of);

}  // namespace seedmesh::tiles
