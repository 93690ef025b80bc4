#include "core/generators/terrain/filters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/generators/terrain/flow.h"
#include "core/generators/terrain/noise.h"
#include "tests/core/terrain/support.h"

namespace seedmesh::terrain {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::FloatEq;
using ::testing::Pointwise;

Field hills(std::int32_t side, int threads = 1) {
  NoisePlan plan;
  plan.amplitude = 20;
  plan.gain = 0.55;
  plan.wavelength = 40;
  return noisy(plan, {0, 0, side, side}, 1, Rng(9), any_job(threads));
}

double sum_of(const Field& field) { return std::accumulate(field.heights.begin(), field.heights.end(), 0.0); }

TEST(Smooth, IsTheRecursiveLowPassOfTheThesis) {
  // One row: eastwards .6 .24 .096 after the impulse, then the same filter westwards over that.
  Field field = field_from(6, 2, [](int x, int) { return x == 3 ? 1 : 0; });
  smooth(field, 40, any_job());
  const double east[6] = {0, 0, 0, 0.6, 0.24, 0.096};
  std::vector<double> expected(6);
  double last = east[5];
  expected[5] = last;
  for (int x = 4; x >= 0; --x) expected[static_cast<std::size_t>(x)] = last = 0.4 * last + 0.6 * east[x];
  for (std::size_t x = 0; x < 6; ++x) EXPECT_NEAR(field.heights[x], expected[x], 1e-6);
}

TEST(Smooth, ChangesNothingAtZeroAndFlattensAtAHundred) {
  Field field = field_from(5, 4, [](int x, int z) { return x + 10 * z + 7; });
  const std::vector<double> before = values(field);
  smooth(field, 0, any_job());
  EXPECT_EQ(values(field), before);
  smooth(field, 100, any_job());
  EXPECT_THAT(field.heights, Each(FloatEq(7)));
}

TEST(Smooth, KeepsAFlatField) {
  Field field = field_from(40, 30, [](int, int) { return 5; });
  smooth(field, 40, any_job());
  EXPECT_THAT(values(field), Each(DoubleNear(5, 1e-5)));
}

TEST(SmoothByPosition, IsTheFilterOfAnInfiniteField) {
  const Field raw = hills(257);
  for (const double percent : {20.0, 60.0, 90.0}) {
    Field whole = hills(257), piece = hills(257);
    smooth(whole, percent, any_job());
    smooth_by_position(piece, percent, any_job());
    const std::int32_t reach = std::min(smooth_reach(percent), 120);
    for (std::int32_t z = reach; z < 257 - reach; ++z) {
      for (std::int32_t x = reach; x < 257 - reach; ++x)
        ASSERT_NEAR(piece.at(x, z), whole.at(x, z), 1e-4 * (1 + std::abs(raw.at(x, z)))) << percent;
    }
  }
}

TEST(SmoothByPosition, DoesNotDependOnTheWindow) {
  const auto cut = [](const Field& field, std::int32_t left, std::int32_t top, std::int32_t side) {
    return field_from(side, side, [&](int x, int z) { return field.at(left + x, top + z); });
  };
  const Field all = hills(129);
  const std::int32_t reach = smooth_reach(50);
  Field one = cut(all, 0, 0, 100), other = cut(all, 20, 13, 100);
  smooth_by_position(one, 50, any_job(1));
  smooth_by_position(other, 50, any_job(8));
  for (std::int32_t z = 13 + reach; z < 100 - reach; ++z) {
    for (std::int32_t x = 20 + reach; x < 100 - reach; ++x) ASSERT_EQ(one.at(x, z), other.at(x - 20, z - 13));
  }
}

TEST(SmoothByPosition, ReachesFartherTheMoreItSmooths) {
  EXPECT_EQ(smooth_reach(0), 0);
  EXPECT_EQ(smooth_reach(50), 24);
  EXPECT_LE(smooth_reach(93.7), 256);
  EXPECT_GT(smooth_reach(93.8), 256);
}

TEST(Normalise, StretchesToTheRange) {
  Field field = hills(33);
  normalise(field, -3, 12, any_job());
  const Range range = range_of(field, any_job());
  EXPECT_FLOAT_EQ(range.low, -3);
  EXPECT_FLOAT_EQ(range.high, 12);
  Field even = field_from(3, 3, [](int, int) { return 4; });
  normalise(even, 1, 2, any_job());
  EXPECT_THAT(even.heights, Each(FloatEq(1)));
}

TEST(Terraces, AreStepsAtFullSharpness) {
  Field field = field_from(101, 2, [](int x, int) { return x; });
  terrace(field, {4, 1}, any_job());
  for (int x = 0; x < 100; ++x) ASSERT_FLOAT_EQ(field.at(x, 0), static_cast<float>(x / 25 * 25)) << x;
  EXPECT_FLOAT_EQ(field.at(100, 0), 100);
}

TEST(Terraces, ContinueOutsideTheirRange) {
  Field field = field_from(61, 2, [](int x, int) { return x - 20; });
  terrace(field, {.count = 2, .sharpness = 1, .from = Heights{0, 20}}, any_job());
  for (int x = 0; x < 61; ++x)
    ASSERT_FLOAT_EQ(field.at(x, 0), 10 * std::floor(static_cast<float>(x - 20) / 10)) << x;
}

TEST(Terraces, KeepTheFieldAtZeroSharpness) {
  Field field = hills(33);
  const std::vector<double> before = values(field);
  terrace(field, {5, 0}, any_job());
  EXPECT_THAT(values(field), Pointwise(DoubleNear(1e-4), before));
}

TEST(Island, SinksTheRimBelowTheLowestHeight) {
  Field field = hills(65);
  const Range before = range_of(field, any_job());
  sink_rim(field, {.reach = 0.8, .depth = 5, .roughness = 0.4}, Rng(2), any_job());
  for (int i = 0; i < 65; ++i) {
    for (const float h : {field.at(i, 0), field.at(i, 64), field.at(0, i), field.at(64, i)})
      ASSERT_NEAR(h, before.low - 5, 1e-3);
  }
  EXPECT_GT(field.at(32, 32), before.low);
}

TEST(ThermalErosion, ConservesMaterial) {
  Field field = hills(65);
  const double before = sum_of(field);
  erode_thermally(field, {.iterations = 200, .talus = 0.3, .rate = 0.5}, any_job());
  EXPECT_NEAR(sum_of(field), before, 1e-3 * std::abs(before) + 1);
}

TEST(ThermalErosion, BringsSlopesToTheTalus) {
  Field field = field_from(65, 65, [](int x, int z) { return x == 32 && z == 32 ? 300 : 0; });
  erode_thermally(field, {.iterations = 1000, .talus = 0.5, .rate = 1}, any_job());
  for (int z = 0; z < 65; ++z) {
    for (int x = 1; x < 65; ++x) ASSERT_LE(std::abs(field.at(x, z) - field.at(x - 1, z)), 0.75F);
  }
}

TEST(HydraulicErosion, IsTheSameWithAnyNumberOfThreads) {
  Field one = hills(129), eight = hills(129);
  const DropletPlan plan{.droplets = 5000};
  erode_by_droplets(one, plan, Rng(3), any_job(1));
  erode_by_droplets(eight, plan, Rng(3), any_job(8));
  EXPECT_EQ(values(one), values(eight));
}

/// Beyer's drops in double precision, one after the other, on ground that does not change; with a brush of one sample.
std::vector<double> changes_by_drops(const Field& field, const DropletPlan& plan, Rng rng) {
  std::vector<double> changes(static_cast<std::size_t>(field.width) * static_cast<std::size_t>(field.depth),
                              0);
  const double wide = field.width - 1, deep = field.depth - 1;
  const auto ground = [&](double x, double z) {
    const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(z);
    const double u = x - i, v = z - j, nw = field.at(i, j), ne = field.at(i + 1, j), sw = field.at(i, j + 1),
                 se = field.at(i + 1, j + 1);
    return std::array<double, 3>{(nw * (1 - u) + ne * u) * (1 - v) + (sw * (1 - u) + se * u) * v,
                                 (ne - nw) * (1 - v) + (se - sw) * v, (sw - nw) * (1 - u) + (se - ne) * u};
  };
  for (std::size_t drop = 0; drop < static_cast<std::size_t>(plan.droplets); ++drop) {
    Rng own = rng.at("drops").at(drop);
    double x = own.unit() * wide, z = own.unit() * deep, dx = 0, dz = 0, speed = 1, water = 1, load = 0;
    for (int step = 0; step < plan.lifetime; ++step) {
      const auto [height, east, south] = ground(x, z);
      dx = dx * plan.inertia - east * (1 - plan.inertia);
      dz = dz * plan.inertia - south * (1 - plan.inertia);
      const double length = std::hypot(dx, dz);
      dx /= length;
      dz /= length;
      if (x + dx < 0 || x + dx >= wide || z + dz < 0 || z + dz >= deep) break;
      const double rise = ground(x + dx, z + dz)[0] - height;
      const double bearable = std::max(-rise, 0.005) * speed * water * plan.capacity;
      const double laid = rise > 0          ? std::min(rise, load)
                          : load > bearable ? (load - bearable) * plan.deposition
                                            : -std::min((bearable - load) * plan.erosion, -rise);
      changes[static_cast<std::size_t>(std::lround(z) * field.width + std::lround(x))] += laid;
      load -= laid;
      speed = std::min(std::sqrt(std::max(0.0, speed * speed - rise)), 2.5);
      water *= 1 - plan.evaporation;
      x += dx;
      z += dz;
    }
  }
  return changes;
}

TEST(HydraulicErosion, MovesGroundByTheFormulasOfBeyer) {
  const auto slope = [] {
    Field field(any_job(), 48, 40, 0);
    for (std::int32_t z = 0; z < 40; ++z) {
      for (std::int32_t x = 0; x < 48; ++x)
        field.at(x, z) =
            static_cast<float>(20 - 0.4 * x + 0.6 * std::sin(0.35 * x) * std::cos(0.4 * z + 0.1 * x));
    }
    return field;
  };
  // Two vectors of 16 drops and a part of one, in one batch.
  const DropletPlan plan{.droplets = 45, .lifetime = 12, .radius = 1};
  const Field before = slope();
  Field field = slope();
  const std::vector<double> expected = changes_by_drops(before, plan, Rng(11));
  erode_by_droplets(field, plan, Rng(11), any_job());
  double moved = 0;
  for (std::int32_t z = 0; z < 40; ++z) {
    for (std::int32_t x = 0; x < 48; ++x) {
      const double change = expected[static_cast<std::size_t>(z * 48 + x)];
      EXPECT_NEAR(static_cast<double>(field.at(x, z) - before.at(x, z)), change, 2e-3) << x << ' ' << z;
      moved += std::abs(change);
    }
  }
  EXPECT_GT(moved, 20);
}

TEST(HydraulicErosion, StaysWithinTheOldRangeOfHeights) {
  Field field = hills(129);
  const Field before = hills(129);
  erode_by_droplets(field, {.droplets = 20'000}, Rng(3), any_job());
  const Range old = range_of(before, any_job()), now = range_of(field, any_job());
  EXPECT_GE(now.low, old.low);
  EXPECT_LE(now.high, old.high);
  EXPECT_LT(sum_of(field), sum_of(before));
  EXPECT_NE(values(field), values(before));
}

TEST(HydraulicErosion, EndsADropThatCirclesInAHollow) {
  Field far = hills(33), farther = hills(33);
  erode_by_droplets(far, {.droplets = 500, .lifetime = 4 * (33 + 33), .evaporation = 0}, Rng(3), any_job());
  erode_by_droplets(farther, {.droplets = 500, .lifetime = 1e9, .evaporation = 0}, Rng(3), any_job());
  EXPECT_EQ(values(far), values(farther));
}

TEST(HydraulicErosion, KeepsTheMemoryLimit) {
  Field field = hills(513);
  Job::Options options;
  options.limits.memory_bytes = 1 << 20;
  const Job job(0, options);
  EXPECT_THROW(
      erode_by_droplets(field, {.droplets = 100'000, .lifetime = 1e9, .evaporation = 0}, Rng(3), job), Stop);
}

TEST(Drainage, DrainsEveryDepressionOverItsRim) {
  // A basin inside a wall that is lower at one position.
  const Field field = field_from(9, 9, [](int x, int z) {
    const int ring = std::max(std::abs(x - 4), std::abs(z - 4));
    if (ring == 3) return x == 7 && z == 4 ? 6.0 : 10.0;
    return ring < 3 ? 1.0 + ring : 0.0;
  });
  const Drainage drainage = drainage_of(field, any_job());
  EXPECT_EQ(drainage.order.size(), 81U);
  EXPECT_FLOAT_EQ(drainage.filled[4 * 9 + 4], 6);
  const Array<float> area = gathered(field, drainage, any_job());
  // All 25 samples of the basin leave by the gap.
  EXPECT_GE(area[4 * 9 + 7], 25.0F);
}

// The definition: water stands at the lowest rim over all ways to the border, here by relaxation until nothing changes.
TEST(Drainage, FillsToTheLowestRimAndOrdersReceiversFirst) {
  constexpr int size = 33;
  // Steps of 5 m, so that many heights are equal, above and below 0.
  Field field = hills(size);
  for (float& height : field.heights) height = 5 * std::round((height - field.heights[40]) / 5);
  std::vector<float> filled(field.heights.begin(), field.heights.end());
  for (int z = 1; z < size - 1; ++z) std::fill_n(filled.begin() + z * size + 1, size - 2, 1e9F);
  for (bool changes = true; changes;) {
    changes = false;
    for (int i = size + 1; i < size * (size - 1) - 1; ++i) {
      if (i % size == 0 || i % size == size - 1) continue;
      for (const int apart : {-size - 1, -size, -size + 1, -1, 1, size - 1, size, size + 1}) {
        const auto at = static_cast<std::size_t>(i);
        const float level = std::max(field.heights[at], filled[static_cast<std::size_t>(i + apart)]);
        changes = changes || level < filled[at];
        filled[at] = std::min(filled[at], level);
      }
    }
  }
  const Drainage drainage = drainage_of(field, any_job());
  ASSERT_EQ(drainage.order.size(), filled.size());
  std::vector<bool> seen(filled.size(), false);
  for (const std::uint32_t sample : drainage.order) {
    EXPECT_EQ(drainage.filled[sample], filled[sample]) << sample;
    const std::uint32_t to = drainage.receiver[sample];
    EXPECT_TRUE(to == sample || seen[to]) << sample;
    EXPECT_FALSE(seen[sample]);
    seen[sample] = true;
  }
}

TEST(Drainage, DrainsEverySampleToTheBorder) {
  const Field field = hills(65);
  const Array<float> area = gathered(field, drainage_of(field, any_job()), any_job());
  double out = 0;
  // What is at the border may still run along it, so that samples there count more than once; none is lost.
  for (std::size_t i = 0; i < 65 * 65; ++i) {
    if (i % 65 == 0 || i % 65 == 64 || i / 65 == 0 || i / 65 == 64) out += static_cast<double>(area[i]);
  }
  EXPECT_GE(out, 65 * 65 * 0.999);
}

TEST(StreamPower, CutsTheInteriorAndKeepsTheBorder) {
  Field field = hills(65);
  const Field before = hills(65);
  erode_by_streams(field, {.iterations = 5}, any_job());
  for (int z = 0; z < 65; ++z) {
    for (int x = 0; x < 65; ++x) {
      const bool border = x == 0 || z == 0 || x == 64 || z == 64;
      ASSERT_TRUE(!border || field.at(x, z) == before.at(x, z));
      ASSERT_LE(field.at(x, z), before.at(x, z));
    }
  }
  EXPECT_LT(sum_of(field), sum_of(before));
}

TEST(Noise, IsTheSameInEveryWindowAndWithAnyNumberOfThreads) {
  for (const NoiseKind kind : {NoiseKind::rolling, NoiseKind::ridged, NoiseKind::billow}) {
    for (const double warp : {0.0, 12.0}) {
      NoisePlan plan;
      plan.kind = kind;
      plan.amplitude = 10;
      plan.wavelength = 37;
      plan.warp = warp;
      const Field all = noisy(plan, {-50, -60, 120, 120}, 1.5, Rng(4), any_job(1));
      const Field part = noisy(plan, {-7, 3, 50, 40}, 1.5, Rng(4), any_job(8));
      for (int z = 0; z < 40; ++z) {
        for (int x = 0; x < 50; ++x) ASSERT_EQ(part.at(x, z), all.at(x + 43, z + 63));
      }
    }
  }
}

TEST(Noise, StaysWithinItsOctavesAndFollowsTheHurstExponent) {
  NoisePlan plan;
  plan.amplitude = 10;
  plan.wavelength = 128;
  plan.gain = 0.5743;  // 2^-0.8
  const Field field = noisy(plan, {0, 0, 513, 513}, 1, Rng(4), any_job());
  const Range range = range_of(field, any_job());
  EXPECT_LT(std::max(-range.low, range.high), 10 / (1 - 0.5743));
  EXPECT_NEAR(measured_hurst(field), 0.8, 0.1);
}

TEST(Noise, RepeatsWithTheGivenPeriod) {
  NoisePlan plan;
  plan.amplitude = 10;
  plan.wavelength = 16;
  plan.repeat = 4;
  const Field field = noisy(plan, {-3, -5, 140, 140}, 1, Rng(4), any_job());
  for (int z = 0; z < 70; ++z) {
    for (int x = 0; x < 70; ++x) {
      ASSERT_NEAR(field.at(x, z), field.at(x + 64, z), 1e-4);
      ASSERT_NEAR(field.at(x, z), field.at(x, z + 64), 1e-4);
    }
  }
}

TEST(Resampling, KeepsPlanesAndSamplesAtOldPositions) {
  const Field field = hills(33);
  const Field finer = resampled(field, 65, any_job());
  for (int z = 0; z < 33; ++z) {
    for (int x = 0; x < 33; ++x) ASSERT_FLOAT_EQ(finer.at(2 * x, 2 * z), field.at(x, z));
  }
  const Field plane = resampled(field_from(10, 7, [](int x, int z) { return 3 * x - 2 * z; }), 19, any_job());
  EXPECT_EQ(plane.depth, 13);
  for (int z = 0; z < 13; ++z) {
    for (int x = 0; x < 19; ++x) ASSERT_NEAR(plane.at(x, z), 1.5 * x - z, 1e-4);
  }
}

}  // namespace
}  // namespace seedmesh::terrain
