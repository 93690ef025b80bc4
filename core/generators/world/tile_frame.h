#pragma once
/// The position of a tile on the plane, and its step of quantization.
#include <cstdint>

#include "core/generators/world/world.h"

namespace seedmesh::world {

struct TileFrame {
  double side = 0;                           ///< metres
  int cells = 0;                             ///< cells of the terrain along a side
  double spacing = 0;                        ///< spacing of terrain samples
  double west = 0, south = 0;                ///< absolute; the coordinates of samples are exact
  double middle_east = 0, middle_north = 0;  ///< absolute
  double step = 0;  ///< step of quantized positions: a power of two that follows from the side alone
};

constexpr int dense_cells = 64;
constexpr double dense_side = 8192;  ///< metres; of the tiles that have `dense_cells`

/// Returns the number of cells along the side of a tile. Tiles of 4 km show woods and villages as surfaces and
/// prisms, whose heights are the greatest part of their errors. Tiles of 8 km have the same spacing of samples as
/// tiles of 4 km. Views from about a kilometre away therefore end at tiles of 8 km, and need one level of tiles and
/// tilesets less.
constexpr int cells_of(double side) { return side == dense_side ? dense_cells : tile_cells; }

/// Returns the metres between the samples of tiles three levels above those with this side.
constexpr double far_spacing(double side) { return 8 * side / cells_of(8 * side); }

/// Returns the frame of a tile.
inline TileFrame frame_of(const World& world, const TileKey& key) {
  TileFrame frame;
  frame.side = world.extent / static_cast<double>(std::int64_t{1} << key.level);
  frame.cells = cells_of(frame.side);
  frame.spacing = frame.side / frame.cells;
  frame.west = static_cast<double>(world.east) - world.extent / 2 + static_cast<double>(key.x) * frame.side;
  frame.south = static_cast<double>(world.north) - world.extent / 2 + static_cast<double>(key.y) * frame.side;
  frame.middle_east = frame.west + frame.side / 2;
  frame.middle_north = frame.south + frame.side / 2;
  // 16 bits suffice for the sides, and for heights of 8 sides in small tiles, 2 sides in the widest.
  frame.step = frame.side / (frame.side >= 16384 ? 32768 : frame.side >= 2048 ? 16384 : 8192);
  return frame;
}

}  // namespace seedmesh::world
