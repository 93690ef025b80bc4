#include "core/texture/ground.h"

#include <cmath>

#include "core/base/math.h"

namespace seedmesh::texture {
namespace {

Relief bare(int size, const Job& job) {
  return {Field(job, size), Field(job, size, 0.5F), Field(job, size), Field(job, 1, 1)};
}

float clamp(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

Field noise(int size, Lattice lattice, Octaves octaves, float amplitude, Rng rng, const Job& job) {
  Field field(job, size);
  add_noise(field, lattice, octaves, amplitude, rng, job);
  return field;
}

}  // namespace

// No lattice of these painters is coarser than 8 squares, so that repeats do not show from afar.

Relief soil_ground(int size, Rng rng, const Job& job) {
  const Field tufts = noise(size, {20, 20}, {2, 0.5F}, 0.9F, rng.at("tufts"), job);
  const Field fine = noise(size, {64, 64}, {1, 0.6F}, 0.8F, rng.at("grain"), job);
  const Cells stones = cells(size, {36, 36}, rng.at("stones"), &fine, 2, job);
  Relief relief = bare(size, job);
  const auto stone = [&](int x, int y) {
    const float is_here = stones.shade.row(y)[x] > 0.82F ? 1.0F : 0.0F;
    return is_here * step_between(0.08F, 0.3F, stones.border.row(y)[x]);
  };
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.4F + 0.34F * tufts.row(y)[x] + 0.05F * fine.row(y)[x] + 0.3F * stone(x, y));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.46F + 0.3F * tufts.row(y)[x] + 0.14F * fine.row(y)[x] + 0.3F * stone(x, y));
  });
  return relief;
}

Relief rock_ground(int size, Rng rng, const Job& job) {
  const Field warp = noise(size, {9, 9}, {3, 0.6F}, 1, rng.at("warp"), job);
  const Field fine = noise(size, {40, 40}, {1, 0.6F}, 0.8F, rng.at("grain"), job);
  const Cells plates = cells(size, {9, 14}, rng.at("plates"), &warp, 3, job);
  const Cells chips = cells(size, {22, 26}, rng.at("chips"), &warp, 2, job);
  Relief relief = bare(size, job);
  const auto crack = [&](int x, int y) { return step_between(0, 0.09F, plates.border.row(y)[x]); };
  relief.height.each(job, [&](float, int x, int y) {
    const float chip = step_between(0, 0.2F, chips.border.row(y)[x]) * 0.16F + 0.1F * chips.shade.row(y)[x];
    return clamp(crack(x, y) * (0.4F + 0.3F * plates.shade.row(y)[x]) + chip + 0.05F * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.2F + 0.22F * crack(x, y) + 0.2F * (plates.shade.row(y)[x] - 0.5F) +
                 0.24F * chips.shade.row(y)[x] + 0.16F * fine.row(y)[x]);
  });
  return relief;
}

Relief sand_ground(int size, Rng rng, const Job& job) {
  constexpr int crests = 25;  // of 12 cm
  const Field bend = noise(size, {8, 8}, {2, 0.5F}, 1, rng.at("bend"), job);
  const Field fine = noise(size, {64, 64}, {1, 0.6F}, 0.8F, rng.at("grain"), job);
  Relief relief = bare(size, job);
  const auto ripple = [&](int x, int y) {
    const double along =
        (static_cast<double>(x) + 0.5) / size * crests + 0.7 * static_cast<double>(bend.row(y)[x]);
    const auto phase = static_cast<float>(along - std::floor(along));
    // The lee side takes a third of the length.
    return phase < 0.67F ? phase / 0.67F : (1 - phase) / 0.33F;
  };
  relief.height.each(job, [&](float, int x, int y) {
    const float up = ripple(x, y);
    return clamp(0.25F + 0.5F * up * up * (3 - 2 * up) + 0.04F * fine.row(y)[x]);
  });
  relief.tone.each(
      job, [&](float, int x, int y) { return clamp(0.42F + 0.16F * ripple(x, y) + 0.22F * fine.row(y)[x]); });
  return relief;
}

Relief snow_ground(int size, Rng rng, const Job& job) {
  const Field drifts = noise(size, {8, 14}, {3, 0.55F}, 0.8F, rng.at("drifts"), job);
  const Field fine = noise(size, {64, 64}, {1, 0.6F}, 0.8F, rng.at("grain"), job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.5F + 0.4F * drifts.row(y)[x] + 0.03F * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.5F + 0.2F * drifts.row(y)[x] + 0.24F * fine.row(y)[x]);
  });
  return relief;
}

}  // namespace seedmesh::texture
