#include "core/texture/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/texture/pair_palette.h"
#include "core/texture/png_image.h"

namespace seedmesh::texture {
namespace {

/// Bytes are rounded to multiples of a power of two, so that files are smaller: the middle of the range is one.
struct Levels {
  explicit Levels(std::uint32_t step) : half(step / 2), mask(~(step - 1)) {}
  std::uint32_t half, mask;
};

inline std::uint32_t byte_of(float share, const Levels& levels) {
  const auto byte = static_cast<std::uint32_t>(static_cast<std::int32_t>(clamp_share(share) * 255 + 0.5F));
  const std::uint32_t rounded = (byte + levels.half) & levels.mask;
  return rounded > 255 ? 255 : rounded;
}

inline float color_of(float tone, float dark, float main, float light) {
  const float t = 2 * tone;
  return t < 1 ? dark + (main - dark) * t : main + (light - main) * (t - 1);
}

/// Stores a word with its lowest byte first.
inline void store_low_first(std::uint32_t value, std::uint8_t* out) {
  for (std::size_t i = 0; i < sizeof(value); ++i) out[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

// The functions that follow write one row of pixels, each with its first channel in the lowest byte.

/// A palette of `tones` colours for each of `accents` shares of the accent.
struct Palette {
  int tones = 256, accents = 1;
};

SEEDMESH_WIDE void pack_palette(const float* __restrict tone, const float* __restrict accent,
                                const Palette& palette, int size, std::uint32_t* __restrict out) {
  const auto last_tone = static_cast<float>(palette.tones - 1),
             last_accent = static_cast<float>(palette.accents - 1);
  for (int x = 0; x < size; ++x) {
    const auto first = static_cast<std::int32_t>(clamp_share(tone[x]) * last_tone + 0.5F);
    const auto second = static_cast<std::int32_t>(clamp_share(accent[x]) * last_accent + 0.5F);
    out[x] = static_cast<std::uint32_t>(second * palette.tones + first);
  }
}

SEEDMESH_WIDE void pack_grey(const float* __restrict tone, const float* __restrict accent, const Ramp& ramp,
                             const Levels& levels, int size, std::uint32_t* __restrict out) {
  for (int x = 0; x < size; ++x) {
    const float base = color_of(tone[x], ramp.dark.x, ramp.main.x, ramp.light.x);
    out[x] = byte_of(base + (ramp.accent.x - base) * accent[x], levels);
  }
}

SEEDMESH_WIDE void pack_color(const float* __restrict tone, const float* __restrict accent, const Ramp& ramp,
                              int size, std::uint32_t* __restrict out) {
  const Levels levels(1);
  for (int x = 0; x < size; ++x) {
    const float red = color_of(tone[x], ramp.dark.x, ramp.main.x, ramp.light.x);
    const float green = color_of(tone[x], ramp.dark.y, ramp.main.y, ramp.light.y);
    const float blue = color_of(tone[x], ramp.dark.z, ramp.main.z, ramp.light.z);
    out[x] = byte_of(red + (ramp.accent.x - red) * accent[x], levels) |
             byte_of(green + (ramp.accent.y - green) * accent[x], levels) << 8U |
             byte_of(blue + (ramp.accent.z - blue) * accent[x], levels) << 16U;
  }
}

SEEDMESH_WIDE void add_alpha(const float* __restrict cover, int size, std::uint32_t* __restrict out) {
  const Levels all(1);
  for (int x = 0; x < size; ++x) out[x] |= byte_of(cover[x], all) << 24U;
}

/// Three rows of heights. `here` begins one texel before the row and ends one after it.
struct HeightRows {
  const float *above, *here, *below;
};

// The numbers of pairs of levels.

/// Rounds a number from 0 to 1 to the levels that are multiples of `step`, and to the last one.
inline std::uint32_t level_of(float share, std::uint32_t step) {
  const auto steps = static_cast<float>(static_cast<std::int32_t>(pair_levels / step)) * (255 / 256.0F);
  const auto level = static_cast<std::uint32_t>(static_cast<std::int32_t>(share * steps + 0.5F)) * step;
  return level < pair_levels ? level : pair_levels - 1;
}

/// `steep` is half the height of the relief in texels.
SEEDMESH_WIDE void pack_normals(const HeightRows& rows, float steep, int size,
                                std::uint32_t* __restrict out) {
  const float* __restrict above = rows.above, * __restrict here = rows.here, * __restrict below = rows.below;
  for (int x = 0; x < size; ++x) {
    const float dx = (here[x] - here[x + 2]) * steep, dy = (below[x] - above[x]) * steep;
    const float by_length = 0.5F / std::sqrt(dx * dx + dy * dy + 1);
    out[x] = level_of(0.5F + dx * by_length, 1) + pair_levels * level_of(0.5F + dy * by_length, 1);
  }
}

/// The means of two texels each way.
SEEDMESH_WIDE void write_means(const float* __restrict upper, const float* __restrict lower, int size,
                               float* __restrict out) {
  for (int x = 0; x < size; ++x)
    out[x] = 0.25F * ((upper[2 * x] + upper[2 * x + 1]) + (lower[2 * x] + lower[2 * x + 1]));
}

SEEDMESH_WIDE void pack_surface(const float* __restrict height, const float* __restrict accent,
                                const Finish& finish, int size, std::uint32_t* __restrict out) {
  const std::uint32_t step = finish.is_small ? 2 : 1;
  for (int x = 0; x < size; ++x) {
    const float deep = 1 - height[x];
    const float rough = finish.rough_low + (finish.rough_high - finish.rough_low) * height[x];
    const float open = clamp_share(1 - finish.shade * deep * deep);
    const float own = clamp_share(rough + (finish.rough_accent - rough) * accent[x]);
    out[x] = level_of(open, step) + pair_levels * level_of(own, step);
  }
}

SEEDMESH_WIDE void write_bytes(const std::uint32_t* __restrict row, std::size_t size,
                               std::uint8_t* __restrict out) {
  for (std::size_t x = 0; x < size; ++x) out[x] = static_cast<std::uint8_t>(row[x]);
}

/// Writes the lowest bytes of each pixel. Whole words are written, the last ones of which the next pixel replaces.
template <std::size_t channels>
void write_pixels(const std::vector<std::uint32_t>& row, std::uint8_t* out) {
  constexpr std::size_t word = sizeof(std::uint32_t);
  const std::size_t whole = row.size() - word / channels;  // words of the last pixels would exceed the row
  for (std::size_t x = 0; x < whole; ++x) store_low_first(row[x], out + channels * x);
  for (std::size_t x = whole; x < row.size(); ++x) {
    for (std::size_t c = 0; c < channels; ++c)
      out[channels * x + c] = static_cast<std::uint8_t>(row[x] >> (8 * c));
  }
}

void write_channels(const std::vector<std::uint32_t>& row, std::size_t channels, std::uint8_t* out) {
  if (channels == 1) return write_bytes(row.data(), row.size(), out);
  if (channels == 3) return write_pixels<3>(row, out);
  write_pixels<4>(row, out);
}

/// A row of means of a field, or of its values where `step` is 1.
void fill_means(const Field& field, int step, int y, std::vector<float>& out) {
  const auto size = static_cast<int>(out.size());
  if (step == 2) {
    write_means(field.row(2 * y), field.row(2 * y + 1), size, out.data());
  } else {
    std::copy_n(field.row(y), size, out.data());
  }
}

struct Format {
  int size, channels;
  std::vector<glm::u8vec3> palette = {};
};

std::shared_ptr<const Image> image_of(const Format& format, std::string name,
                                      const Array<std::uint8_t>& pixels, const Job& job) {
  const auto extent = static_cast<std::uint32_t>(format.size);
  return png_image(std::move(name),
                   {extent, extent, format.channels, 8, std::as_bytes(pixels.span()), format.palette},
                   PngEffort::quick, job);
}

/// A PNG file. `fill(row, y)` writes the pixels of a row.
template <class Fill>
std::shared_ptr<const Image> picture(const Format& format, std::string name, const Job& job, Fill&& fill) {
  const auto side = static_cast<std::size_t>(format.size), pixel = static_cast<std::size_t>(format.channels);
  Array<std::uint8_t> pixels(job, side * side * pixel);
  std::vector<std::uint32_t> row(side);
  for (int y = 0; y < format.size; ++y) {
    if (y % 64 == 0) job.check();
    fill(row, y);
    write_channels(row, pixel, pixels.data() + static_cast<std::size_t>(y) * side * pixel);
  }
  return image_of(format, std::move(name), pixels, job);
}

std::vector<glm::u8vec3> colors_of(const Palette& palette, const Ramp& ramp) {
  const Levels all(1);
  std::vector<glm::u8vec3> colors;
  for (int a = 0; a < palette.accents; ++a) {
    const float accent = a == 0 ? 0 : static_cast<float>(a) / static_cast<float>(palette.accents - 1);
    for (int i = 0; i < palette.tones; ++i) {
      const float tone = static_cast<float>(i) / static_cast<float>(palette.tones - 1);
      glm::u8vec3 color;
      for (int c = 0; c < 3; ++c) {
        const float base = color_of(tone, ramp.dark[c], ramp.main[c], ramp.light[c]);
        color[c] = static_cast<std::uint8_t>(byte_of(base + (ramp.accent[c] - base) * accent, all));
      }
      colors.push_back(color);
    }
  }
  return colors;
}

/// The input of the three images.
struct Source {
  const Relief& relief;
  const Finish& finish;
  const std::string& name;
  const Job& job;
  std::vector<float> no_accent;  ///< a row of zeros

  int size() const { return relief.height.size(); }
  bool has_accent() const { return relief.accent.size() == size(); }
  const float* accent(int y) const { return has_accent() ? relief.accent.row(y) : no_accent.data(); }
};

/// Tones without an accent need no more than a palette. With an accent, it is fine enough for a wall.
std::optional<Palette> palette_of(const Source& source) {
  if (source.finish.is_grey || source.relief.cover.size() == source.size()) return std::nullopt;
  if (!source.has_accent()) return Palette{256, 1};
  return source.finish.is_small ? std::optional(Palette{36, 7}) : std::nullopt;
}

std::shared_ptr<const Image> color_image(const Source& source) {
  const Relief& relief = source.relief;
  const Ramp& ramp = source.finish.ramp;
  const int size = source.size();
  const std::string name = source.name + "_color";
  if (const std::optional<Palette> palette = palette_of(source)) {
    return picture({size, 1, colors_of(*palette, ramp)}, name, source.job,
                   [&](std::vector<std::uint32_t>& row, int y) {
                     pack_palette(relief.tone.row(y), source.accent(y), *palette, size, row.data());
                   });
  }
  if (source.finish.is_grey) {
    // 6 bits: smooth enough for a wall, with a third of the bytes.
    const Levels levels(source.finish.is_small ? 4 : 1);
    return picture({size, 1, {}}, name, source.job, [&](std::vector<std::uint32_t>& row, int y) {
      pack_grey(relief.tone.row(y), source.accent(y), ramp, levels, size, row.data());
    });
  }
  const bool has_cover = relief.cover.size() == size;
  return picture({size, has_cover ? 4 : 3, {}}, name, source.job,
                 [&](std::vector<std::uint32_t>& row, int y) {
                   pack_color(relief.tone.row(y), source.accent(y), ramp, size, row.data());
                   if (has_cover) add_alpha(relief.cover.row(y), size, row.data());
                 });
}

/// A PNG file with a palette. `fill(row, y)` writes the numbers of the pairs of a row, and `color` returns the colour of
/// a pair of bytes.
template <class Fill, class Color>
std::shared_ptr<const Image> picture_of_pairs(int size, std::string name, const Job& job, Fill&& fill,
                                              Color&& color) {
  const auto side = static_cast<std::size_t>(size);
  Array<std::uint16_t> pairs(job, side * side);
  std::vector<std::uint32_t> row(side);
  PairCounts counts;
  for (std::size_t y = 0; y < side; ++y) {
    if (y % 64 == 0) job.check();
    fill(row.data(), static_cast<int>(y));
    counts.add(row);
    for (std::size_t x = 0; x < side; ++x) pairs.data()[y * side + x] = static_cast<std::uint16_t>(row[x]);
  }
  const PairPalette palette = pair_palette(counts.sums());
  Array<std::uint8_t> pixels(job, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) pixels.data()[i] = palette.of[pairs.data()[i]];
  Format format{size, 1, {}};
  for (const glm::u8vec2& pair : palette.colors) format.palette.push_back(color(pair));
  return image_of(format, std::move(name), pixels, job);
}

/// A normal of unit length with these bytes.
glm::u8vec3 normal_color(const glm::u8vec2& pair) {
  const float u = static_cast<float>(pair.x) * (1 / 127.5F) - 1,
              v = static_cast<float>(pair.y) * (1 / 127.5F) - 1, rest = 1 - u * u - v * v;
  return {pair, static_cast<std::uint8_t>(byte_of(0.5F + 0.5F * std::sqrt(rest < 0 ? 0 : rest), Levels(1)))};
}

std::shared_ptr<const Image> normal_image(const Source& source) {
  const Field& height = source.relief.height;
  const int size = source.size(), last = size - 1;
  const float steep = 0.5F * source.finish.depth * static_cast<float>(size);
  std::vector<float> around(static_cast<std::size_t>(size) + 2);
  const auto fill = [&](std::uint32_t* row, int y) {
    const float* here = height.row(y);
    around.front() = here[last];
    std::copy_n(here, size, around.begin() + 1);
    around.back() = here[0];
    pack_normals({height.row((y - 1) & last), around.data(), height.row((y + 1) & last)}, steep, size, row);
  };
  return picture_of_pairs(size, source.name + "_normal", source.job, fill, normal_color);
}

std::shared_ptr<const Image> surface_image(const Source& source) {
  const int size = surface_size(source.size()), step = source.size() / size;
  std::vector<float> height(static_cast<std::size_t>(size)), accent(height.size(), 0.0F);
  const auto fill = [&](std::uint32_t* row, int y) {
    fill_means(source.relief.height, step, y, height);
    if (source.has_accent()) fill_means(source.relief.accent, step, y, accent);
    pack_surface(height.data(), accent.data(), source.finish, size, row);
  };
  return picture_of_pairs(size, source.name + "_surface", source.job, fill,
                          [](const glm::u8vec2& pair) { return glm::u8vec3(pair, 0); });
}

}  // namespace

Relief paint_rows(int size, Accent accent, const Job& job, const PaintRows& paint) {
  const bool has_accent = accent == Accent::painted;
  Relief relief{Field(job, size), Field(job, size), has_accent ? Field(job, size) : Field(job, 1, 0),
                Field(job, 1, 1)};
  const auto row_at = [&](int y) {
    return ReliefRow{relief.height.row(y), relief.tone.row(y), has_accent ? relief.accent.row(y) : nullptr};
  };
  for_rows(job, size, [&](int begin, int end) { paint(begin, end, row_at); });
  return relief;
}

Maps make_maps(const Relief& relief, const Finish& finish, const std::string& name, MapParts parts,
               const Job& job) {
  const Source source{relief, finish, name, job,
                      std::vector<float>(static_cast<std::size_t>(relief.height.size()), 0.0F)};
  Maps maps;
  parallel_for(job, 3, 1, [&](std::size_t begin, std::size_t, std::size_t) {
    if (begin == 0) maps.color = color_image(source);
    if (begin == 1 && parts.normal) maps.normal = normal_image(source);
    if (begin == 2 && parts.surface) maps.surface = surface_image(source);
  });
  return maps;
}

}  // namespace seedmesh::texture
