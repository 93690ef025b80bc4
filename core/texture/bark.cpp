#include "core/texture/bark.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/base/wide.h"
#include "core/texture/cells.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

/// The fine grain of every bark, coarser along the limb than around it.
Noise grain(int size, Rng rng) { return {size, {24, 10}, {3, 0.6F}, 0.55F, rng.at("grain")}; }

/// Large patches of another tone.
Noise patches(int size, Rng rng) { return {size, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches")}; }

/// Plates between cracks, as of oak, pine and spruce.
struct Plates {
  Lattice lattice;
  Lattice wobble;
  float strength;  ///< of the wobble, in plates
  float crack;     ///< width from the bottom of a crack to the top of a plate, in plates
  float differ;    ///< how far plates differ in height and tone
  float roughen;   ///< share of the grain
};

/// The input of a row of bark: up to two sizes of cells, and noises. Barks use those that they name.
struct BarkInput {
  CellRows::Row cell, flake;
  const float *fine, *large, *gap;
};

SEEDMESH_WIDE void paint_plates(const BarkInput& in, const Plates& plates, int size, float* __restrict height,
                                float* __restrict tone) {
  for (int x = 0; x < size; ++x) {
    const float shade = in.cell.shade[x], fine = in.fine[x];
    const float flat = step_between(0.01F, plates.crack, in.cell.border[x]);
    const float own = 1 - plates.differ * shade;
    height[x] = clamp_share(flat * own * (1 - plates.roughen) +
                            plates.roughen * (0.5F + fine) * (0.35F + 0.65F * flat));
    tone[x] = clamp_share(0.08F + 0.62F * height[x] + 0.25F * fine + 0.22F * in.large[x] +
                          0.3F * plates.differ * (shade - 0.5F));
  }
}

Relief plated(const Plates& plates, int size, Rng rng, const Job& job) {
  const Field wobble = field_of({size, plates.wobble, {4, 0.55F}, 1, rng.at("wobble")}, size, job);
  const Cells cells(size, plates.lattice, rng.at("plates"));
  const Noise grain_noise = grain(size, rng), patch_noise = patches(size, rng);
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    CellRows cell_rows(cells, wobble, plates.strength);
    NoiseRows grain_rows(grain_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const BarkInput in{cell_rows.row(y), {}, grain_rows.row(y), patch_rows.row(y), nullptr};
      const ReliefRow out = row_at(y);
      paint_plates(in, plates, size, out.height, out.tone);
    }
  });
}

/// Long ridges that meet and part again, between furrows that are wide or nearly closed.
struct Ridges {
  Lattice wobble, ridges, fibres, gaps;
  float strength;  ///< of the wobble, in ridges
  float width;     ///< mean width of the slope from a furrow to a ridge, in ridges
};

SEEDMESH_WIDE void paint_ridges(const BarkInput& in, const Ridges& kind, int size, float* __restrict height,
                                float* __restrict tone) {
  for (int x = 0; x < size; ++x) {
    const float fine = in.fine[x], gap = in.gap[x], shade = in.cell.shade[x];
    const float width = kind.width + 0.3F * gap;
    const float round = step_between(-0.06F, width < 0.07F ? 0.07F : width, in.cell.border[x]);
    const float flat = round * (1 - 0.28F * shade);
    height[x] = clamp_share(0.68F * flat + 0.32F * (0.5F + fine) * (0.4F + 0.6F * round));
    tone[x] = clamp_share(0.14F + 0.5F * height[x] + 0.3F * fine + 0.12F * gap + 0.16F * (shade - 0.5F));
  }
}

Relief ridged(const Ridges& kind, int size, Rng rng, const Job& job) {
  const Field wobble = field_of({size, kind.wobble, {4, 0.6F}, 1, rng.at("wobble")}, size, job);
  const Cells ridges(size, kind.ridges, rng.at("ridges"));
  const Noise fibre_noise(size, kind.fibres, {2, 0.6F}, 0.6F, rng.at("fibres")),
      gap_noise(size, kind.gaps, {3, 0.6F}, 1, rng.at("gap"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    CellRows ridge_rows(ridges, wobble, kind.strength);
    NoiseRows fibre_rows(fibre_noise), gap_rows(gap_noise);
    for (int y = begin; y < end; ++y) {
      const BarkInput in{ridge_rows.row(y), {}, fibre_rows.row(y), nullptr, gap_rows.row(y)};
      const ReliefRow out = row_at(y);
      paint_ridges(in, kind, size, out.height, out.tone);
    }
  });
}

Relief oak(int size, Rng rng, const Job& job) {
  return ridged({{12, 5}, {13, 3}, {30, 9}, {6, 4}, 0.55F, 0.22F}, size, rng, job);
}

/// Thick ridges and wide furrows, as of old willows and ashes.
Relief willow(int size, Rng rng, const Job& job) {
  return ridged({{9, 4}, {9, 3}, {34, 10}, {7, 5}, 0.6F, 0.34F}, size, rng, job);
}

SEEDMESH_WIDE void paint_flaked_plates(const BarkInput& in, int size, float* __restrict height,
                                       float* __restrict tone) {
  for (int x = 0; x < size; ++x) {
    const float fine = in.fine[x];
    // Furrows are partly narrow, so that plates stay connected.
    const float width = 0.12F + 0.2F * (0.5F + in.gap[x]);
    const float flat = step_between(0.02F, width < 0.08F ? 0.08F : width, in.cell.border[x]);
    const float layer = 0.62F + 0.3F * in.flake.shade[x] + 0.08F * in.cell.shade[x];
    height[x] = clamp_share(flat * layer * 0.86F + 0.14F * (0.5F + fine) * (0.3F + 0.7F * flat));
    const float edge = step_between(0.0F, 0.14F, in.flake.border[x]);
    tone[x] = clamp_share(0.05F + 0.55F * height[x] + 0.07F * edge + 0.36F * fine + 0.1F * in.large[x] +
                          0.16F * (in.flake.shade[x] - 0.5F));
  }
}

/// Long plates of many sizes between deep furrows, each with overlapping thin flakes.
Relief pine(int size, Rng rng, const Job& job) {
  const Field wobble = field_of({size, {6, 3}, {5, 0.6F}, 1, rng.at("wobble")}, size, job);
  const Noise gap_noise(size, {5, 3}, {3, 0.6F}, 1, rng.at("gap"));
  const Cells plates(size, {9, 5}, rng.at("plates")), flakes(size, {18, 13}, rng.at("flakes"));
  const Noise grain_noise = grain(size, rng), patch_noise = patches(size, rng);
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    CellRows plate_rows(plates, wobble, 0.4F), flake_rows(flakes, wobble, 0.75F);
    NoiseRows gap_rows(gap_noise), grain_rows(grain_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const BarkInput in{plate_rows.row(y), flake_rows.row(y), grain_rows.row(y), patch_rows.row(y),
                         gap_rows.row(y)};
      const ReliefRow out = row_at(y);
      paint_flaked_plates(in, size, out.height, out.tone);
    }
  });
}

Relief spruce(int size, Rng rng, const Job& job) {
  return plated({{26, 22}, {18, 16}, 0.45F, 0.3F, 0.6F, 0.2F}, size, rng, job);
}

Relief birch(int size, Rng rng, const Job& job) {
  const Noise dash_noise(size, {8, 56}, {1, 1}, 1, rng.at("lenticels"));
  const Noise scar_noise(size, {3, 6}, {4, 0.6F}, 0.75F, rng.at("scars"));
  const Noise band_noise(size, {2, 18}, {3, 0.6F}, 0.5F, rng.at("bands"));
  const Noise grain_noise = grain(size, rng);
  return paint_rows(size, Accent::painted, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows dash_rows(dash_noise), scar_rows(scar_noise), band_rows(band_noise), grain_rows(grain_noise);
    for (int y = begin; y < end; ++y) {
      const float *dashes = dash_rows.row(y), *scars = scar_rows.row(y);
      const float *bands = band_rows.row(y), *fine = grain_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float scar = step_between(0.42F, 0.62F, scars[x] + 0.15F * fine[x]);
        const float lenticel = 0.8F * step_between(0.38F, 0.52F, dashes[x]);
        out.accent[x] = scar > lenticel ? scar : lenticel;
      }
      for (int x = 0; x < size; ++x) {
        out.height[x] = clamp_share(0.72F + 0.22F * bands[x] + 0.06F * fine[x] - 0.45F * out.accent[x]);
        out.tone[x] = clamp_share(0.55F + 0.5F * bands[x] + 0.25F * fine[x]);
      }
    }
  });
}

Relief beech(int size, Rng rng, const Job& job) {
  const Noise wrinkle_noise(size, {4, 22}, {3, 0.55F}, 0.5F, rng.at("wrinkles"));
  const Noise lichen_noise(size, {5, 5}, {5, 0.6F}, 0.7F, rng.at("lichen"));
  const Noise grain_noise = grain(size, rng), patch_noise = patches(size, rng);
  return paint_rows(size, Accent::painted, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows wrinkle_rows(wrinkle_noise), lichen_rows(lichen_noise), grain_rows(grain_noise),
        patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const float *wrinkles = wrinkle_rows.row(y), *lichen = lichen_rows.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.accent[x] = 0.55F * step_between(0.3F, 0.6F, lichen[x]);
        out.height[x] = clamp_share(0.6F + 0.3F * wrinkles[x] + 0.1F * fine[x] + 0.1F * out.accent[x]);
        out.tone[x] = clamp_share(0.5F + 0.18F * large[x] + 0.3F * wrinkles[x] + 0.22F * fine[x]);
      }
    }
  });
}

Relief cherry(int size, Rng rng, const Job& job) {
  const Noise dash_noise(size, {7, 34}, {1, 1}, 1, rng.at("lenticels"));
  const Noise band_noise(size, {2, 26}, {3, 0.55F}, 0.6F, rng.at("bands"));
  const Noise grain_noise = grain(size, rng), patch_noise = patches(size, rng);
  return paint_rows(size, Accent::painted, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows dash_rows(dash_noise), band_rows(band_noise), grain_rows(grain_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const float *dashes = dash_rows.row(y), *bands = band_rows.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float lenticel = step_between(0.32F, 0.5F, dashes[x]);
        out.accent[x] = 0.75F * lenticel;
        out.height[x] = clamp_share(0.45F + 0.25F * bands[x] + 0.05F * fine[x] + 0.35F * lenticel);
        out.tone[x] = clamp_share(0.45F + 0.4F * bands[x] + 0.3F * large[x] + 0.12F * fine[x]);
      }
    }
  });
}

/// Rings of leaf scars, each a step, with fibres.
Relief palm(int size, Rng rng, const Job& job) {
  constexpr float rings = 11;
  const Noise sway_noise(size, {4, 8}, {3, 0.5F}, 0.35F, rng.at("sway"));
  const Noise fibre_noise(size, {64, 4}, {2, 0.6F}, 0.6F, rng.at("fibres"));
  const Noise patch_noise = patches(size, rng);
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows sway_rows(sway_noise), fibre_rows(fibre_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const float *sway = sway_rows.row(y), *fibres = fibre_rows.row(y), *large = patch_rows.row(y);
      const float at = static_cast<float>(y) * rings / static_cast<float>(size);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float phase = at + sway[x], within = phase - std::floor(phase);
        const float rising = 0.35F + 0.65F * within / 0.82F;
        const float falling = 1 - step_between(0.82F, 1, within) * 0.65F;
        out.height[x] = clamp_share(0.85F * (within < 0.82F ? rising : falling) + 0.15F * (0.5F + fibres[x]));
        out.tone[x] = clamp_share(0.12F + 0.55F * out.height[x] + 0.3F * fibres[x] + 0.2F * large[x]);
      }
    }
  });
}

/// Long loose strips, as of cedars.
Relief cedar(int size, Rng rng, const Job& job) {
  const Noise strip_noise(size, {22, 2}, {1, 1}, 0.7F, rng.at("strips"), Fold::ridge);
  const Noise thread_noise(size, {44, 4}, {1, 1}, 0.3F, rng.at("threads"), Fold::ridge);
  const Noise grain_noise = grain(size, rng), patch_noise = patches(size, rng);
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows strip_rows(strip_noise), thread_rows(thread_noise), grain_rows(grain_noise),
        patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const float *strips = strip_rows.row(y), *threads = thread_rows.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.height[x] =
            clamp_share(step_between(0.4F, 1, strips[x] + threads[x]) * 0.85F + 0.15F * (0.5F + fine[x]));
        out.tone[x] = clamp_share(0.15F + 0.55F * out.height[x] + 0.2F * fine[x] + 0.3F * large[x]);
      }
    }
  });
}

/// Makes the strips from the left edge to a half, a quarter and so on tile: their right edge fades to what is at the
/// edge of the image, on both sides. The edge itself stays.
void repeat_edge(Field& field, const Job& job) {
  constexpr float widest = 0.03F;  // of the fading on each side, as a share of the width
  const int size = field.size();
  struct Strip {
    int edge, reach;
    std::vector<float> shares;  ///< of the edge of the image, by distance
  };
  std::vector<Strip> strips;
  for (float strip = 0.5F; strip >= least_bark_strip; strip *= 0.5F) {
    const float reach = std::min(widest, 0.5F * strip) * static_cast<float>(size);
    strips.push_back({static_cast<int>(strip * static_cast<float>(size)), static_cast<int>(reach), {}});
    for (int off = 0; off <= strips.back().reach; ++off)
      strips.back().shares.push_back(1 - step_between(0, std::max(reach, 1.0F), static_cast<float>(off)));
  }
  for_rows(job, size, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* row = field.row(y);
      for (const auto& [edge, reach, shares] : strips) {
        for (int off = -reach; off <= reach; ++off) {
          float& texel = row[edge + off];
          texel += shares[static_cast<std::size_t>(std::abs(off))] * (row[(off + size) % size] - texel);
        }
      }
    }
  });
}

struct Kind {
  std::string_view name;
  Relief (*paint)(int size, Rng rng, const Job& job);
  glm::vec3 main;     ///< sRGB bytes
  float dark, light;  ///< the other two as multiples
  glm::vec3 accent;   ///< sRGB bytes
  float depth;
  float rough_low, rough_high, rough_accent, shade;
};

constexpr Kind kinds[] = {
    {"oak_bark", oak, {158, 145, 128}, 0.42F, 1.3F, {96, 110, 70}, 0.024F, 0.98F, 0.78F, 0.95F, 0.5F},
    {"pine_bark", pine, {174, 126, 95}, 0.46F, 1.35F, {170, 120, 80}, 0.024F, 0.98F, 0.8F, 0.9F, 0.5F},
    {"spruce_bark", spruce, {140, 119, 101}, 0.45F, 1.35F, {120, 120, 100}, 0.013F, 0.97F, 0.76F, 0.9F, 0.6F},
    {"willow_bark", willow, {142, 130, 110}, 0.34F, 1.35F, {110, 120, 80}, 0.03F, 0.98F, 0.79F, 0.95F, 0.7F},
    {"birch_bark", birch, {206, 200, 188}, 0.82F, 1.12F, {44, 38, 34}, 0.012F, 0.9F, 0.6F, 0.95F, 0.35F},
    {"beech_bark", beech, {134, 132, 124}, 0.72F, 1.22F, {150, 158, 128}, 0.018F, 0.95F, 0.68F, 0.95F, 0.2F},
    {"cherry_bark", cherry, {104, 62, 50}, 0.62F, 1.45F, {168, 124, 96}, 0.012F, 0.7F, 0.42F, 0.9F, 0.4F},
    {"palm_bark", palm, {142, 122, 96}, 0.45F, 1.30F, {110, 90, 60}, 0.035F, 0.98F, 0.78F, 0.95F, 0.6F},
    {"cedar_bark", cedar, {128, 92, 74}, 0.42F, 1.35F, {120, 100, 80}, 0.025F, 0.97F, 0.77F, 0.95F, 0.6F},
};

constexpr auto names = [] {
  std::array<std::string_view, std::size(kinds)> made;
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = kinds[i].name;
  return made;
}();

glm::vec3 of_bytes(const glm::vec3& bytes) { return bytes * (1 / 255.0F); }

const Kind& kind_named(std::string_view name) {
  const auto* const found = std::ranges::find(kinds, name, &Kind::name);
  assert(found != std::end(kinds));
  return *found;
}

glm::vec3 at_most_white(const glm::vec3& color) { return glm::min(color, glm::vec3(1)); }

}  // namespace

std::span<const std::string_view> bark_kinds() { return names; }

Ramp ramp_round(glm::vec3 main, float dark, float light, glm::vec3 accent, const Tint& tint) {
  if (tint) main = of_bytes({(*tint)[0], (*tint)[1], (*tint)[2]});
  return {main * dark, main, at_most_white(main * light), accent};
}

Finish bark_finish(std::string_view kind, const Tint& tint) {
  const Kind& k = kind_named(kind);
  Finish finish;
  finish.ramp = ramp_round(of_bytes(k.main), k.dark, k.light, of_bytes(k.accent), tint);
  finish.depth = k.depth;
  finish.rough_low = k.rough_low;
  finish.rough_high = k.rough_high;
  finish.rough_accent = k.rough_accent;
  finish.shade = k.shade;
  return finish;
}

Relief bark_relief(std::string_view kind, int size, std::uint64_t seed, const Job& job) {
  Relief relief = kind_named(kind).paint(size, Rng::of_seed(seed).at(kind), job);
  repeat_edge(relief.height, job);
  repeat_edge(relief.tone, job);
  if (relief.accent.size() > 1) repeat_edge(relief.accent, job);
  return relief;
}

}  // namespace seedmesh::texture
