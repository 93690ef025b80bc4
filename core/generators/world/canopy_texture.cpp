/// A texture of crowns from above.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/canopy.h"

namespace seedmesh::world {
namespace {

constexpr int texels = 256, cells = 20;  ///< along a side; a cell has one crown

struct Crown {
  double x = 0, y = 0, radius = 1, light = 1, top = 0;  ///< lengths are in cells
};

Crown crown_of(int column, int row) {
  const auto wrapped = [](int k) { return (k + cells) % cells; };
  Rng rng(cell_key(0x43524F574EU, wrapped(column), wrapped(row)));
  Crown crown;
  crown.x = column + rng.uniform(0.15, 0.85);
  crown.y = row + rng.uniform(0.15, 0.85);
  crown.radius = rng.uniform(0.5, 0.82);
  crown.light = rng.uniform(0.72, 1);
  crown.top = rng.uniform(0, 0.5);
  return crown;
}

/// Light on the highest crown over a position, or between crowns.
double light_at(const std::array<Crown, 9>& crowns, double x, double y) {
  double highest = -1, light = 0.2;
  for (const Crown& crown : crowns) {
    const double dx = (x - crown.x) / crown.radius, dy = (y - crown.y) / crown.radius;
    const double square = dx * dx + dy * dy;
    if (square >= 1) continue;
    const double dome = std::sqrt(1 - square), height = dome * crown.radius + crown.top;
    if (height <= highest) continue;
    highest = height;
    light = crown.light * (0.3 + 0.7 * dome * (0.55 + 0.45 * crown.top / 0.5));
  }
  return light;
}

SharedImage make(Job& job) {
  std::vector<std::byte> grey(static_cast<std::size_t>(texels) * texels);
  std::vector<Crown> crowns;  // with those beyond the borders
  crowns.reserve(static_cast<std::size_t>(cells + 2) * (cells + 2));
  for (int row = -1; row <= cells; ++row) {
    for (int column = -1; column <= cells; ++column) crowns.push_back(crown_of(column, row));
  }
  for (int row = 0; row < texels; ++row) {
    job.check();
    const double y = (row + 0.5) * cells / texels;
    for (int column = 0; column < texels; ++column) {
      const double x = (column + 0.5) * cells / texels;
      std::array<Crown, 9> near;
      for (int k = 0; k < 9; ++k) {
        const int at = (static_cast<int>(y) + k / 3) * (cells + 2) + static_cast<int>(x) + k % 3;
        near[static_cast<std::size_t>(k)] = crowns[static_cast<std::size_t>(at)];
      }
      Rng rng(cell_key(0x47524149U, column, row));
      const double light = std::clamp(light_at(near, x, y) * rng.uniform(0.82, 1.1), 0.0, 1.0);
      // about the transfer function of sRGB
      grey[static_cast<std::size_t>(row * texels + column)] =
          static_cast<std::byte>(math::to_int32(255 * std::sqrt(light) + 0.5));
    }
  }
  return shared_image({texels, texels, 1, 8, grey}, job);
}

}  // namespace

std::shared_ptr<const SharedImage> canopy_texture(const World& world, Job& job) {
  return world.store->get<SharedImage>({0, Store::Layer::file, -1, 3, 0}, job,
                                       [&] { return std::make_shared<const SharedImage>(make(job)); });
}

}  // namespace seedmesh::world
