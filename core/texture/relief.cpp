#include "core/texture/relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/texture/png.h"

namespace seedmesh::texture {
namespace {

/// Values from 0 to 1 as bytes. A plain loop over arrays, so that the compiler handles many texels at once.
void write_bytes(const float* values, std::uint8_t* out, int count) {
  for (int i = 0; i < count; ++i) {
    const float clamped = values[i] < 0 ? 0 : values[i] > 1 ? 1 : values[i];
    out[i] = static_cast<std::uint8_t>(clamped * 255 + 0.5F);
  }
}

/// For each byte the nearest of the steps that include the middle of the range.
using Steps = std::array<std::uint8_t, 256>;

Steps steps_of(int step) {
  Steps made{};
  for (int byte = 0; byte < 256; ++byte) {
    const int from_middle = byte - 128 + 128 * step;  // positive, so that it is rounded down
    const int rounded = step == 1 ? byte : (from_middle + step / 2) / step * step - 128 * step + 128;
    made[static_cast<std::size_t>(byte)] = static_cast<std::uint8_t>(std::clamp(rounded, 0, 255));
  }
  return made;
}

/// One row of an image: a row of values for each channel, and the same as bytes.
struct Row {
  explicit Row(int size) {
    for (std::vector<float>& each : values) each.resize(static_cast<std::size_t>(size));
    for (std::vector<std::uint8_t>& each : bytes) each.resize(static_cast<std::size_t>(size));
  }
  std::array<std::vector<float>, 4> values;
  std::array<std::vector<std::uint8_t>, 4> bytes;
};

void apply_steps(std::vector<std::uint8_t>& bytes, const Steps& steps) {
  for (std::uint8_t& byte : bytes) byte = steps[byte];
}

/// The third channel of unit normals, from the bytes of the other two.
void level_up(Row& row, int size) {
  const std::uint8_t *first = row.bytes[0].data(), *second = row.bytes[1].data();
  float* out = row.values[2].data();
  for (int i = 0; i < size; ++i) {
    const float x = static_cast<float>(first[i]) / 127.5F - 1, y = static_cast<float>(second[i]) / 127.5F - 1;
    const float rest = 1 - x * x - y * y;
    out[i] = 0.5F + 0.5F * std::sqrt(rest < 0 ? 0 : rest);
  }
  write_bytes(out, row.bytes[2].data(), size);
}

template <std::size_t channels>
void interleave(const Row& row, std::uint8_t* out, int size) {
  std::array<const std::uint8_t*, channels> in{};
  for (std::size_t c = 0; c < channels; ++c) in[c] = row.bytes[c].data();
  for (int i = 0; i < size; ++i, out += channels) {
    for (std::size_t c = 0; c < channels; ++c) out[c] = in[c][i];
  }
}

void interleave(const Row& row, int channels, std::uint8_t* out, int size) {
  if (channels == 1) interleave<1>(row, out, size);
  if (channels == 3) interleave<3>(row, out, size);
  if (channels == 4) interleave<4>(row, out, size);
}

/// A PNG file. `fill(row, y)` writes the values of a row, and `settle(row)` changes its bytes.
template <class Fill, class Settle>
std::shared_ptr<const Image> picture(int size, int channels, std::string name, const Job& job, Fill&& fill,
                                     Settle&& settle) {
  const auto side = static_cast<std::size_t>(size), pixel = static_cast<std::size_t>(channels);
  Array<std::uint8_t> pixels(job, side * side * pixel);
  Row row(size);
  for (int y = 0; y < size; ++y) {
    if (y % 64 == 0) job.check();
    fill(row, y);
    for (std::size_t c = 0; c < pixel; ++c) write_bytes(row.values[c].data(), row.bytes[c].data(), size);
    settle(row);
    interleave(row, channels, pixels.data() + static_cast<std::size_t>(y) * side * pixel, size);
  }
  const auto extent = static_cast<std::uint32_t>(size);
  const Array<std::uint8_t> file = encode_png(
      {extent, extent, channels, 8, std::as_bytes(std::as_const(pixels).span())}, PngEffort::quick, job);
  auto image = std::make_shared<Image>();
  image->name = std::move(name);
  image->bytes.assign(file.begin(), file.end());
  return image;
}

void fill_color(const Relief& relief, const Ramp& ramp, int channels, Row& row, int y) {
  const int size = relief.height.size();
  const float *tone = relief.tone.row(y), *accent = relief.accent.row(y);
  for (int c = 0; c < std::min(channels, 3); ++c) {
    const float dark = ramp.dark[c], main = ramp.main[c], light = ramp.light[c], other = ramp.accent[c];
    float* out = row.values[static_cast<std::size_t>(c)].data();
    for (int x = 0; x < size; ++x) {
      const float t = 2 * tone[x];
      const float base = t < 1 ? dark + (main - dark) * t : main + (light - main) * (t - 1);
      out[x] = base + (other - base) * accent[x];
    }
  }
  if (channels == 4) std::copy_n(relief.cover.row(y), size, row.values[3].data());
}

/// `steep` is half the height of the relief in texels.
void fill_normal(const Field& height, float steep, Row& row, int y) {
  const int size = height.size(), last = size - 1;
  const float *here = height.row(y), *above = height.row((y - 1) & last), *below = height.row((y + 1) & last);
  float *out_x = row.values[0].data(), *out_y = row.values[1].data(), *out_z = row.values[2].data();
  const auto write = [&](int x, int before, int after) {
    const float dx = (here[before] - here[after]) * steep, dy = (below[x] - above[x]) * steep;
    const float by_length = 1 / std::sqrt(dx * dx + dy * dy + 1);
    out_x[x] = 0.5F + 0.5F * dx * by_length;
    out_y[x] = 0.5F + 0.5F * dy * by_length;
    out_z[x] = 0.5F + 0.5F * by_length;
  };
  write(0, last, 1);
  for (int x = 1; x < last; ++x) write(x, x - 1, x + 1);
  write(last, last - 1, 0);
}

/// The means of `step` texels in both directions, from row `y` on.
void fill_means(const Field& field, int step, int y, std::vector<float>& out) {
  const auto size = static_cast<std::size_t>(field.size() / step);
  const float by_count = 1 / static_cast<float>(step * step);
  std::fill_n(out.begin(), size, 0.0F);
  for (int k = 0; k < step; ++k) {
    const float* values = field.row(y + k);
    for (std::size_t x = 0; x < size; ++x) {
      for (int i = 0; i < step; ++i) out[x] += *values++;
    }
  }
  for (std::size_t x = 0; x < size; ++x) out[x] *= by_count;
}

void fill_surface(const Relief& relief, const Finish& finish, int step, Row& row, int y) {
  const int size = relief.height.size() / step;
  fill_means(relief.height, step, y * step, row.values[0]);
  fill_means(relief.accent, step, y * step, row.values[1]);
  float *occlusion = row.values[0].data(), *roughness = row.values[1].data();
  const float low = finish.rough_low, span = finish.rough_high - finish.rough_low,
              other = finish.rough_accent;
  for (int x = 0; x < size; ++x) {
    const float height = occlusion[x], accent = roughness[x], rough = low + span * height;
    occlusion[x] = 1 - finish.shade * (1 - height) * (1 - height);
    roughness[x] = rough + (other - rough) * accent;
  }
}

}  // namespace

Maps make_maps(const Relief& relief, const Finish& finish, const std::string& name, const Job& job) {
  const int size = relief.height.size();
  const bool has_cover = relief.cover.size() == size;
  // Colours of 6 bits and other channels of 5: smooth enough for a wall, with a third of the bytes.
  const Steps tones = steps_of(finish.is_small ? 4 : 1), lights = steps_of(finish.is_small ? 8 : 1);
  const int channels = finish.is_grey ? 1 : has_cover ? 4 : 3;
  const float steep = 0.5F * finish.depth * static_cast<float>(size);
  Maps maps;
  const auto make_color = [&] {
    maps.color = picture(
        size, channels, name + "_color", job,
        [&](Row& row, int y) { fill_color(relief, finish.ramp, channels, row, y); },
        [&](Row& row) {
          for (int c = 0; c < std::min(channels, 3); ++c)
            apply_steps(row.bytes[static_cast<std::size_t>(c)], tones);
        });
  };
  const auto make_normal = [&] {
    maps.normal = picture(
        size, 3, name + "_normal", job, [&](Row& row, int y) { fill_normal(relief.height, steep, row, y); },
        [&](Row& row) {
          if (!finish.is_small) return;
          apply_steps(row.bytes[0], tones);
          apply_steps(row.bytes[1], tones);
          level_up(row, size);
        });
  };
  const auto make_surface = [&] {
    const int step = size / surface_size(size);
    maps.surface = picture(
        size / step, 3, name + "_surface", job,
        [&](Row& row, int y) { fill_surface(relief, finish, step, row, y); },
        [&](Row& row) {
          apply_steps(row.bytes[0], lights);
          apply_steps(row.bytes[1], lights);
        });
  };
  parallel_for(job, 3, 1, [&](std::size_t begin, std::size_t, std::size_t) {
    if (begin == 0) make_color();
    if (begin == 1) make_normal();
    if (begin == 2) make_surface();
  });
  return maps;
}

}  // namespace seedmesh::texture
