#include "core/texture/webp_write.h"

#include <webp/encode.h>

#include <algorithm>
#include <cassert>
#include <new>
#include <string_view>
#include <vector>

#include "core/texture/webp_alpha.h"

namespace seedmesh::texture {
namespace {

constexpr int method = 4;  ///< of 0 (fast) to 6 (small)
constexpr int quick_method = 1;

/// The planes of VP8: Y for each pixel, U and V for each square of four.
struct Planes {
  std::uint32_t width, height, half_width, half_height;
  Array<std::uint8_t> y, u, v;
};

int channel_at(const PictureView& picture, std::size_t pixel, int channel) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t c = picture.channels < 3 ? 0 : static_cast<std::size_t>(channel);
  return std::to_integer<int>(picture.bytes[pixel * channels + c]);
}

/// Recommendation ITU-R BT.601 in the range of studios, in 65536ths.
Planes planes_of(const PictureView& picture, const Job& job) {
  constexpr int half = 1 << 15, offset_y = 16 << 16, offset_c = 128 << 18;
  const std::uint32_t width = picture.width, height = picture.height;
  Planes planes{width,
                height,
                (width + 1) / 2,
                (height + 1) / 2,
                Array<std::uint8_t>(job, std::size_t{width} * height),
                Array<std::uint8_t>(job),
                Array<std::uint8_t>(job)};
  planes.u.resize(std::size_t{planes.half_width} * planes.half_height);
  planes.v.resize(planes.u.size());
  for (std::size_t i = 0; i < planes.y.size(); ++i) {
    if (i % 65'536 == 0) job.check();
    const int r = channel_at(picture, i, 0), g = channel_at(picture, i, 1), b = channel_at(picture, i, 2);
    planes.y[i] = static_cast<std::uint8_t>((16'839 * r + 33'059 * g + 6'420 * b + offset_y + half) >> 16);
  }
  for (std::uint32_t y = 0; y < planes.half_height; ++y) {
    for (std::uint32_t x = 0; x < planes.half_width; ++x) {
      int sum[3] = {};
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t px = std::min(2 * x + corner % 2, width - 1);
        const std::uint32_t py = std::min(2 * y + corner / 2, height - 1);
        for (int c = 0; c < 3; ++c) sum[c] += channel_at(picture, std::size_t{py} * width + px, c);
      }
      const std::size_t at = std::size_t{y} * planes.half_width + x;
      const int u = -9'719 * sum[0] - 19'081 * sum[1] + 28'800 * sum[2];
      const int v = 28'800 * sum[0] - 24'116 * sum[1] - 4'684 * sum[2];
      planes.u[at] = static_cast<std::uint8_t>(std::clamp((u + offset_c + 4 * half) >> 18, 0, 255));
      planes.v[at] = static_cast<std::uint8_t>(std::clamp((v + offset_c + 4 * half) >> 18, 0, 255));
    }
  }
  return planes;
}

std::vector<std::uint8_t> alpha_of(const PictureView& picture) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  std::vector<std::uint8_t> alpha(std::size_t{picture.width} * picture.height);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    alpha[i] = std::to_integer<std::uint8_t>(picture.bytes[(i + 1) * channels - 1]);
  return alpha;
}

/// Appends bytes to the array behind WebPPicture::custom_ptr. Exceptions do not pass through libwebp.
int append_bytes(const std::uint8_t* data, std::size_t size, const WebPPicture* picture) {
  auto& bytes = *static_cast<std::vector<std::uint8_t>*>(picture->custom_ptr);
  bytes.insert(bytes.end(), data, data + size);
  return 1;
}

/// Ends the encoder where the request has ended.
int go_on(int, const WebPPicture* picture) {
  try {
    static_cast<const Job*>(picture->user_data)->check();
  } catch (const Stop&) {
    return 0;
  }
  return 1;
}

/// A whole file without alpha.
std::vector<std::uint8_t> encode_colors(Planes& planes, WebpQuality quality, const Job& job) {
  WebPConfig config;
  WebPPicture picture;
  if (!WebPConfigInit(&config) || !WebPPictureInit(&picture)) throw std::bad_alloc();
  config.quality = static_cast<float>(static_cast<int>(quality));
  config.method = quality == WebpQuality::quick ? quick_method : method;
  config.segments = 1;
  config.sns_strength = 0;
  config.pass = 1;
  config.thread_level = 0;
  picture.width = static_cast<int>(planes.width);
  picture.height = static_cast<int>(planes.height);
  picture.y = planes.y.data();
  picture.u = planes.u.data();
  picture.v = planes.v.data();
  picture.y_stride = picture.width;
  picture.uv_stride = static_cast<int>(planes.half_width);
  std::vector<std::uint8_t> bytes;
  picture.writer = append_bytes;
  picture.custom_ptr = &bytes;
  picture.progress_hook = go_on;
  picture.user_data = const_cast<Job*>(&job);
  const bool is_done = WebPEncode(&config, &picture) != 0;
  WebPPictureFree(&picture);  // the planes are not its own
  job.check();
  if (!is_done) throw std::bad_alloc();
  return bytes;
}

void put(Array<std::uint8_t>& out, std::string_view text) {
  for (const char c : text) out.push_back(static_cast<std::uint8_t>(c));
}

void put(Array<std::uint8_t>& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void put_chunk(Array<std::uint8_t>& out, std::string_view name, std::span<const std::uint8_t> content) {
  put(out, name);
  put(out, static_cast<std::uint32_t>(content.size()), 4);
  for (const std::uint8_t byte : content) out.push_back(byte);
  if (content.size() % 2 != 0) out.push_back(0);
}

constexpr std::size_t riff_head = 12;  ///< "RIFF", size, "WEBP"

}  // namespace

int webp_encoder_version() { return WebPGetEncoderVersion(); }

Array<std::uint8_t> encode_webp(const PictureView& picture, WebpQuality quality, const Job& job) {
  assert(picture.bits == 8 && picture.width >= 1 && picture.width <= longest_webp_side);
  assert(picture.height >= 1 && picture.height <= longest_webp_side && picture.palette.empty());
  // libwebp uses about as much as the planes and the file.
  const Array<std::uint8_t> own(job, std::size_t{4} * picture.width * picture.height);
  Planes planes = planes_of(picture, job);
  const std::vector<std::uint8_t> colors = encode_colors(planes, quality, job);
  Array<std::uint8_t> file(job);
  if (picture.channels == 1 || picture.channels == 3) {
    for (const std::uint8_t byte : colors) file.push_back(byte);
    return file;
  }
  const std::vector<std::uint8_t> alpha = webp_alpha(alpha_of(picture), picture.width);
  constexpr std::uint32_t has_alpha = 0x10;
  constexpr std::size_t extended_head = 18;  // the chunk VP8X
  const std::size_t size =
      4 + extended_head + 8 + alpha.size() + alpha.size() % 2 + colors.size() - riff_head;
  put(file, "RIFF");
  put(file, static_cast<std::uint32_t>(size), 4);
  put(file, "WEBPVP8X");
  put(file, extended_head - 8, 4);
  put(file, has_alpha, 4);
  put(file, picture.width - 1, 3);
  put(file, picture.height - 1, 3);
  put_chunk(file, "ALPH", alpha);
  for (std::size_t i = riff_head; i < colors.size(); ++i) file.push_back(colors[i]);
  return file;
}

}  // namespace seedmesh::texture
