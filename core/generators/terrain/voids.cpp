#include "core/generators/terrain/voids.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace seedmesh::terrain {
namespace {

/// A level of the pyramid: means of known heights; NaN where there are none.
struct Level {
  std::int32_t width = 0, depth = 0;
  Array<float> mean;
  float& at(std::int32_t x, std::int32_t z) {
    return mean[static_cast<std::size_t>(z) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Level coarser(Level& fine, const Job& job) {
  Level level{(fine.width + 1) / 2, (fine.depth + 1) / 2, {}};
  level.mean =
      Array<float>(job, static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.depth));
  for (std::int32_t z = 0; z < level.depth; ++z) {
    job.check();
    for (std::int32_t x = 0; x < level.width; ++x) {
      double sum = 0;
      int known = 0;
      for (std::int32_t k = 2 * z; k < std::min(2 * z + 2, fine.depth); ++k) {
        for (std::int32_t i = 2 * x; i < std::min(2 * x + 2, fine.width); ++i) {
          if (!std::isfinite(fine.at(i, k))) continue;
          sum += static_cast<double>(fine.at(i, k));
          ++known;
        }
      }
      level.at(x, z) = known > 0 ? static_cast<float>(sum / known) : std::nanf("");
    }
  }
  return level;
}

/// Fills the unknown heights of a level from a coarser one without unknown heights.
void fill_from(Level& fine, Level& coarse, const Job& job) {
  for (std::int32_t z = 0; z < fine.depth; ++z) {
    job.check();
    for (std::int32_t x = 0; x < fine.width; ++x) {
      if (std::isfinite(fine.at(x, z))) continue;
      // The nearest four: three quarters of its own square, one of the next towards this side of it.
      const std::int32_t i = x / 2, k = z / 2;
      const std::int32_t next_i = std::clamp(i + (x % 2 == 0 ? -1 : 1), 0, coarse.width - 1);
      const std::int32_t next_k = std::clamp(k + (z % 2 == 0 ? -1 : 1), 0, coarse.depth - 1);
      fine.at(x, z) = 0.5625F * coarse.at(i, k) + 0.1875F * (coarse.at(next_i, k) + coarse.at(i, next_k)) +
                      0.0625F * coarse.at(next_i, next_k);
    }
  }
}

}  // namespace

bool fill_voids(Field& field, const Job& job) {
  field.voids = 0;
  for (const float height : field.heights) field.voids += std::isfinite(height) ? 0 : 1;
  if (field.voids == 0) return true;
  if (field.voids == field.heights.size()) return false;
  std::vector<Level> levels;
  levels.push_back({field.width, field.depth, std::move(field.heights)});
  while (levels.back().width > 1 || levels.back().depth > 1) levels.push_back(coarser(levels.back(), job));
  for (std::size_t i = levels.size() - 1; i > 0; --i) fill_from(levels[i - 1], levels[i], job);
  field.heights = std::move(levels[0].mean);
  return true;
}

Warning void_warning(const Field& field) {
  return {"/image/data",
          "filled " + std::to_string(field.voids) + " of " + std::to_string(field.heights.size()) +
              " samples, which have no height, from those around them",
          0, 0};
}

}  // namespace seedmesh::terrain
