#include "core/texture/bay.h"

#include <algorithm>
#include <utility>

namespace seedmesh::texture {
namespace {

// Metres in the bay, from its lower left corner; those of the blueprint `house`.
constexpr float left = 0.8F, right = 1.9F, sill = 0.9F, lintel = 2.2F;
constexpr float frame = 0.08F, bar = 0.03F;           // of the frame; half of the bar in the middle
constexpr float sill_height = 0.1F, overhang = 0.1F;  // of the sill
constexpr float joint_tone = 0.9F, frame_tone = 0.95F;

/// How far a position is inside of a rectangle; negative outside.
float inside(float x, float y, float low_x, float high_x, float low_y, float high_y) {
  return std::min({x - low_x, high_x - x, y - low_y, high_y - y});
}

}  // namespace

Relief with_window(Relief wall, const Job& job) {
  const int size = wall.height.size();
  const bool has_accent = wall.accent.size() == size;
  Field glass(job, size);
  const float scale_x = static_cast<float>(bay_tile.x) / static_cast<float>(size);
  const float scale_y = static_cast<float>(bay_tile.y) / static_cast<float>(size);
  constexpr float middle = (left + right) / 2;
  for_rows(job, size, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      const float y = (static_cast<float>(size - row) - 0.5F) * scale_y;  // row 0 is the top
      float *height = wall.height.row(row), *tone = wall.tone.row(row), *share = glass.row(row);
      const float* accent = has_accent ? wall.accent.row(row) : nullptr;
      for (int column = 0; column < size; ++column) {
        const float x = (static_cast<float>(column) + 0.5F) * scale_x;
        if (accent) tone[column] += (joint_tone - tone[column]) * accent[column];
        share[column] = 0;
        height[column] = 0.7F + 0.3F * height[column];
        if (inside(x, y, left - overhang, right + overhang, sill - sill_height, sill) >= 0) {
          tone[column] = frame_tone;
          height[column] = 1;
          continue;
        }
        const float depth = inside(x, y, left, right, sill, lintel);
        if (depth < 0) continue;
        const bool is_bar = depth < frame || (x > middle - bar && x < middle + bar);
        tone[column] = is_bar ? frame_tone : 0.5F;
        height[column] = is_bar ? 0.45F : 0.3F;
        share[column] = is_bar ? 0.0F : 1.0F;
      }
    }
  });
  wall.accent = std::move(glass);
  return wall;
}

}  // namespace seedmesh::texture
