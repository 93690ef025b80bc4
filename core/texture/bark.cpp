#include "core/texture/bark.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::texture {
namespace {

Relief bare(int size, const Job& job) {
  return {Field(job, size), Field(job, size, 0.5F), Field(job, size), Field(job, 1, 1)};
}

float clamp(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/// The fine grain of every bark, coarser along the limb than around it.
Field grain(int size, Rng rng, const Job& job) {
  Field field(job, size);
  add_noise(field, {24, 10}, {3, 0.6F}, 0.55F, rng.at("grain"), job);
  return field;
}

/// Large patches of another tone.
Field patches(int size, Rng rng, const Job& job) {
  Field field(job, size);
  add_noise(field, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches"), job);
  return field;
}

/// Plates between cracks, as of oak, pine and spruce.
struct Plates {
  Lattice lattice;
  Lattice wobble;
  float strength;  ///< of the wobble, in plates
  float crack;     ///< width from the bottom of a crack to the top of a plate, in plates
  float differ;    ///< how far plates differ in height and tone
  float roughen;   ///< share of the grain
};

Relief plated(const Plates& plates, int size, Rng rng, const Job& job) {
  Field wobble(job, size);
  add_noise(wobble, plates.wobble, {4, 0.55F}, 1, rng.at("wobble"), job);
  const Cells cell = cells(size, plates.lattice, rng.at("plates"), &wobble, plates.strength, job);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const float flat = step_between(0.01F, plates.crack, cell.border.row(y)[x]);
    const float own = 1 - plates.differ * cell.shade.row(y)[x];
    return clamp(flat * own * (1 - plates.roughen) +
                 plates.roughen * (0.5F + fine.row(y)[x]) * (0.35F + 0.65F * flat));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const float height = relief.height.row(y)[x];
    return clamp(0.08F + 0.62F * height + 0.25F * fine.row(y)[x] + 0.22F * large.row(y)[x] +
                 0.3F * plates.differ * (cell.shade.row(y)[x] - 0.5F));
  });
  return relief;
}

Relief oak(int size, Rng rng, const Job& job) {
  return plated({{9, 3}, {10, 4}, 0.34F, 0.4F, 0.3F, 0.25F}, size, rng, job);
}

/// Long plates of many sizes between deep furrows, each with overlapping thin flakes.
Relief pine(int size, Rng rng, const Job& job) {
  Field wobble(job, size), gap(job, size);
  add_noise(wobble, {6, 3}, {5, 0.6F}, 1, rng.at("wobble"), job);
  add_noise(gap, {5, 3}, {3, 0.6F}, 1, rng.at("gap"), job);
  const Cells plate = cells(size, {7, 3}, rng.at("plates"), &wobble, 0.4F, job);
  const Cells flake = cells(size, {16, 9}, rng.at("flakes"), &wobble, 0.75F, job);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    // Furrows are partly narrow, so that plates stay connected.
    const float width = 0.12F + 0.2F * (0.5F + gap.row(y)[x]);
    const float flat = step_between(0.02F, std::max(0.08F, width), plate.border.row(y)[x]);
    const float layer = 0.62F + 0.3F * flake.shade.row(y)[x] + 0.08F * plate.shade.row(y)[x];
    return clamp(flat * layer * 0.86F + 0.14F * (0.5F + fine.row(y)[x]) * (0.3F + 0.7F * flat));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const float edge = step_between(0.0F, 0.14F, flake.border.row(y)[x]);
    return clamp(0.05F + 0.55F * relief.height.row(y)[x] + 0.07F * edge + 0.22F * fine.row(y)[x] +
                 0.3F * large.row(y)[x] + 0.16F * (flake.shade.row(y)[x] - 0.5F));
  });
  return relief;
}

Relief spruce(int size, Rng rng, const Job& job) {
  return plated({{14, 14}, {12, 12}, 0.3F, 0.3F, 0.6F, 0.2F}, size, rng, job);
}

/// A net of ridges around long furrows, as of old willows and ashes: raised borders of cells.
Relief willow(int size, Rng rng, const Job& job) {
  Field wobble(job, size);
  add_noise(wobble, {8, 4}, {4, 0.55F}, 1, rng.at("wobble"), job);
  const Cells cell = cells(size, {10, 3}, rng.at("furrows"), &wobble, 0.3F, job);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const float depth =
        step_between(0.06F, 0.36F, cell.border.row(y)[x] * (0.8F + 0.4F * cell.shade.row(y)[x]));
    return clamp((1 - depth) * 0.78F + 0.22F * (0.5F + fine.row(y)[x]));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.08F + 0.62F * relief.height.row(y)[x] + 0.25F * fine.row(y)[x] + 0.2F * large.row(y)[x]);
  });
  return relief;
}

/// Long thin marks around the limb, where the noise is above `from`.
Field dashes(int size, Lattice lattice, float from, float to, Rng rng, const Job& job) {
  Field field(job, size);
  add_noise(field, lattice, 1, rng, job);
  field.each(job, [&](float n, int, int) { return step_between(from, to, n); });
  return field;
}

Relief birch(int size, Rng rng, const Job& job) {
  const Field lenticels = dashes(size, {8, 56}, 0.38F, 0.52F, rng.at("lenticels"), job);
  Field scars(job, size);
  add_noise(scars, {3, 6}, {4, 0.6F}, 0.75F, rng.at("scars"), job);
  Field bands(job, size);
  add_noise(bands, {2, 18}, {3, 0.6F}, 0.5F, rng.at("bands"), job);
  const Field fine = grain(size, rng, job);
  Relief relief = bare(size, job);
  relief.accent.each(job, [&](float, int x, int y) {
    const float scar = step_between(0.42F, 0.62F, scars.row(y)[x] + 0.15F * fine.row(y)[x]);
    return clamp(std::max(scar, 0.8F * lenticels.row(y)[x]));
  });
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.72F + 0.22F * bands.row(y)[x] + 0.06F * fine.row(y)[x] - 0.45F * relief.accent.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.55F + 0.5F * bands.row(y)[x] + 0.25F * fine.row(y)[x]);
  });
  return relief;
}

Relief beech(int size, Rng rng, const Job& job) {
  Field wrinkles(job, size);
  add_noise(wrinkles, {4, 22}, {3, 0.55F}, 0.5F, rng.at("wrinkles"), job);
  Field lichen(job, size);
  add_noise(lichen, {5, 5}, {5, 0.6F}, 0.7F, rng.at("lichen"), job);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.accent.each(job,
                     [&](float, int x, int y) { return 0.55F * step_between(0.3F, 0.6F, lichen.row(y)[x]); });
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.6F + 0.3F * wrinkles.row(y)[x] + 0.1F * fine.row(y)[x] + 0.1F * relief.accent.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.5F + 0.45F * large.row(y)[x] + 0.25F * wrinkles.row(y)[x] + 0.15F * fine.row(y)[x]);
  });
  return relief;
}

Relief cherry(int size, Rng rng, const Job& job) {
  const Field lenticels = dashes(size, {7, 34}, 0.32F, 0.5F, rng.at("lenticels"), job);
  Field bands(job, size);
  add_noise(bands, {2, 26}, {3, 0.55F}, 0.6F, rng.at("bands"), job);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.accent.each(job, [&](float, int x, int y) { return 0.75F * lenticels.row(y)[x]; });
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.45F + 0.25F * bands.row(y)[x] + 0.05F * fine.row(y)[x] + 0.35F * lenticels.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.45F + 0.4F * bands.row(y)[x] + 0.3F * large.row(y)[x] + 0.12F * fine.row(y)[x]);
  });
  return relief;
}

/// Rings of leaf scars, each a step, with fibres.
Relief palm(int size, Rng rng, const Job& job) {
  constexpr float rings = 11;
  Field sway(job, size);
  add_noise(sway, {4, 8}, {3, 0.5F}, 0.35F, rng.at("sway"), job);
  Field fibres(job, size);
  add_noise(fibres, {64, 4}, {2, 0.6F}, 0.6F, rng.at("fibres"), job);
  const Field large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const float phase = static_cast<float>(y) * rings / static_cast<float>(size) + sway.row(y)[x];
    const float within = phase - std::floor(phase);
    const float ring =
        within < 0.82F ? 0.35F + 0.65F * within / 0.82F : 1 - step_between(0.82F, 1, within) * 0.65F;
    return clamp(0.85F * ring + 0.15F * (0.5F + fibres.row(y)[x]));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.12F + 0.55F * relief.height.row(y)[x] + 0.3F * fibres.row(y)[x] + 0.2F * large.row(y)[x]);
  });
  return relief;
}

/// Long loose strips, as of cedars.
Relief cedar(int size, Rng rng, const Job& job) {
  Field strips(job, size);
  add_noise(strips, {22, 2}, 0.7F, rng.at("strips"), job, Fold::ridge);
  add_noise(strips, {44, 4}, 0.3F, rng.at("threads"), job, Fold::ridge);
  const Field fine = grain(size, rng, job), large = patches(size, rng, job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(step_between(0.4F, 1, strips.row(y)[x]) * 0.85F + 0.15F * (0.5F + fine.row(y)[x]));
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.15F + 0.55F * relief.height.row(y)[x] + 0.2F * fine.row(y)[x] + 0.3F * large.row(y)[x]);
  });
  return relief;
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
    {"oak_bark", oak, {124, 106, 86}, 0.40F, 1.45F, {96, 110, 70}, 0.045F, 0.98F, 0.88F, 0.95F, 0.7F},
    {"pine_bark", pine, {140, 92, 64}, 0.28F, 1.40F, {170, 120, 80}, 0.040F, 0.98F, 0.85F, 0.9F, 0.75F},
    {"spruce_bark", spruce, {116, 90, 74}, 0.38F, 1.35F, {120, 120, 100}, 0.022F, 0.97F, 0.88F, 0.9F, 0.6F},
    {"willow_bark", willow, {122, 110, 90}, 0.32F, 1.40F, {110, 120, 80}, 0.045F, 0.98F, 0.88F, 0.95F, 0.7F},
    {"birch_bark", birch, {214, 208, 196}, 0.82F, 1.12F, {44, 38, 34}, 0.012F, 0.9F, 0.6F, 0.95F, 0.35F},
    {"beech_bark", beech, {134, 132, 124}, 0.72F, 1.22F, {150, 158, 128}, 0.010F, 0.9F, 0.75F, 0.95F, 0.3F},
    {"cherry_bark", cherry, {104, 62, 50}, 0.62F, 1.45F, {168, 124, 96}, 0.012F, 0.7F, 0.42F, 0.9F, 0.4F},
    {"palm_bark", palm, {142, 122, 96}, 0.45F, 1.30F, {110, 90, 60}, 0.035F, 0.98F, 0.86F, 0.95F, 0.6F},
    {"cedar_bark", cedar, {128, 92, 74}, 0.42F, 1.35F, {120, 100, 80}, 0.025F, 0.97F, 0.85F, 0.95F, 0.6F},
};

constexpr auto names = [] {
  std::array<std::string_view, std::size(kinds)> made;
  for (std::size_t i = 0; i < made.size(); ++i) made[i] = kinds[i].name;
  return made;
}();

glm::vec3 of_bytes(const glm::vec3& bytes) { return bytes * (1 / 255.0F); }

glm::vec3 at_most_white(const glm::vec3& color) { return glm::min(color, glm::vec3(1)); }

}  // namespace

std::span<const std::string_view> bark_kinds() { return names; }

Ramp ramp_round(glm::vec3 main, float dark, float light, glm::vec3 accent, const Tint& tint) {
  if (tint) main = of_bytes({(*tint)[0], (*tint)[1], (*tint)[2]});
  return {main * dark, main, at_most_white(main * light), accent};
}

Painting paint_bark(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job) {
  const auto found =
      std::find_if(std::begin(kinds), std::end(kinds), [&](const Kind& k) { return k.name == kind; });
  assert(found != std::end(kinds));
  const Kind& k = *found;
  Finish finish;
  finish.ramp = ramp_round(of_bytes(k.main), k.dark, k.light, of_bytes(k.accent), tint);
  finish.depth = k.depth;
  finish.rough_low = k.rough_low;
  finish.rough_high = k.rough_high;
  finish.rough_accent = k.rough_accent;
  finish.shade = k.shade;
  return {k.paint(size, Rng::of_seed(seed).at(kind), job), finish};
}

}  // namespace seedmesh::texture
