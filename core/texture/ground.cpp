#include "core/texture/ground.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/base/wide.h"
#include "core/texture/cells.h"
#include "core/texture/ground_pieces.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

/// The sum of a row. Several sums are added up together, because each addition waits for the one before.
double sum_of(const float* row, int size) {
  constexpr int sums = 8;
  std::array<double, sums> parts{};
  for (int x = 0; x < size; ++x) parts[static_cast<std::size_t>(x % sums)] += static_cast<double>(row[x]);
  double sum = 0;
  for (const double part : parts) sum += part;
  return sum;
}

/// Shifts the tones to a mean, so that vertex colours keep their brightness. It is above 0.5 where dark tones are
/// darker than light ones are light.
Relief centred(Relief relief, double mean = 0.5) {
  const int size = relief.tone.size();
  double sum = 0;
  for (int y = 0; y < size; ++y) sum += sum_of(relief.tone.row(y), size);
  const auto by = static_cast<float>(mean - sum / (static_cast<double>(size) * size));
  for (int y = 0; y < size; ++y) {
    float* row = relief.tone.row(y);
    for (int x = 0; x < size; ++x) row[x] = clamp_share(row[x] + by);
  }
  return relief;
}

/// Grain of two noises without pieces.
Relief grained(int size, Lattice coarse, float height, float tone, Rng rng, const Job& job) {
  const Noise clods(size, coarse, {3, 0.55F}, 1, rng.at("clods")),
      grain(size, {96, 96}, {1, 0.6F}, 1, rng.at("grain"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows clod_rows(clods), grain_rows(grain);
    for (int y = begin; y < end; ++y) {
      const float *large = clod_rows.row(y), *fine = grain_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.height[x] = clamp_share(0.3F + height * (large[x] + 0.12F * fine[x]));
        out.tone[x] = clamp_share(0.5F + tone * (large[x] + 0.6F * fine[x]));
      }
    }
  });
}

/// The facet at a texel, of one size of the facets of rock.
struct Facet {
  float border;  ///< distance to the border, in cells
  float shade;   ///< random number of the facet
  float rise;    ///< height on its tilted plane, about -1 to 1
};

/// Each facet has a plane of its own. Its direction comes from digits of the random number that are otherwise unused.
Facet facet(const CellRows::Row& row, int x) {
  const auto digits = [](float v) { return v - static_cast<float>(static_cast<int>(v)); };
  const float shade = row.shade[x];
  const float east = 2 * digits(shade * 97) - 1, south = 2 * digits(shade * 1'571) - 1;
  return {row.border[x], shade, east * row.right[x] + south * row.down[x]};
}

struct RockPoint {
  float height, tone;
};

/// Rock between two sizes of facets, a slow noise and a fine one. Few borders of blocks are open cracks: those
/// where the slow noise is high. Low positions are dark, crests are worn, and lichen is light.
RockPoint rock_point(const std::array<Facet, 2>& facets, float slow, float grain) {
  // Steps between facets take two texels of an image of 512, so that their edges have no stairs.
  constexpr float block_edge = 0.03F, chip_edge = 0.09F;
  const auto& [block, chip] = facets;
  const float open = step_between(-0.15F, 0.25F, slow), width = 0.028F + 0.035F * open;
  const float crack = (0.15F + 0.85F * open) * (1 - step_between(0, width, block.border));
  const float worn = 1 - step_between(0, 0.12F, block.border);
  const float blocks = 0.22F * block.shade + 0.4F * block.rise * step_between(0, block_edge, block.border);
  const float chips = (0.08F * chip.shade + 0.3F * chip.rise) * step_between(0, chip_edge, chip.border);
  const float height = clamp_share(0.33F + blocks + chips + 0.1F * grain - 0.3F * crack - 0.03F * worn);
  const float lichen = step_between(0.2F, 0.36F, slow + 0.25F * grain) * step_between(0.35F, 0.55F, height);
  const float tone = 0.42F + 0.1F * (block.shade - 0.5F) + 0.12F * (chip.shade - 0.5F) +
                     0.3F * (height - 0.5F) + 0.22F * grain + 0.05F * worn + 0.2F * lichen - 0.34F * crack;
  return {height, clamp_share(tone)};
}

/// The input of a row of rock: two sizes of cells, a slow noise and a fine one.
struct RockInput {
  CellRows::Row block, chip;
  const float *slow, *grain;
};

SEEDMESH_WIDE void paint_rock(const RockInput& in, int size, float* __restrict height,
                              float* __restrict tone) {
  for (int x = 0; x < size; ++x) {
    const RockPoint point = rock_point({facet(in.block, x), facet(in.chip, x)}, in.slow[x], in.grain[x]);
    height[x] = point.height;
    tone[x] = point.tone;
  }
}

}  // namespace

Relief grass_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {14, 14}, 0.1F, 0.12F, rng.at("earth"), job);
  const Pieces blades{.count = 10'500,
                      .shortest = 0.025F,
                      .longest = 0.07F,
                      .width = 0.07F,
                      .low = 0.3F,
                      .high = 1,
                      .differ = 0.62F};
  const Noise clumps(size, {11, 11}, {3, 0.6F}, 0.15F, rng.at("clumps"));
  add_blades(relief, blades, field_of(clumps, size, job), rng.at("blades"), job);
  return centred(std::move(relief), 0.57);
}

Relief soil_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {24, 24}, 0.3F, 0.22F, rng.at("earth"), job);
  const Pieces pebbles{.count = 700,
                       .shortest = 0.006F,
                       .longest = 0.04F,
                       .width = 0.6F,
                       .low = 0.25F,
                       .high = 0.9F,
                       .differ = 0.5F};
  add_stones(relief, pebbles, rng.at("pebbles"), job);
  const Pieces stalks{.count = 420,
                      .shortest = 0.02F,
                      .longest = 0.07F,
                      .width = 0.04F,
                      .low = 0.5F,
                      .high = 0.9F,
                      .differ = 0.5F};
  add_blades(relief, stalks, Field(job, size, 0), rng.at("stalks"), job);
  return centred(std::move(relief));
}

Relief rock_ground(int size, Rng rng, const Job& job) {
  const Noise slow_noise(size, {9, 9}, {3, 0.6F}, 1, rng.at("slow")),
      grain_noise(size, {36, 36}, {4, 0.7F}, 1, rng.at("grain"));
  const Field slow = field_of(slow_noise, size, job);
  const Cells blocks(size, {7, 10}, rng.at("blocks")), chips(size, {19, 25}, rng.at("chips"));
  return centred(
      paint_rows(size, Accent::none, job,
                 [&](int begin, int end, const auto& row_at) {
                   CellRows block_rows(blocks, slow, 0.16F), chip_rows(chips, slow, 0.35F);
                   NoiseRows grain_rows(grain_noise);
                   for (int y = begin; y < end; ++y) {
                     const RockInput in{block_rows.row(y), chip_rows.row(y), slow.row(y), grain_rows.row(y)};
                     const ReliefRow out = row_at(y);
                     paint_rock(in, size, out.height, out.tone);
                   }
                 }),
      0.54);
}

Relief litter_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {28, 28}, 0.16F, 0.16F, rng.at("earth"), job);
  const Field even(job, size, 0);
  const Pieces needles{.count = 12'000,
                       .shortest = 0.008F,
                       .longest = 0.022F,
                       .width = 0.06F,
                       .low = 0.3F,
                       .high = 0.95F,
                       .differ = 0.7F};
  add_blades(relief, needles, even, rng.at("needles"), job);
  const Pieces leaves{.count = 1'700,
                      .shortest = 0.012F,
                      .longest = 0.04F,
                      .width = 0.5F,
                      .low = 0.22F,
                      .high = 0.85F,
                      .differ = 0.62F};
  add_leaves(relief, leaves, rng.at("leaves"), job);
  const Pieces twigs{.count = 130,
                     .shortest = 0.04F,
                     .longest = 0.12F,
                     .width = 0.035F,
                     .low = 0.7F,
                     .high = 1,
                     .differ = 0.5F};
  add_blades(relief, twigs, even, rng.at("twigs"), job);
  return centred(std::move(relief), 0.57);
}

Relief scree_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {40, 40}, 0.12F, 0.2F, rng.at("earth"), job);
  const Pieces gravel{.count = 5'200,
                      .shortest = 0.008F,
                      .longest = 0.03F,
                      .width = 0.6F,
                      .low = 0.18F,
                      .high = 0.5F,
                      .differ = 0.5F};
  add_stones(relief, gravel, rng.at("gravel"), job);
  const Pieces stones{.count = 900,
                      .shortest = 0.02F,
                      .longest = 0.1F,
                      .width = 0.6F,
                      .low = 0.2F,
                      .high = 1,
                      .differ = 0.45F};
  add_stones(relief, stones, rng.at("stones"), job);
  return centred(std::move(relief), 0.54);
}

Relief sand_ground(int size, Rng rng, const Job& job) {
  constexpr float crests = 16;
  const Noise bend_noise(size, {8, 8}, {2, 0.5F}, 1, rng.at("bend")),
      grain_noise(size, {128, 128}, {1, 0.6F}, 1, rng.at("grain"));
  return centred(paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows bend_rows(bend_noise), grain_rows(grain_noise);
    for (int y = begin; y < end; ++y) {
      const float *bend = bend_rows.row(y), *fine = grain_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float along =
            (static_cast<float>(x) + 0.5F) / static_cast<float>(size) * crests + 0.75F * bend[x];
        const float phase = along - std::floor(along);
        // The lee side takes a third of the length.
        const float up = phase < 0.67F ? phase / 0.67F : (1 - phase) / 0.33F, round = up * up * (3 - 2 * up);
        out.height[x] = clamp_share(0.2F + 0.6F * round + 0.06F * fine[x]);
        out.tone[x] = clamp_share(0.42F + 0.16F * round + 0.3F * fine[x]);
      }
    }
  }));
}

Relief snow_ground(int size, Rng rng, const Job& job) {
  const Noise drift_noise(size, {8, 14}, {3, 0.5F}, 1, rng.at("drifts")),
      grain_noise(size, {96, 96}, {2, 0.6F}, 1, rng.at("grain"));
  return centred(paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows drift_rows(drift_noise), grain_rows(grain_noise);
    for (int y = begin; y < end; ++y) {
      const float *drifts = drift_rows.row(y), *fine = grain_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.height[x] = clamp_share(0.5F + 0.5F * drifts[x] + 0.06F * fine[x]);
        out.tone[x] = clamp_share(0.5F + 0.25F * drifts[x] + 0.3F * fine[x]);
      }
    }
  }));
}

}  // namespace seedmesh::texture
