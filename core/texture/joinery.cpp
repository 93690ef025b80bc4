// The sizes are those of common doors: leaves of 0.9 by 2.1 m, stiles and rails of 100 to 200 mm, boards of 130 mm, and
// slats of 45 mm.
#include "core/texture/joinery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

constexpr float leaf_width = 0.9F, leaf_height = 2.1F;  // metres
constexpr float groove = 0.012F, slope = 0.045F;        // metres, from the edge of a panel
constexpr float board = 0.13F, slat = 0.045F;

struct Panel {
  float x0, y0, x1, y1;  ///< shares of the leaf, from the lower left
};
constexpr std::array<Panel, 6> six{{{0.13F, 0.1F, 0.45F, 0.4F},
                                    {0.55F, 0.1F, 0.87F, 0.4F},
                                    {0.13F, 0.47F, 0.45F, 0.77F},
                                    {0.55F, 0.47F, 0.87F, 0.77F},
                                    {0.13F, 0.83F, 0.45F, 0.94F},
                                    {0.55F, 0.83F, 0.87F, 0.94F}}};
constexpr std::array<Panel, 4> four{{{0.13F, 0.1F, 0.45F, 0.38F},
                                     {0.55F, 0.1F, 0.87F, 0.38F},
                                     {0.13F, 0.47F, 0.45F, 0.94F},
                                     {0.55F, 0.47F, 0.87F, 0.94F}}};

struct Surface {
  float height, tone;
};

/// A raised field behind a groove; the frame outside.
Surface panelled(std::span<const Panel> panels, float x, float y) {
  for (const Panel& panel : panels) {
    if (y <= panel.y0 || y >= panel.y1) continue;  // most panels, and the same ones in all of a row
    const float inside = std::min(std::min(x - panel.x0, panel.x1 - x) * leaf_width,
                                  std::min(y - panel.y0, panel.y1 - y) * leaf_height);
    if (inside <= 0) continue;
    if (inside < groove) return {0.25F, 0.08F};
    const float up = step_between(groove, slope, inside);
    // The slopes below a panel face the sky.
    const bool is_low = (y - panel.y0) * leaf_height < slope, is_high = (panel.y1 - y) * leaf_height < slope;
    return {0.3F + 0.5F * up, 0.44F + (up < 1 ? (is_low ? -0.14F : is_high ? 0.16F : 0.0F) : 0.04F)};
  }
  return {0.9F, 0.5F};
}

Surface planked(float x, float y) {
  const float at = x * leaf_width / board, within = std::abs(at - std::floor(at) - 0.5F) * 2;  // 1 at a gap
  const float gap = step_between(0.86F, 0.97F, within);
  const bool is_strap = std::abs(y - 0.2F) * leaf_height < 0.03F || std::abs(y - 0.78F) * leaf_height < 0.03F;
  if (is_strap) return {1, 0.02F};
  return {0.8F - 0.6F * gap, 0.5F - 0.42F * gap};
}

Surface louvred(float x, float y) {
  const bool is_frame = std::min(x, 1 - x) * leaf_width < 0.1F || std::min(y, 1 - y) * leaf_height < 0.1F ||
                        std::abs(y - 0.5F) * leaf_height < 0.05F;
  if (is_frame) return {0.95F, 0.52F};
  const float at = y * leaf_height / slat,
              within = at - std::floor(at);  // a slat leans out at its lower edge
  return {0.75F - 0.6F * within, within > 0.72F ? 0.04F : 0.56F - 0.3F * within};
}

Surface surface_of(Joinery kind, float x, float y) {
  switch (kind) {
    case Joinery::six_panels:
      return panelled(six, x, y);
    case Joinery::four_panels:
      return panelled(four, x, y);
    case Joinery::planks:
      return planked(x, y);
    default:
      return louvred(x, y);
  }
}

}  // namespace

Relief joinery(int size, Rng rng, const Job& job) {
  const Noise brush_noise(size, {24, 6}, {3, 0.8F}, 0.5F, rng.at("brush"));
  const int cell = size / joinery_across;
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows brush_rows(brush_noise);
    for (int y = begin; y < end; ++y) {
      const float* brush = brush_rows.row(y);
      const ReliefRow out = row_at(y);
      const float up = 1 - (static_cast<float>(y % cell) + 0.5F) / static_cast<float>(cell);
      for (int x = 0; x < size; ++x) {
        const float across = (static_cast<float>(x % cell) + 0.5F) / static_cast<float>(cell);
        const auto kind = static_cast<Joinery>(y / cell * joinery_across + x / cell);
        const Surface surface = surface_of(kind, across, up);
        // Rain and hands wear the foot of a leaf.
        const float worn = 0.12F * (1 - step_between(0, 0.14F, up));
        out.height[x] = clamp_share(surface.height + 0.06F * brush[x]);
        out.tone[x] = clamp_share(surface.tone + 0.1F * brush[x] - worn);
      }
    }
  });
}

}  // namespace seedmesh::texture
