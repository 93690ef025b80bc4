/// Sizes: bricks of 240 x 65 mm with joints of 10 mm (EN 771-1's common work size); roof tiles that show 300
/// mm of their length.
#include "core/texture/wall.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/model/model.h"
#include "core/texture/ground.h"

namespace seedmesh::texture {
namespace {

constexpr std::uint8_t grey_byte = 214;

Relief bare(int size, const Job& job) {
  return {Field(job, size), Field(job, size, 0.5F), Field(job, size), Field(job, 1, 1)};
}

float clamp(float x) { return x < 0 ? 0 : x > 1 ? 1 : x; }

/// A position in a pattern of pieces: the piece, the position in it, and its random numbers.
struct Course {
  int row = 0, column = 0;
  float x = 0, y = 0;             ///< within, 0 .. 1; y down
  float to_side = 0, to_bed = 0;  ///< metres to the nearest upright and level border
};

/// Rows and columns of equal pieces; every other row is shifted by `shift` of a piece.
struct Bond {
  int columns = 8, rows = 24;
  float shift = 0.5F;
  glm::dvec2 tile{1};

  Course at(int x, int y, int size) const {
    const auto extent = static_cast<float>(size);
    const float v = (static_cast<float>(y) + 0.5F) * static_cast<float>(rows) / extent;
    Course course;
    course.row = static_cast<int>(v);
    const float moved = course.row % 2 == 1 ? shift : 0;
    const float u = (static_cast<float>(x) + 0.5F) * static_cast<float>(columns) / extent + moved;
    course.column = static_cast<int>(u) % columns;
    course.x = u - std::floor(u);
    course.y = v - std::floor(v);
    const auto width = static_cast<float>(tile.x / columns), height = static_cast<float>(tile.y / rows);
    course.to_side = std::min(course.x, 1 - course.x) * width;
    course.to_bed = std::min(course.y, 1 - course.y) * height;
    return course;
  }
};

/// A random number of each piece, by its position.
float chance(Rng rng, const Course& course) {
  return static_cast<float>(
      Rng(rng.at(static_cast<std::uint64_t>(course.row)).at(static_cast<std::uint64_t>(course.column)).key())
          .unit());
}

Field noise(int size, Lattice lattice, Octaves octaves, float amplitude, Rng rng, const Job& job) {
  Field field(job, size);
  add_noise(field, lattice, octaves, amplitude, rng, job);
  return field;
}

/// Stones or bricks with joints between them. `joint` is half the width of a joint and `round` the radius of
/// worn edges, in metres.
struct Masonry {
  Bond bond;
  float joint, round;
  float differ;  ///< how far pieces differ in tone
  float rough;   ///< share of the grain in the height
};

Relief laid(const Masonry& masonry, int size, Rng rng, const Job& job) {
  const Field fine = noise(size, {48, 48}, {2, 0.6F}, 0.6F, rng.at("grain"), job);
  const Field large = noise(size, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches"), job);
  const Rng shade = rng.at("shade"), level = rng.at("level");
  Relief relief = bare(size, job);
  relief.accent.each(job, [&](float, int x, int y) {
    const Course c = masonry.bond.at(x, y, size);
    const float edge = std::min(c.to_side, c.to_bed) + 0.0015F * fine.row(y)[x];
    return 1 - step_between(masonry.joint, masonry.joint + 0.4F * masonry.round, edge);
  });
  relief.height.each(job, [&](float, int x, int y) {
    const Course c = masonry.bond.at(x, y, size);
    const float edge = std::min(c.to_side, c.to_bed);
    const float up = step_between(0.6F * masonry.joint, masonry.joint + masonry.round, edge);
    return clamp(up * (0.82F + 0.12F * chance(level, c)) + masonry.rough * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const Course c = masonry.bond.at(x, y, size);
    return clamp(0.5F + masonry.differ * (chance(shade, c) - 0.5F) + 0.12F * fine.row(y)[x] +
                 0.14F * large.row(y)[x]);
  });
  return relief;
}

constexpr glm::dvec2 brick_tile{2, 1.8}, plaster_tile{2, 2}, roof_tile_tile{2, 2.4}, slate_tile{2, 2},
    planks_tile{2.4, 2.4}, ashlar_tile{2.4, 2.4}, concrete_tile{3, 3}, sheet_tile{2, 2};

Relief brick(int size, Rng rng, const Job& job) {
  return laid({{8, 24, 0.5F, brick_tile}, 0.005F, 0.006F, 0.75F, 0.06F}, size, rng, job);
}

Relief ashlar(int size, Rng rng, const Job& job) {
  return laid({{4, 8, 0.5F, ashlar_tile}, 0.004F, 0.016F, 0.3F, 0.05F}, size, rng, job);
}

Relief plaster(int size, Rng rng, const Job& job) {
  const Field fine = noise(size, {40, 40}, {2, 0.6F}, 0.7F, rng.at("grain"), job);
  const Field large = noise(size, {3, 3}, {4, 0.55F}, 0.7F, rng.at("patches"), job);
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    return clamp(0.6F + 0.35F * fine.row(y)[x] + 0.15F * large.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.5F + 0.3F * large.row(y)[x] + 0.14F * fine.row(y)[x]);
  });
  return relief;
}

/// Panels with the marks of their boards and pores.
Relief concrete(int size, Rng rng, const Job& job) {
  const Bond panels{2, 2, 0, concrete_tile};
  const Field fine = noise(size, {64, 64}, {2, 0.6F}, 0.6F, rng.at("grain"), job);
  const Field large = noise(size, {4, 3}, {4, 0.55F}, 0.8F, rng.at("patches"), job);
  Field pores(job, size);
  add_noise(pores, {56, 56}, 1, rng.at("pores"), job);
  const Rng shade = rng.at("shade");
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const Course c = panels.at(x, y, size);
    const float seam = step_between(0.004F, 0.012F, std::min(c.to_side, c.to_bed));
    const float pore = step_between(0.5F, 0.7F, pores.row(y)[x]);
    return clamp(0.9F * seam - 0.3F * pore + 0.06F * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const Course c = panels.at(x, y, size);
    const float seam = 1 - step_between(0.004F, 0.012F, std::min(c.to_side, c.to_bed));
    return clamp(0.5F + 0.34F * large.row(y)[x] + 0.16F * (chance(shade, c) - 0.5F) + 0.08F * fine.row(y)[x] -
                 0.35F * seam - 0.15F * step_between(0.5F, 0.7F, pores.row(y)[x]));
  });
  return relief;
}

/// Pantiles: a wave across, rising down the slope to the overlap with the next tile.
Relief roof_tile(int size, Rng rng, const Job& job) {
  const Bond bond{8, 8, 0, roof_tile_tile};
  const Field fine = noise(size, {32, 32}, {2, 0.6F}, 0.6F, rng.at("grain"), job);
  const Field moss = noise(size, {4, 4}, {4, 0.6F}, 0.7F, rng.at("moss"), job);
  const Rng shade = rng.at("shade");
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    // A trough of two thirds and a roll of one third of the width, both parabolas.
    const float trough = (c.x / 0.66F - 0.5F) * 2, roll = ((c.x - 0.66F) / 0.34F - 0.5F) * 2;
    const float wave = c.x < 0.66F ? 0.3F * trough * trough : 0.3F + 0.5F * (1 - roll * roll);
    return clamp(0.8F * wave + 0.2F * step_between(0, 0.05F, c.y) * (0.3F + 0.7F * c.y) +
                 0.03F * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    const float under = 0.42F * (1 - step_between(0, 0.1F, c.y));  // in the shade of the tile above
    const float side = 0.22F * (1 - step_between(0, 0.07F, std::abs(c.x - 0.63F)));
    return clamp(0.52F + 0.5F * (chance(shade, c) - 0.5F) + 0.16F * moss.row(y)[x] + 0.1F * fine.row(y)[x] -
                 under - side);
  });
  return relief;
}

Relief slate(int size, Rng rng, const Job& job) {
  const Bond bond{8, 10, 0.5F, slate_tile};
  const Field fine = noise(size, {24, 48}, {2, 0.6F}, 0.6F, rng.at("grain"), job);
  const Field large = noise(size, {3, 3}, {3, 0.5F}, 0.6F, rng.at("patches"), job);
  const Rng shade = rng.at("shade");
  Relief relief = bare(size, job);
  const auto gap = [](const Course& c) { return 1 - step_between(0.002F, 0.006F, c.to_side); };
  relief.height.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    const float butt = step_between(0, 0.05F, c.y);
    return clamp(butt * (0.4F + 0.5F * c.y) * (1 - 0.6F * gap(c)) + 0.06F * fine.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    const float under = 1 - step_between(0, 0.08F, c.y);
    return clamp(0.5F + 0.6F * (chance(shade, c) - 0.5F) + 0.12F * fine.row(y)[x] + 0.1F * large.row(y)[x] -
                 0.4F * under - 0.35F * gap(c));
  });
  return relief;
}

/// Overlapping horizontal boards with grain.
Relief planks(int size, Rng rng, const Job& job) {
  const Bond bond{1, 16, 0.37F, planks_tile};
  Field grain(job, size);
  add_noise(grain, {4, 128}, {1, 0.6F}, 0.6F, rng.at("grain"), job);
  add_noise(grain, {10, 64}, {2, 0.6F}, 0.4F, rng.at("fibres"), job);
  const Rng shade = rng.at("shade");
  Relief relief = bare(size, job);
  relief.height.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    const float butt = step_between(0.001F, 0.003F, c.to_side) * step_between(0, 0.06F, c.y);
    return clamp(butt * (0.25F + 0.65F * c.y) + 0.08F * grain.row(y)[x]);
  });
  relief.tone.each(job, [&](float, int x, int y) {
    const Course c = bond.at(x, y, size);
    const float under = 1 - step_between(0, 0.12F, c.y), end = 1 - step_between(0.001F, 0.004F, c.to_side);
    return clamp(0.54F + 0.4F * (chance(shade, c) - 0.5F) + 0.2F * grain.row(y)[x] - 0.45F * under -
                 0.4F * end);
  });
  return relief;
}

/// Vertical ribs.
Relief sheet(int size, Rng rng, const Job& job) {
  constexpr int ribs = 10;
  const Field large = noise(size, {3, 2}, {4, 0.55F}, 0.6F, rng.at("patches"), job);
  const Field fine = noise(size, {64, 8}, {2, 0.6F}, 0.5F, rng.at("streaks"), job);
  Relief relief = bare(size, job);
  const auto rib = [size](int x) {
    const float u = (static_cast<float>(x) + 0.5F) * ribs / static_cast<float>(size);
    const float side = std::abs(u - std::floor(u) - 0.5F);
    return 1 - step_between(0.18F, 0.28F, side);
  };
  relief.height.each(job, [&](float, int x, int) { return rib(x); });
  relief.tone.each(job, [&](float, int x, int y) {
    return clamp(0.46F + 0.1F * rib(x) + 0.14F * large.row(y)[x] + 0.1F * fine.row(y)[x]);
  });
  return relief;
}

struct Painter {
  Relief (*paint)(int size, Rng rng, const Job& job);
  glm::vec3 main;     ///< sRGB bytes, of those that are not grey
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
    {"sheet", sheet_tile, true},
    {"soil_ground", {ground_tile, ground_tile}, true},
    {"rock_ground", {ground_tile, ground_tile}, true},
    {"sand_ground", {ground_tile, ground_tile}, true},
    {"snow_ground", {ground_tile, ground_tile}, true},
};

constexpr Painter painters[] = {
    {brick, {150, 82, 64}, 0.62F, 1.28F, {176, 168, 156}, 0.010F, 0.97F, 0.88F, 0.97F, 0.45F},
    {plaster, {}, 0.86F, 1.1F, {}, 0.006F, 0.96F, 0.92F, 0.95F, 0.2F},
    {roof_tile, {}, 0.5F, 1.18F, {}, 0.05F, 0.92F, 0.8F, 0.9F, 0.5F},
    {slate, {}, 0.6F, 1.18F, {}, 0.012F, 0.85F, 0.65F, 0.9F, 0.4F},
    {planks, {}, 0.55F, 1.15F, {}, 0.018F, 0.9F, 0.78F, 0.9F, 0.5F},
    {ashlar, {}, 0.7F, 1.14F, {158, 156, 150}, 0.014F, 0.95F, 0.86F, 0.95F, 0.35F},
    {concrete, {}, 0.74F, 1.12F, {}, 0.008F, 0.95F, 0.85F, 0.95F, 0.3F},
    {sheet, {}, 0.8F, 1.1F, {}, 0.035F, 0.5F, 0.45F, 0.5F, 0.3F},
    {soil_ground, {}, 0.45F, 1.18F, {}, 0.02F, 0.98F, 0.8F, 0.9F, 0.55F},
    {rock_ground, {}, 0.4F, 1.18F, {}, 0.03F, 0.96F, 0.72F, 0.9F, 0.6F},
    {sand_ground, {}, 0.7F, 1.18F, {}, 0.006F, 0.95F, 0.78F, 0.9F, 0.3F},
    {snow_ground, {}, 0.86F, 1.18F, {}, 0.012F, 0.7F, 0.5F, 0.7F, 0.2F},
};
static_assert(std::size(kinds) == std::size(painters));

glm::vec3 of_bytes(const glm::vec3& bytes) { return bytes * (1 / 255.0F); }

}  // namespace

std::span<const WallKind> wall_kinds() { return kinds; }

const WallKind* wall_kind(std::string_view name) {
  const auto* const found = std::ranges::find(kinds, name, &WallKind::name);
  return found == std::end(kinds) ? nullptr : found;
}

glm::vec3 wall_grey() { return glm::vec3(linear_of_srgb(grey_byte)); }

Painting paint_wall(std::string_view name, int size, std::uint64_t seed, const Tint& tint, const Job& job) {
  const WallKind* const kind = wall_kind(name);
  assert(kind != nullptr);
  const Painter& p = painters[kind - kinds];
  const glm::vec3 main = kind->is_grey ? glm::vec3(grey_byte) : p.main;
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
  return {p.paint(size, Rng::of_seed(seed).at(name), job), finish};
}

}  // namespace seedmesh::texture
