/// Grass, leaves and stones seen from above, as octaves of gradient noise (Perlin 2002) that repeat, and single grains.
#include "core/generators/world/ground_texture.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/noise.h"

namespace seedmesh::world {
namespace {

constexpr int texels = 256;
constexpr std::uint64_t key = 0x47524F554E44U;

/// Gradient noise that repeats after `period` cells.
double periodic_noise(std::uint64_t octave_key, int period, double x, double y) {
  const int column = math::to_int32(std::floor(x)), row = math::to_int32(std::floor(y));
  const double u = x - column, v = y - row;
  const auto corner = [&](int i, int j) {
    const auto wrapped = [period](int k) { return static_cast<std::uint64_t>((k + period) % period); };
    const double* d = lattice::direction_of(octave_key, wrapped(column + i), wrapped(row + j));
    return d[0] * (u - i) + d[1] * (v - j);
  };
  const double s = u * u * u * (u * (u * 6 - 15) + 10), t = v * v * v * (v * (v * 6 - 15) + 10);
  const double sw = corner(0, 0), nw = corner(0, 1);
  const double south = sw + s * (corner(1, 0) - sw), north = nw + s * (corner(1, 1) - nw);
  return 1.4 * (south + t * (north - south));
}

double light_at(int column, int row) {
  struct Octave {
    int cells;
    double amplitude;
  };
  constexpr Octave octaves[] = {{5, 0.035}, {13, 0.05}, {31, 0.06}, {67, 0.07}, {127, 0.06}};
  double light = ground_texture_mean;
  for (const Octave& o : octaves) {
    const double by = static_cast<double>(o.cells) / texels;
    light += o.amplitude * periodic_noise(key + static_cast<std::uint64_t>(o.cells), o.cells,
                                          (column + 0.5) * by, (row + 0.5) * by);
  }
  Rng rng(cell_key(key, column, row));
  return light + rng.uniform(-0.05, 0.05);
}

SharedImage image_of(const Job& job) {
  constexpr int steps = 64;  ///< steps of grey; few keep the file small
  std::vector<std::byte> grey(static_cast<std::size_t>(texels) * texels);
  for (int row = 0; row < texels; ++row) {
    job.check();
    for (int column = 0; column < texels; ++column) {
      // about the transfer function of sRGB
      const double value = std::sqrt(std::clamp(light_at(column, row), 0.0, 1.0));
      const double stepped = std::floor(value * steps + 0.5) / steps;
      grey[static_cast<std::size_t>(row * texels + column)] =
          static_cast<std::byte>(math::to_int32(255 * stepped + 0.5));
    }
  }
  return shared_image({texels, texels, 1, 8, grey}, job);
}

}  // namespace

std::shared_ptr<const SharedImage> ground_texture(const World& world, const Job& job) {
  return world.store->get<SharedImage>({0, Store::Layer::file, -1, 1, 0}, job,
                                       [&job] { return std::make_shared<const SharedImage>(image_of(job)); });
}

}  // namespace seedmesh::world
