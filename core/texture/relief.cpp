#include "core/texture/relief.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/texture/png.h"

namespace seedmesh::texture {
namespace {

std::uint8_t byte_of(float value) {
  const float c = value < 0 ? 0 : value > 1 ? 1 : value;
  return static_cast<std::uint8_t>(c * 255 + 0.5F);
}

/// In steps of `step`, the middle of the range being one of them.
std::uint8_t stepped(float value, int step) {
  const int byte = byte_of(value);
  if (step == 1) return static_cast<std::uint8_t>(byte);
  const int from_middle = byte - 128 + 128 * step;  // positive, so that it is rounded down
  return static_cast<std::uint8_t>(
      std::clamp((from_middle + step / 2) / step * step - 128 * step + 128, 0, 255));
}

glm::vec3 mix(const glm::vec3& a, const glm::vec3& b, float t) { return a + (b - a) * t; }

glm::vec3 color_at(const Ramp& ramp, float tone, float accent) {
  const glm::vec3 base =
      tone < 0.5F ? mix(ramp.dark, ramp.main, 2 * tone) : mix(ramp.main, ramp.light, 2 * tone - 1);
  return mix(base, ramp.accent, accent);
}

/// The third channel of a normal from the other two, so that it has unit length again.
void level_up(std::uint8_t* out) {
  const float x = static_cast<float>(out[0]) / 127.5F - 1, y = static_cast<float>(out[1]) / 127.5F - 1;
  out[2] = byte_of(0.5F + 0.5F * std::sqrt(std::max(0.0F, 1 - x * x - y * y)));
}

/// Pixels that `write(out, x, y)` fills one by one, as a PNG file.
template <class Write>
std::shared_ptr<const Image> picture(int size, int channels, std::string name, PngEffort effort,
                                     const Job& job, Write&& write) {
  const auto side = static_cast<std::size_t>(size), pixel = static_cast<std::size_t>(channels);
  Array<std::uint8_t> pixels(job, side * side * pixel);
  std::uint8_t* out = pixels.data();
  for (int y = 0; y < size; ++y) {
    if (y % 64 == 0) job.check();
    for (int x = 0; x < size; ++x, out += channels) write(out, x, y);
  }
  const auto extent = static_cast<std::uint32_t>(size);
  const Array<std::uint8_t> file =
      encode_png({extent, extent, channels, 8, std::as_bytes(std::as_const(pixels).span())}, effort, job);
  auto image = std::make_shared<Image>();
  image->name = std::move(name);
  image->bytes.assign(file.begin(), file.end());
  return image;
}

}  // namespace

Maps make_maps(const Relief& relief, const Finish& finish, const std::string& name, const Job& job) {
  const int size = relief.height.size();
  const bool has_cover = relief.cover.size() == size;
  // Colours of 6 bits and what the light does of 5: smooth enough for a wall, and a third of the bytes.
  const int tone_step = finish.is_small ? 4 : 1, light_step = finish.is_small ? 8 : 1,
            normal_step = finish.is_small ? 4 : 1;
  const int channels = finish.is_grey ? 1 : has_cover ? 4 : 3;
  const PngEffort effort = finish.is_small ? PngEffort::small : PngEffort::quick;
  Maps maps;
  const auto write_color = [&](std::uint8_t* out, int x, int y) {
    const glm::vec3 color = color_at(finish.ramp, relief.tone.row(y)[x], relief.accent.row(y)[x]);
    for (int i = 0; i < std::min(channels, 3); ++i) out[i] = stepped(color[i], tone_step);
    if (has_cover) out[3] = byte_of(relief.cover.row(y)[x]);
  };
  const float steep = 0.5F * finish.depth * static_cast<float>(size);
  const auto write_normal = [&](std::uint8_t* out, int x, int y) {
    const float dx = (relief.height.at(x - 1, y) - relief.height.at(x + 1, y)) * steep;
    const float dy = (relief.height.at(x, y + 1) - relief.height.at(x, y - 1)) * steep;
    const float by_length = 1 / std::sqrt(dx * dx + dy * dy + 1);
    out[0] = stepped(0.5F + 0.5F * dx * by_length, normal_step);
    out[1] = stepped(0.5F + 0.5F * dy * by_length, normal_step);
    out[2] = byte_of(0.5F + 0.5F * by_length);
    if (normal_step > 1) level_up(out);
  };
  const auto write_surface = [&](std::uint8_t* out, int x, int y) {
    const float height = relief.height.row(y)[x], accent = relief.accent.row(y)[x];
    const float rough = finish.rough_low + (finish.rough_high - finish.rough_low) * height;
    out[0] = stepped(1 - finish.shade * (1 - height) * (1 - height), light_step);
    out[1] = stepped(rough + (finish.rough_accent - rough) * accent, light_step);
    out[2] = 0;
  };
  parallel_for(job, 3, 1, [&](std::size_t begin, std::size_t, std::size_t) {
    if (begin == 0) maps.color = picture(size, channels, name + "_color", effort, job, write_color);
    if (begin == 1) maps.normal = picture(size, 3, name + "_normal", effort, job, write_normal);
    if (begin == 2) maps.surface = picture(size, 3, name + "_surface", effort, job, write_surface);
  });
  return maps;
}

}  // namespace seedmesh::texture
