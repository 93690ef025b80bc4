#include "core/texture/sheet_metal.h"

#include <cmath>
#include <vector>

#include "core/texture/bond.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {

/// Vertical ribs.
Relief sheet(int size, Rng rng, const Job& job) {
  constexpr int ribs = 5;
  const Noise patch_noise(size, {3, 2}, {4, 0.55F}, 0.6F, rng.at("patches"));
  const Noise streak_noise(size, {64, 8}, {2, 0.6F}, 0.5F, rng.at("streaks"));
  std::vector<float> rib;
  for (int x = 0; x < size; ++x) {
    const float u = (static_cast<float>(x) + 0.5F) * ribs / static_cast<float>(size);
    rib.push_back(1 - step_between(0.18F, 0.28F, std::abs(u - std::floor(u) - 0.5F)));
  }
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows patch_rows(patch_noise), streak_rows(streak_noise);
    for (int y = begin; y < end; ++y) {
      const float *large = patch_rows.row(y), *fine = streak_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.height[x] = rib[static_cast<std::size_t>(x)];
        out.tone[x] = clamp_share(0.46F + 0.1F * out.height[x] + 0.05F * large[x] + 0.12F * fine[x]);
      }
    }
  });
}

/// Smooth panels of metal with open joints.
Relief panels(int size, Rng rng, const Job& job) {
  const Courses courses({1, 1, 0, sheet_metal_tile}, size);
  const Noise patch_noise(size, {3, 2}, {4, 0.5F}, 0.6F, rng.at("patches"));
  const Noise streak_noise(size, {48, 3}, {2, 0.6F}, 0.5F, rng.at("streaks"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows patch_rows(patch_noise), streak_rows(streak_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = courses.row(y);
      const float *large = patch_rows.row(y), *streaks = streak_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float edge = course.to_side[x] < course.to_bed ? course.to_side[x] : course.to_bed;
        const float panel = step_between(0.005F, 0.008F, edge);
        out.height[x] = clamp_share(0.9F * panel + 0.04F * large[x]);
        out.tone[x] = clamp_share(0.5F + 0.06F * large[x] + 0.06F * streaks[x] - 0.5F * (1 - panel));
      }
    }
  });
}

}  // namespace seedmesh::texture
