#pragma once
/// The position of a tile on the plane, and its step of quantization.
#include <cstdint>

#include "core/generators/world/world.h"

namespace seedmesh::world {

struct TileFrame {
  double side = 0;                           ///< metres
  double spacing = 0;                        ///< spacing of terrain samples
  double west = 0, south = 0;                ///< absolute; the coordinates of samples are exact
  double middle_east = 0, middle_north = 0;  ///< absolute
  double step = 0;  ///< step of quantized positions: a power of two that follows from the side alone
};

/// Returns the frame of a tile.
inline TileFrame frame_of(const World& world, const TileKey& key) {
  TileFrame frame;
  frame.side = world.extent / static_cast<double>(std::int64_t{1} << key.level);
  frame.spacing = frame.side / tile_cells;
  frame.west = static_cast<double>(world.east) - world.extent / 2 + static_cast<double>(key.x) * frame.side;
  frame.south = static_cast<double>(world.north) - world.extent / 2 + static_cast<double>(key.y) * frame.side;
  frame.middle_east = frame.west + frame.side / 2;
  frame.middle_north = frame.south + frame.side / 2;
  // 16 bits hold the sides, and heights of 8 sides in small tiles, 2 sides in the widest.
  frame.step = frame.side / (frame.side >= 16384 ? 32768 : frame.side >= 2048 ? 16384 : 8192);
  return frame;
}

}  // namespace seedmesh::world
