#pragma once
/// A plane of land and sea, generated from a seed up to the extent of the request. It is streamed as OGC 3D Tiles
/// 1.1. A tile is a function of the request and its address; no tile needs another tile.
///
///   region (drainage, lakes) -> height of a point -> villages -> roads -> fields, houses -> plants -> tiles
///
/// Axes of tiles and maps are those of 3D Tiles: x = east, y = north, z = up, in metres from the middle of the
/// world. Contents are glTF: +Y up, north = -Z.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/world/world_parameters.h"

namespace seedmesh::world {

/// A tile of the quadtree: level 0 is the whole extent; x runs east, y north, from 0. A world has the tiles with
/// 0 <= level < world.levels and 0 <= x, y < 2^level.
struct TileKey {
  int level = 0;
  std::int64_t x = 0, y = 0;
};

/// The upright box of a tile. It contains all vertices of the tile, skirts and instances included, and the boxes of
/// its children; it lies inside the box of its parent. In plan it is the tile's square, except where plants and
/// buildings extend beyond it.
struct TileBounds {
  /// Metres from the middle of the world.
  double west = 0, south = 0, low = 0, east = 0, north = 0, high = 0;
  double geometric_error = 0;  ///< metres; falls at every level and is 0 at leaves
};

/// Returns the bounds of a tile. Those of the 341 tiles of one file are made together, in some milliseconds, and
/// stay in the store. `key` must be in the tree.
TileBounds tile_bounds(const World& world, const TileKey& key, Job& job);

/// Returns the geometric error that the root of an implicit tileset has to declare: divided by 2^level, it is at least
/// that of every tile of the level.
double greatest_error(const World& world);

/// Returns the content of a tile as binary glTF: core glTF with KHR_mesh_quantization. One root node has the middle of
/// the tile as its translation; below it are nodes named by layer. The files that tiles share
/// are in the directory "../../../a" of a tile. Spends Resource::triangles. `key` must be in the tree.
std::string tile_glb(const World& world, const TileKey& key, Job& job);

/// A file that tiles share, by the hash in its name.
struct SharedFile {
  std::string bytes;
  std::string media_type;  ///< "application/octet-stream"
  std::string extension;   ///< "bin"
};
/// Returns the shared file with this hash, or nothing if the world has none.
std::optional<SharedFile> shared_file(const World& world, std::string_view hash, Job& job);

struct MapBox {
  double west = 0, south = 0, east = 0, north = 0;  ///< metres from the middle of the world
};
enum class MapHeights {
  none,
  grid
};  ///< grid: {columns, rows, values} of 65 x 65 samples, rows from the south

/// Returns {box, sea_level, heights?, settlements, rivers, lakes, roads, plants} of a box with sides of at most
/// 2^16 m. In boxes with sides of at most 2,048 m, plants have `places`. In boxes of at most 8,192 m, settlements
/// have `class`, `houses` and `streets`, and towns have `outline`. All waters that a listed river flows into are
/// listed, so `into` is "sea" or names an entry. Positions, heights, widths and radii are rounded to 1/64 m.
Json map_json(const World& world, const MapBox& box, MapHeights heights, Job& job);

// The functions of the generator. Its model is the terrain of the root tile.
std::vector<Issue> check(const WorldParams& params, const CheckContext& context);
Result<Model> generate(const WorldParams& params, const GenerateContext& context);
/// Returns {levels, extent, origin, sea_level, warnings}.
Result<Json> derive(const WorldParams& params, const GenerateContext& context);
Result<Appraisal> appraise(const WorldParams& params, const GenerateContext& context);
Json vocabulary();

}  // namespace seedmesh::world
