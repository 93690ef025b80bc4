#include "core/texture/grime.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

// Streaks fall off as exp(-streak_fall t) over the height t of their face. Most dirt runs off at both ends of a sill.
constexpr double streak_fall = 2.6;
constexpr float most_streak = 0.5F, most_splash = 0.42F, end_of_sill = 0.13F;

/// The share of dirt across a face below a sill, 0 to 1, without noise.
float across_sill(float x) {
  const float from_end = std::min(x, 1 - x);
  const float at_end = 1 - step_between(0.02F, 2 * end_of_sill, std::abs(from_end - end_of_sill));
  return step_between(0, 0.06F, from_end) * (0.35F + 0.65F * at_end);
}

}  // namespace

Relief grime(int size, Rng rng, const Job& job) {
  const Noise streak_noise(size, {36, 2}, {3, 0.6F}, 1, rng.at("streaks"));
  const Noise splash_noise(size, {10, 10}, {4, 0.6F}, 1, rng.at("splash"));
  std::vector<float> sill(static_cast<std::size_t>(size));
  for (std::size_t x = 0; x < sill.size(); ++x)
    sill[x] = across_sill((static_cast<float>(x) + 0.5F) / static_cast<float>(size));
  Relief relief{Field(job, size, 0.5F), Field(job, size, 0.5F), Field(job, 1, 0), Field(job, size)};
  for_rows(job, size, [&](int begin, int end) {
    NoiseRows streak_rows(streak_noise), splash_rows(splash_noise);
    const float half = 0.5F * static_cast<float>(size);
    for (int y = begin; y < end; ++y) {
      const float *streaks = streak_rows.row(y), *splashes = splash_rows.row(y);
      float* const cover = relief.cover.row(y);
      const float down = (static_cast<float>(y) + 0.5F) / half;
      const bool is_streak = down < 1;
      const float fall = is_streak ? static_cast<float>(math::exp(-streak_fall * static_cast<double>(down))) *
                                         (1 - step_between(0.7F, 1, down))
                                   : (down - 1) * (down - 1);
      for (int x = 0; x < size; ++x) {
        const float share = is_streak ? most_streak * sill[static_cast<std::size_t>(x)] *
                                            clamp_share(0.5F + 1.1F * streaks[x])
                                      : most_splash * clamp_share(0.65F + 0.9F * splashes[x]);
        cover[x] = clamp_share(share * fall);
      }
    }
  });
  return relief;
}

}  // namespace seedmesh::texture
