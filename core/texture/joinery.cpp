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

/// The panels that a row of texels crosses.
class CrossedPanels {
 public:
  CrossedPanels(std::span<const Panel> panels, float y) {
    for (const Panel& panel : panels) {
      if (y > panel.y0 && y < panel.y1) panels_[count_++] = panel;
    }
  }
  std::span<const Panel> span() const { return {panels_.data(), count_}; }

 private:
  std::array<Panel, 6> panels_{};
  std::size_t count_ = 0;
};

/// A raised field behind a groove; the frame outside.
Surface panelled(const CrossedPanels& panels, float x, float y) {
  for (const Panel& panel : panels.span()) {
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

/// A row of texels of a leaf. `up`: from 0 at its foot to 1; `brush`: noise of the paint.
struct LeafRow {
  float up;
  int cell;
  const float* brush;
  ReliefRow out;
};

template <class SurfaceAt>
void paint_row(const LeafRow& row, const SurfaceAt& surface_at) {
  // Rain and hands wear the foot of a leaf.
  const float worn = 0.12F * (1 - step_between(0, 0.14F, row.up));
  for (int x = 0; x < row.cell; ++x) {
    const float across = (static_cast<float>(x) + 0.5F) / static_cast<float>(row.cell);
    const Surface surface = surface_at(across, row.up);
    row.out.height[x] = clamp_share(surface.height + 0.06F * row.brush[x]);
    row.out.tone[x] = clamp_share(surface.tone + 0.1F * row.brush[x] - worn);
  }
}

void paint_row(Joinery kind, const LeafRow& row) {
  const auto with_panels = [&](std::span<const Panel> all) {
    const CrossedPanels panels(all, row.up);
    paint_row(row, [&](float x, float y) { return panelled(panels, x, y); });
  };
  switch (kind) {
    case Joinery::six_panels:
      return with_panels(six);
    case Joinery::four_panels:
      return with_panels(four);
    case Joinery::planks:
      return paint_row(row, planked);
    default:
      return paint_row(row, louvred);
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
      for (int i = 0; i < joinery_across; ++i) {
        const int first = i * cell;
        paint_row(static_cast<Joinery>(y / cell * joinery_across + i),
                  {up, cell, brush + first, {out.height + first, out.tone + first, nullptr}});
      }
    }
  });
}

}  // namespace seedmesh::texture
