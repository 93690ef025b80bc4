#include "core/texture/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/math.h"
#include "core/texture/cells.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

constexpr int pieces_a_look = 256;

/// Shifts the tones to a mean, so that vertex colours keep their brightness. It is above 0.5 where dark tones are
/// darker than light ones are light.
Relief centred(Relief relief, double mean = 0.5) {
  const int size = relief.tone.size();
  double sum = 0;
  for (int y = 0; y < size; ++y) {
    const float* row = relief.tone.row(y);
    for (int x = 0; x < size; ++x) sum += static_cast<double>(row[x]);
  }
  const auto by = static_cast<float>(mean - sum / (static_cast<double>(size) * size));
  for (int y = 0; y < size; ++y) {
    float* row = relief.tone.row(y);
    for (int x = 0; x < size; ++x) row[x] = clamp_share(row[x] + by);
  }
  return relief;
}

/// A piece that lies on the ground: an ellipse about `at`, in shares of the image.
struct Patch {
  glm::vec2 at{0}, along{1, 0};  ///< `along`: unit direction of the long axis
  float half_length = 0.01F, half_width = 0.01F;
};

/// The texels of the rows of a long narrow patch: those within `half` of a middle that moves with the row.
class Strip {
 public:
  /// |slope * x + across * y| <= most. Texels beyond the strip may be included.
  Strip(float slope, float across, float most) {
    constexpr float level = 1e-3F;  // smaller slopes would lose the digits
    if (std::abs(slope) < level) return;
    shift_ = -across / slope;
    half_ = std::abs(most / slope);
  }
  float low(float y) const { return shift_ * y - half_; }
  float high(float y) const { return shift_ * y + half_; }

 private:
  float shift_ = 0, half_ = 1e9F;
};

/// The floor of a coordinate in texels. std::floor is a call where the processor may lack the instruction.
int floor_of(float v) {
  constexpr float below = 8192;  // patches begin less than an image before it
  return static_cast<int>(v + below) - static_cast<int>(below);
}

/// Calls body(x, y, a, b) for the texels of a patch, with their coordinates -1 .. 1 along both axes. x and y may lie
/// beyond the image, which repeats.
template <class Body>
void each_texel(const Patch& patch, int size, Body&& body) {
  const auto scale = static_cast<float>(size);
  const float length = std::max(patch.half_length * scale, 0.5F),
              width = std::max(patch.half_width * scale, 0.5F);
  const glm::vec2 middle = patch.at * scale, along = patch.along * (1 / length),
                  across = glm::vec2(-patch.along.y, patch.along.x) * (1 / width);
  const float reach_x = std::abs(patch.along.x) * length + std::abs(patch.along.y) * width,
              reach_y = std::abs(patch.along.y) * length + std::abs(patch.along.x) * width;
  const Strip lengthwise(patch.along.x, patch.along.y, length),
      crosswise(-patch.along.y, patch.along.x, width);
  const int last_y = floor_of(middle.y + reach_y);
  for (int y = floor_of(middle.y - reach_y); y <= last_y; ++y) {
    const float off_y = static_cast<float>(y) + 0.5F - middle.y;
    // The middles of texels are half a texel after their numbers; the rest is for rounding.
    const float low = std::max({-reach_x, lengthwise.low(off_y), crosswise.low(off_y)}) - 0.6F,
                high = std::min({reach_x, lengthwise.high(off_y), crosswise.high(off_y)}) - 0.4F;
    const int last_x = floor_of(middle.x + high);
    for (int x = floor_of(middle.x + low); x <= last_x; ++x) {
      const float off_x = static_cast<float>(x) + 0.5F - middle.x;
      const float a = off_x * along.x + off_y * along.y, b = off_x * across.x + off_y * across.y;
      if (std::abs(a) <= 1 && std::abs(b) <= 1) body(x, y, a, b);
    }
  }
}

glm::vec2 direction(float turns) {
  const math::SinCos turn = math::sincos(2 * math::pi * static_cast<double>(turns));
  return {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

/// A number of pieces of one kind, drawn one over the other. Lengths are shares of the image.
struct Litter {
  int count = 0;
  float shortest = 0, longest = 0;
  float width = 0.1F;       ///< by length
  float low = 0, high = 1;  ///< heights of the middle
  float differ = 0.5F;      ///< of the tones
};

/// Returns the numbers of the pieces from the highest to the lowest. Each texel shows its highest piece, so the order
/// changes nothing but the time: most texels of the lower pieces are hidden already.
template <class Piece>
std::vector<std::uint32_t> from_the_highest(const std::vector<Piece>& pieces) {
  std::vector<std::uint32_t> order(pieces.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return pieces[a].high > pieces[b].high; });
  return order;
}

float draw(Rng& rng, float low, float high) {
  return static_cast<float>(rng.uniform(static_cast<double>(low), static_cast<double>(high)));
}

struct Blade {
  Patch patch;
  float high, tone;
};

Blade blade_of(const Litter& litter, const Field& clumps, Rng own) {
  Blade blade;
  Patch& patch = blade.patch;
  const float x = draw(own, 0, 1);
  patch.at = {x, draw(own, 0, 1)};
  patch.along = direction(draw(own, 0, 1));
  patch.half_length = 0.5F * draw(own, litter.shortest, litter.longest);
  patch.half_width = patch.half_length * litter.width;
  blade.high = draw(own, litter.low, litter.high);
  const glm::vec2 there = patch.at * static_cast<float>(clumps.size());
  blade.tone = 0.5F + litter.differ * draw(own, -0.5F, 0.5F) +
               clumps.at(static_cast<int>(there.x), static_cast<int>(there.y));
  return blade;
}

/// Blades and stalks: the higher covers the lower; darker towards their base. `clumps` is added to the tones.
void add_blades(Relief& relief, const Litter& litter, const Field& clumps, Rng rng, const Job& job) {
  const int size = relief.height.size();
  std::vector<Blade> blades;
  blades.reserve(static_cast<std::size_t>(litter.count));
  for (int i = 0; i < litter.count; ++i)
    blades.push_back(blade_of(litter, clumps, rng.at(static_cast<std::uint64_t>(i))));
  int drawn = 0;
  for (const std::uint32_t i : from_the_highest(blades)) {
    if (drawn++ % pieces_a_look == 0) job.check();
    const float middle = blades[i].high, tone = blades[i].tone;
    each_texel(blades[i].patch, size, [&](int x, int y, float a, float b) {
      float& there = relief.height.at(x, y);
      if (middle <= there) return;
      const float across = std::abs(b) / std::max(0.25F, 1 - 0.7F * std::max(a, 0.0F));
      if (across > 1) return;
      const float height =
          middle * (0.55F + 0.45F * (1 - 0.5F * (1 - a) * (1 - a) * 0.5F)) * (1 - 0.3F * across);
      if (height <= there) return;
      there = height;
      relief.tone.at(x, y) = tone + 0.12F * a - 0.08F * across - 0.42F * (1 - middle);
    });
  }
}

struct Stone {
  Patch patch;
  std::array<glm::vec3, 5> planes;  ///< that cut the dome: direction and distance
  float high, tone;
};

Stone stone_of(const Litter& litter, Rng own) {
  Stone stone;
  Patch& patch = stone.patch;
  const float x = draw(own, 0, 1);
  patch.at = {x, draw(own, 0, 1)};
  patch.along = direction(draw(own, 0, 1));
  const float random = draw(own, 0, 1);  // small ones are more frequent
  patch.half_length =
      0.5F * (litter.shortest + (litter.longest - litter.shortest) * random * random * random);
  patch.half_width = patch.half_length * draw(own, litter.width, 1);
  for (glm::vec3& plane : stone.planes) {
    const glm::vec2 side = direction(draw(own, 0, 1));
    plane = {side.x, side.y, draw(own, 0.35F, 0.75F)};
  }
  const float size_share = patch.half_length / (0.5F * litter.longest);
  stone.high = litter.low + (litter.high - litter.low) * (0.35F + 0.65F * size_share);
  stone.tone = 0.5F + litter.differ * draw(own, -0.5F, 0.5F);
  return stone;
}

/// Stones: domes cut by a few planes, each with a tone of its own, darker towards their foot.
void add_stones(Relief& relief, const Litter& litter, Rng rng, const Job& job) {
  const int size = relief.height.size();
  std::vector<Stone> stones;
  stones.reserve(static_cast<std::size_t>(litter.count));
  for (int i = 0; i < litter.count; ++i)
    stones.push_back(stone_of(litter, rng.at(static_cast<std::uint64_t>(i))));
  int drawn = 0;
  for (const std::uint32_t i : from_the_highest(stones)) {
    if (drawn++ % pieces_a_look == 0) job.check();
    const Stone& stone = stones[i];
    const float rise = stone.high - litter.low;
    each_texel(stone.patch, size, [&](int x, int y, float a, float b) {
      float& there = relief.height.at(x, y);
      if (stone.high <= there) return;
      float up = std::sqrt(std::max(0.0F, 1 - a * a - b * b));
      // Cuts only make a stone lower.
      if (up <= 0 || litter.low + rise * up <= there) return;
      float facet = 0;
      for (const glm::vec3& plane : stone.planes) {
        const float bound = (plane.z * 1.25F - a * plane.x - b * plane.y) * 1.6F;
        if (bound < up) {
          up = bound;
          facet = plane.x;
        }
      }
      const float height = litter.low + rise * up;
      if (up <= 0 || height <= there) return;
      there = height;
      relief.tone.at(x, y) = stone.tone + 0.1F * facet - 0.25F * (1 - std::min(1.0F, 2 * up));
    });
  }
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

}  // namespace

Relief grass_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {14, 14}, 0.1F, 0.12F, rng.at("earth"), job);
  const Litter blades{.count = 10'500,
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
  const Litter pebbles{.count = 700,
                       .shortest = 0.006F,
                       .longest = 0.04F,
                       .width = 0.6F,
                       .low = 0.25F,
                       .high = 0.9F,
                       .differ = 0.5F};
  add_stones(relief, pebbles, rng.at("pebbles"), job);
  const Litter stalks{.count = 420,
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
  const Noise warp_noise(size, {9, 9}, {3, 0.6F}, 1, rng.at("warp")),
      pit_noise(size, {32, 32}, {3, 0.6F}, 1, rng.at("pits"));
  const Field warp = field_of(warp_noise, size, job);
  const Cells plates(size, {9, 14}, rng.at("plates")), chips(size, {19, 27}, rng.at("chips"));
  return centred(
      paint_rows(size, Accent::none, job,
                 [&](int begin, int end, const auto& row_at) {
                   CellRows plate_rows(plates, warp, 0.7F), chip_rows(chips, warp, 1);
                   NoiseRows pit_rows(pit_noise);
                   for (int y = begin; y < end; ++y) {
                     const CellRows::Row plate = plate_rows.row(y), chip = chip_rows.row(y);
                     const float* pits = pit_rows.row(y);
                     const ReliefRow out = row_at(y);
                     for (int x = 0; x < size; ++x) {
                       const float crack = step_between(0, 0.08F, plate.border[x]),
                                   edge = step_between(0, 0.16F, chip.border[x]);
                       out.height[x] = clamp_share(crack * (0.35F + 0.35F * plate.shade[x]) +
                                                   edge * (0.06F + 0.16F * chip.shade[x]) + 0.08F * pits[x]);
                       // Cracks are shown by their relief; lines of another tone would look like veins.
                       out.tone[x] = clamp_share(0.3F + 0.1F * crack + 0.14F * plate.shade[x] +
                                                 0.22F * chip.shade[x] + 0.04F * edge + 0.26F * pits[x]);
                     }
                   }
                 }),
      0.54);
}

Relief scree_ground(int size, Rng rng, const Job& job) {
  Relief relief = grained(size, {40, 40}, 0.12F, 0.2F, rng.at("earth"), job);
  const Litter gravel{.count = 5'200,
                      .shortest = 0.008F,
                      .longest = 0.03F,
                      .width = 0.6F,
                      .low = 0.18F,
                      .high = 0.5F,
                      .differ = 0.5F};
  add_stones(relief, gravel, rng.at("gravel"), job);
  const Litter stones{.count = 900,
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
