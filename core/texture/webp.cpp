// WebP files; see decode.h.
#include <webp/decode.h>

#include "core/texture/decode.h"

namespace seedmesh::texture {

Result<Decoded> decode_webp(std::span<const std::byte> file, const PngLimits& limits, const Job& job) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(file.data());
  WebPBitstreamFeatures features;
  const VP8StatusCode status = WebPGetFeatures(data, file.size(), &features);
  if (status != VP8_STATUS_OK)
    return detail::refused_picture(status == VP8_STATUS_NOT_ENOUGH_DATA
                                       ? "the WebP is truncated"
                                       : "the WebP is damaged: its head cannot be read");
  if (features.has_animation != 0)
    return detail::refused_picture("the WebP is an animation; expected one picture");
  if (features.width < 1 || features.height < 1) return detail::refused_picture("the WebP has no pixels");
  const auto width = static_cast<std::uint32_t>(features.width),
             height = static_cast<std::uint32_t>(features.height);
  if (auto error = detail::size_error("WebP", width, height, limits)) return *std::move(error);
  constexpr int lossless = 2;
  Decoded decoded;
  decoded.is_lossy = features.format != lossless;
  Picture& picture = decoded.picture.emplace();
  picture.width = width;
  picture.height = height;
  picture.channels = features.has_alpha != 0 ? 4 : 3;
  const std::size_t row_bytes = std::size_t{width} * static_cast<std::size_t>(picture.channels);
  // libwebp keeps all pixels of a lossless file as well, four bytes each.
  const Array<std::uint8_t> own(job, std::size_t{4} * width * height);
  picture.bytes = Array<std::uint8_t>(job, row_bytes * height);
  job.check();
  const auto stride = static_cast<int>(row_bytes);
  const std::uint8_t* end =
      picture.channels == 4
          ? WebPDecodeRGBAInto(data, file.size(), picture.bytes.data(), picture.bytes.size(), stride)
          : WebPDecodeRGBInto(data, file.size(), picture.bytes.data(), picture.bytes.size(), stride);
  if (!end) return detail::refused_picture("the WebP is damaged: its pixels cannot be read");
  return decoded;
}

}  // namespace seedmesh::texture
