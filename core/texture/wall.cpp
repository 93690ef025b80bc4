/// Sizes: bricks of 240 x 65 mm with joints of 10 mm (EN 771-1's common work size); roof tiles that show 300
/// mm of their length.
#include "core/texture/wall.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "core/model/model.h"
#include "core/texture/bay.h"
#include "core/texture/bond.h"
#include "core/texture/grime.h"
#include "core/texture/ground.h"
#include "core/texture/joinery.h"
#include "core/texture/noise.h"
#include "core/texture/rooms.h"
#include "core/texture/sheet_metal.h"

namespace seedmesh::texture {
namespace {

constexpr std::uint8_t grey_byte = 214;

/// Stones or bricks with joints between them. `joint` is half the width of a joint and `round` the radius of
/// worn edges, in metres.
struct Masonry {
  Bond bond;
  float joint, round;
  float differ;  ///< how far pieces differ in tone
  float rough;   ///< share of the grain in the height
};

Relief laid(const Masonry& masonry, int size, Rng rng, const Job& job) {
  const Noise grain_noise(size, {48, 48}, {2, 0.6F}, 0.6F, rng.at("grain"));
  const Noise patch_noise(size, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches"));
  const Courses courses(masonry.bond, size);
  const PieceNumbers shades(masonry.bond, rng.at("shade")), levels(masonry.bond, rng.at("level"));
  return paint_rows(size, Accent::painted, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows grain_rows(grain_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = courses.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float shade = shades.at(course, course.column[x]), level = levels.at(course, course.column[x]);
        out.tone[x] = clamp_share(0.5F + masonry.differ * (shade - 0.5F) + 0.1F * fine[x] + 0.05F * large[x]);
        out.height[x] = 0.82F + 0.12F * level;
      }
      for (int x = 0; x < size; ++x) {
        const float edge = course.to_side[x] < course.to_bed ? course.to_side[x] : course.to_bed;
        const float up = step_between(0.6F * masonry.joint, masonry.joint + masonry.round, edge);
        out.height[x] = clamp_share(up * out.height[x] + masonry.rough * fine[x]);
        out.accent[x] =
            1 - step_between(masonry.joint, masonry.joint + 0.4F * masonry.round, edge + 0.0015F * fine[x]);
      }
    }
  });
}

// A texture of 512 texels has 512 to 570 texels a metre. Tones that vary slowly are weak, because tiles of a metre repeat.
constexpr glm::dvec2 brick_tile{1, 0.9}, plaster_tile{1, 1}, roof_tile_tile{1, 0.9}, slate_tile{1, 1},
    planks_tile{1, 1}, ashlar_tile{1, 1}, concrete_tile{1, 1}, plain_tile{1, 1};

Relief brick(int size, Rng rng, const Job& job) {
  return laid({{4, 12, 0.5F, brick_tile}, 0.005F, 0.006F, 0.75F, 0.06F}, size, rng, job);
}

Relief ashlar(int size, Rng rng, const Job& job) {
  return laid({{2, 4, 0.5F, ashlar_tile}, 0.004F, 0.016F, 0.3F, 0.05F}, size, rng, job);
}

/// A surface without joints: a fine and a large noise, and how much of each is in the height and in the tone.
struct PlainSurface {
  struct Part {
    std::string_view name;  ///< of its randomness
    Lattice lattice;
    Octaves octaves;
    float amplitude, in_height, in_tone;
  };
  float height;
  Part fine, large;
};

Relief plain(const PlainSurface& surface, int size, Rng rng, const Job& job) {
  const auto noise_of = [&](const PlainSurface::Part& part) {
    return Noise(size, part.lattice, part.octaves, part.amplitude, rng.at(part.name));
  };
  const Noise fine_noise = noise_of(surface.fine), large_noise = noise_of(surface.large);
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows fine_rows(fine_noise), large_rows(large_noise);
    const auto& [height, of_fine, of_large] = surface;
    for (int y = begin; y < end; ++y) {
      const float *fine = fine_rows.row(y), *large = large_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        out.height[x] = clamp_share(height + of_fine.in_height * fine[x] + of_large.in_height * large[x]);
        out.tone[x] = clamp_share(0.5F + of_large.in_tone * large[x] + of_fine.in_tone * fine[x]);
      }
    }
  });
}

Relief plaster(int size, Rng rng, const Job& job) {
  const PlainSurface::Part grain{"grain", {40, 40}, {2, 0.6F}, 0.7F, 0.35F, 0.16F};
  const PlainSurface::Part patches{"patches", {3, 3}, {4, 0.55F}, 0.7F, 0.15F, 0.08F};
  return plain({0.6F, grain, patches}, size, rng, job);
}

/// Paint on planed wood: nearly flat, with faint marks of the brush.
Relief paint(int size, Rng rng, const Job& job) {
  const PlainSurface::Part brush{"brush", {96, 6}, {2, 0.6F}, 0.5F, 0.2F, 0.08F};
  const PlainSurface::Part patches{"patches", {5, 5}, {3, 0.55F}, 0.6F, 0.1F, 0.1F};
  return plain({0.7F, brush, patches}, size, rng, job);
}

/// Panels with the marks of their boards and pores.
Relief concrete(int size, Rng rng, const Job& job) {
  const Courses panels({1, 1, 0, concrete_tile}, size);
  const Noise grain_noise(size, {64, 64}, {2, 0.6F}, 0.6F, rng.at("grain"));
  const Noise patch_noise(size, {4, 3}, {4, 0.55F}, 0.8F, rng.at("patches"));
  const Noise pore_noise(size, {56, 56}, {1, 1}, 1, rng.at("pores"));
  const PieceNumbers shades(panels.bond(), rng.at("shade"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows grain_rows(grain_noise), patch_rows(patch_noise), pore_rows(pore_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = panels.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y), *pores = pore_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) out.tone[x] = 0.16F * (shades.at(course, course.column[x]) - 0.5F);
      for (int x = 0; x < size; ++x) {
        const float edge = course.to_side[x] < course.to_bed ? course.to_side[x] : course.to_bed;
        const float panel = step_between(0.004F, 0.012F, edge), pore = step_between(0.5F, 0.7F, pores[x]);
        out.height[x] = clamp_share(0.9F * panel - 0.3F * pore + 0.06F * fine[x]);
        out.tone[x] = clamp_share(0.5F + 0.12F * large[x] + out.tone[x] + 0.12F * fine[x] -
                                  0.35F * (1 - panel) - 0.15F * pore);
      }
    }
  });
}

/// Pantiles: a wave across, rising down the slope to the overlap with the next tile.
Relief roof_tile(int size, Rng rng, const Job& job) {
  const Courses courses({4, 3, 0, roof_tile_tile}, size);
  const Noise grain_noise(size, {32, 32}, {2, 0.6F}, 0.6F, rng.at("grain"));
  const Noise moss_noise(size, {4, 4}, {4, 0.6F}, 0.7F, rng.at("moss"));
  const PieceNumbers shades(courses.bond(), rng.at("shade"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows grain_rows(grain_noise), moss_rows(moss_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = courses.row(y);
      const float *fine = grain_rows.row(y), *moss = moss_rows.row(y);
      const ReliefRow out = row_at(y);
      const float rise = 0.2F * step_between(0, 0.05F, course.y) * (0.3F + 0.7F * course.y);
      const float under = 0.42F * (1 - step_between(0, 0.1F, course.y));  // in the shade of the tile above
      for (int x = 0; x < size; ++x) out.tone[x] = 0.26F * (shades.at(course, course.column[x]) - 0.5F);
      for (int x = 0; x < size; ++x) {
        // A trough of two thirds and a roll of one third of the width, both parabolas.
        const float across = course.x[x];
        const float trough = (across / 0.66F - 0.5F) * 2, roll = ((across - 0.66F) / 0.34F - 0.5F) * 2;
        const float low = 0.3F * trough * trough, high = 0.3F + 0.5F * (1 - roll * roll);
        out.height[x] = clamp_share(0.8F * (across < 0.66F ? low : high) + rise + 0.03F * fine[x]);
        const float side = 0.22F * (1 - step_between(0, 0.07F, std::abs(across - 0.63F)));
        out.tone[x] = clamp_share(0.52F + out.tone[x] + 0.06F * moss[x] + 0.14F * fine[x] - under - side);
      }
    }
  });
}

Relief slate(int size, Rng rng, const Job& job) {
  const Courses courses({4, 4, 0.5F, slate_tile}, size);
  const Noise grain_noise(size, {24, 48}, {2, 0.6F}, 0.6F, rng.at("grain"));
  const Noise patch_noise(size, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches"));
  const PieceNumbers shades(courses.bond(), rng.at("shade"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows grain_rows(grain_noise), patch_rows(patch_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = courses.row(y);
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y);
      const ReliefRow out = row_at(y);
      const float butt = step_between(0, 0.05F, course.y) * (0.4F + 0.5F * course.y);
      const float under = 0.4F * (1 - step_between(0, 0.08F, course.y));
      for (int x = 0; x < size; ++x) out.tone[x] = 0.34F * (shades.at(course, course.column[x]) - 0.5F);
      for (int x = 0; x < size; ++x) {
        const float gap = 1 - step_between(0.002F, 0.006F, course.to_side[x]);
        out.height[x] = clamp_share(butt * (1 - 0.6F * gap) + 0.06F * fine[x]);
        out.tone[x] =
            clamp_share(0.5F + out.tone[x] + 0.14F * fine[x] + 0.04F * large[x] - under - 0.35F * gap);
      }
    }
  });
}

/// Overlapping horizontal boards with grain.
Relief boards(const Bond& bond, int size, Rng rng, const Job& job) {
  const Courses courses(bond, size);
  const Noise line_noise(size, {4, 128}, {1, 1}, 0.6F, rng.at("grain"));
  const Noise fibre_noise(size, {10, 64}, {2, 0.6F}, 0.4F, rng.at("fibres"));
  const PieceNumbers shades(courses.bond(), rng.at("shade"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows line_rows(line_noise), fibre_rows(fibre_noise);
    for (int y = begin; y < end; ++y) {
      const Courses::Row course = courses.row(y);
      const float *lines = line_rows.row(y), *fibres = fibre_rows.row(y);
      const ReliefRow out = row_at(y);
      const float butt = step_between(0, 0.06F, course.y) * (0.25F + 0.65F * course.y);
      const float under = 0.45F * (1 - step_between(0, 0.12F, course.y));
      const float own = 0.54F + 0.4F * (shades.at(course, 0) - 0.5F) - under;
      for (int x = 0; x < size; ++x) {
        const float grain = lines[x] + fibres[x];
        const float end_of_board = 1 - step_between(0.001F, 0.004F, course.to_side[x]);
        out.height[x] = clamp_share(butt * step_between(0.001F, 0.003F, course.to_side[x]) + 0.08F * grain);
        out.tone[x] = clamp_share(own + 0.2F * grain - 0.4F * end_of_board);
      }
    }
  });
}

Relief planks(int size, Rng rng, const Job& job) {
  return boards({1, 8, 0.37F, planks_tile}, size, rng, job);
}

Relief brick_bay(int size, Rng rng, const Job& job) {
  return with_window(laid({{11, 37, 0.5F, bay_tile}, 0.006F, 0.006F, 0.6F, 0.06F}, size, rng, job), job);
}

Relief plaster_bay(int size, Rng rng, const Job& job) { return with_window(plaster(size, rng, job), job); }

Relief planks_bay(int size, Rng rng, const Job& job) {
  return with_window(boards({1, 20, 0.37F, bay_tile}, size, rng, job), job);
}

Relief ashlar_bay(int size, Rng rng, const Job& job) {
  return with_window(laid({{4, 8, 0.5F, bay_tile}, 0.005F, 0.016F, 0.3F, 0.05F}, size, rng, job), job);
}

/// One piece of stone, as of sills, lintels and steps: fine grain and small pits, without joints.
Relief dressed_stone(int size, Rng rng, const Job& job) {
  const Noise grain_noise(size, {64, 64}, {1, 1}, 0.6F, rng.at("grain"));
  const Noise patch_noise(size, {4, 4}, {4, 0.55F}, 0.7F, rng.at("patches"));
  const Noise pit_noise(size, {40, 40}, {2, 0.5F}, 1, rng.at("pits"));
  return paint_rows(size, Accent::none, job, [&](int begin, int end, const auto& row_at) {
    NoiseRows grain_rows(grain_noise), patch_rows(patch_noise), pit_rows(pit_noise);
    for (int y = begin; y < end; ++y) {
      const float *fine = grain_rows.row(y), *large = patch_rows.row(y), *pits = pit_rows.row(y);
      const ReliefRow out = row_at(y);
      for (int x = 0; x < size; ++x) {
        const float pit = step_between(0.55F, 0.8F, pits[x]);
        out.height[x] = clamp_share(0.75F + 0.12F * fine[x] - 0.4F * pit);
        out.tone[x] = clamp_share(0.5F + 0.12F * large[x] + 0.1F * fine[x] - 0.2F * pit);
      }
    }
  });
}

/// The surface course of a street: stones of 2 to 11 mm in bitumen, and faint patches. Also concrete, in lighter grey.
Relief asphalt_ground(int size, Rng rng, const Job& job) {
  const PlainSurface::Part stones{"stones", {128, 128}, {2, 0.6F}, 0.7F, 0.4F, 0.45F};
  const PlainSurface::Part patches{"patches", {10, 10}, {3, 0.55F}, 0.7F, 0.1F, 0.12F};
  return plain({0.7F, stones, patches}, size, rng, job);
}

/// Setts of 10 by 11 cm in courses (EN 1342).
Relief setts_ground(int size, Rng rng, const Job& job) {
  return laid({{18, 20, 0.5F, {ground_tile, ground_tile}}, 0.006F, 0.014F, 0.55F, 0.08F}, size, rng, job);
}

struct Painter {
  Relief (*paint)(int size, Rng rng, const Job& job);
  glm::vec3 main;     ///< sRGB bytes; of grey ones only where their grey is not the usual one
  float dark, light;  ///< as multiples of the main colour
  glm::vec3 accent;   ///< sRGB bytes; of grey ones too
  float depth;        ///< metres
  float rough_low, rough_high, rough_accent, shade;
};

constexpr WallKind kinds[] = {
    {"brick", brick_tile, false},
    {"plaster", plaster_tile, true},
    {"roof_tile", roof_tile_tile, true},
    {"slate", slate_tile, true},
    {"planks", planks_tile, true},
    {"ashlar", ashlar_tile, true},
    {"concrete", concrete_tile, true},
    {"sheet", sheet_metal_tile, true},
    {"panels", sheet_metal_tile, true},
    {"dressed_stone", plain_tile, true},
    {"paint", plain_tile, true},
    {"rooms", plain_tile, false},
    {"joinery", plain_tile, true},
    {"grime", plain_tile, false},
    {"brick_bay", bay_tile, true},
    {"plaster_bay", bay_tile, true},
    {"planks_bay", bay_tile, true},
    {"ashlar_bay", bay_tile, true},
    {"grass_ground", {ground_tile, ground_tile}, true},
    {"soil_ground", {ground_tile, ground_tile}, true},
    {"rock_ground", {ground_tile, ground_tile}, true},
    {"scree_ground", {ground_tile, ground_tile}, true},
    {"sand_ground", {ground_tile, ground_tile}, true},
    {"snow_ground", {ground_tile, ground_tile}, true},
    {"litter_ground", {ground_tile, ground_tile}, true},
    {"asphalt_ground", {ground_tile, ground_tile}, true},
    {"setts_ground", {ground_tile, ground_tile}, true},
};

constexpr Painter painters[] = {
    {brick, {150, 82, 64}, 0.62F, 1.28F, {176, 168, 156}, 0.010F, 0.97F, 0.88F, 0.97F, 0.45F},
    {plaster, {}, 0.86F, 1.1F, {}, 0.006F, 0.96F, 0.92F, 0.95F, 0.2F},
    {roof_tile, {}, 0.5F, 1.18F, {}, 0.05F, 0.92F, 0.8F, 0.9F, 0.5F},
    {slate, {}, 0.6F, 1.18F, {}, 0.012F, 0.85F, 0.65F, 0.9F, 0.4F},
    {planks, {}, 0.62F, 1.15F, {}, 0.018F, 0.9F, 0.78F, 0.9F, 0.5F},
    {ashlar, {}, 0.7F, 1.14F, {158, 156, 150}, 0.014F, 0.95F, 0.86F, 0.95F, 0.35F},
    {concrete, {}, 0.74F, 1.12F, {}, 0.008F, 0.95F, 0.85F, 0.95F, 0.3F},
    {sheet, {}, 0.8F, 1.1F, {}, 0.035F, 0.5F, 0.45F, 0.5F, 0.3F},
    {panels, {}, 0.72F, 1.08F, {}, 0.01F, 0.6F, 0.45F, 0.6F, 0.5F},
    {dressed_stone, {}, 0.74F, 1.12F, {}, 0.004F, 0.95F, 0.82F, 0.95F, 0.25F},
    {paint, {}, 0.86F, 1.08F, {}, 0.001F, 0.7F, 0.5F, 0.7F, 0.1F},
    {rooms, {54, 57, 59}, 0.55F, 2.1F, {186, 142, 84}, 0, 0.06F, 0.06F, 0.06F, 0},
    {joinery, {}, 0.66F, 1.1F, {}, 0.012F, 0.75F, 0.5F, 0.7F, 0.55F},
    {grime, {74, 68, 58}, 0.9F, 1.1F, {}, 0, 0.95F, 0.95F, 0.95F, 0},
    {brick_bay, {}, 0.66F, 1.2F, {62, 68, 72}, 0.1F, 0.97F, 0.88F, 0.35F, 0.5F},
    {plaster_bay, {}, 0.86F, 1.1F, {62, 68, 72}, 0.1F, 0.96F, 0.92F, 0.35F, 0.5F},
    {planks_bay, {}, 0.66F, 1.15F, {62, 68, 72}, 0.1F, 0.9F, 0.78F, 0.35F, 0.5F},
    {ashlar_bay, {}, 0.74F, 1.14F, {62, 68, 72}, 0.1F, 0.95F, 0.86F, 0.35F, 0.5F},
    {grass_ground, {}, 0.28F, 1.3F, {}, 0.025F, 0.98F, 0.8F, 0.9F, 0.55F},
    {soil_ground, {}, 0.42F, 1.3F, {}, 0.03F, 0.98F, 0.82F, 0.9F, 0.5F},
    {rock_ground, {}, 0.34F, 1.3F, {}, 0.03F, 0.96F, 0.75F, 0.9F, 0.55F},
    {scree_ground, {}, 0.32F, 1.3F, {}, 0.08F, 0.98F, 0.78F, 0.9F, 0.6F},
    {sand_ground, {232, 232, 232}, 0.8F, 1.1F, {}, 0.02F, 0.95F, 0.78F, 0.9F, 0.25F},
    {snow_ground, {240, 240, 240}, 0.91F, 1.08F, {}, 0.035F, 0.8F, 0.5F, 0.7F, 0.15F},
    {litter_ground, {}, 0.4F, 1.3F, {}, 0.03F, 0.98F, 0.78F, 0.9F, 0.6F},
    {asphalt_ground, {}, 0.66F, 1.2F, {}, 0.006F, 0.98F, 0.85F, 0.95F, 0.25F},
    {setts_ground, {}, 0.66F, 1.14F, {118, 112, 102}, 0.02F, 0.95F, 0.8F, 0.97F, 0.45F},
};
static_assert(std::size(kinds) == std::size(painters));

glm::vec3 of_bytes(const glm::vec3& bytes) { return bytes * (1 / 255.0F); }

/// The main tone of a grey kind, in sRGB.
std::uint8_t main_grey(const WallKind& kind) {
  const float own = painters[&kind - kinds].main.x;
  return own > 0 ? static_cast<std::uint8_t>(own) : grey_byte;
}

}  // namespace

std::span<const WallKind> wall_kinds() { return kinds; }

const WallKind* wall_kind(std::string_view name) {
  const auto* const found = std::ranges::find(kinds, name, &WallKind::name);
  return found == std::end(kinds) ? nullptr : found;
}

glm::vec3 wall_grey() { return glm::vec3(linear_of_srgb(grey_byte)); }

float grey_of(std::string_view name) {
  const WallKind* const kind = wall_kind(name);
  assert(kind != nullptr && kind->is_grey);
  return linear_of_srgb(main_grey(*kind));
}

Finish wall_finish(std::string_view name, const Tint& tint) {
  const WallKind* const kind = wall_kind(name);
  assert(kind != nullptr);
  const Painter& p = painters[kind - kinds];
  const glm::vec3 main = kind->is_grey ? glm::vec3(main_grey(*kind)) : p.main;
  Finish finish;
  finish.ramp =
      ramp_round(of_bytes(main), p.dark, p.light, of_bytes(p.accent), kind->is_grey ? Tint{} : tint);
  finish.depth = p.depth / static_cast<float>(kind->tile.x);
  finish.rough_low = p.rough_low;
  finish.rough_high = p.rough_high;
  finish.rough_accent = p.rough_accent;
  finish.shade = p.shade;
  finish.is_grey = kind->is_grey;
  finish.is_small = true;
  return finish;
}

Relief wall_relief(std::string_view name, int size, std::uint64_t seed, const Job& job) {
  const WallKind* const kind = wall_kind(name);
  assert(kind != nullptr);
  return painters[kind - kinds].paint(size, Rng::of_seed(seed).at(name), job);
}

}  // namespace seedmesh::texture
