#pragma once
/// Reads pixels of PNG, JPEG, WebP and TIFF files, which are recognised by their first bytes. Files may be
/// hostile: sizes are checked before pixels are allocated, and all memory is charged to the request.
/// decode.cpp lists the formats. Each has one file, the only one that reads with its library (libpng,
/// libjpeg-turbo, libwebp, libtiff).
#include <optional>
#include <string_view>

#include "core/texture/png.h"

namespace seedmesh::texture {

/// Values of a TIFF that do not fit a picture: signed integers, integers of 32 bits, or floating-point
/// numbers.
struct Samples {
  std::uint32_t width = 0, height = 0;
  Array<float> values;  ///< values of the first channel, in rows from the north or the top
};

/// Either a picture or samples.
struct Decoded {
  std::optional<Picture> picture;
  std::optional<Samples> samples;
  bool is_lossy = false;          ///< whether the format changes values (JPEG, most WebP)
  std::optional<double> no_data;  ///< the value that marks a missing one (GDAL_NODATA of a TIFF)
};

/// Returns the format of a file by its first bytes: PNG, JPEG, WebP or TIFF; empty for other bytes.
std::string_view picture_format(std::span<const std::byte> file);

/// Reads a file of any of the formats. A file that is truncated, damaged, too large or of another format is an Issue
/// with an empty pointer. Gamma, colour profiles and the orientation of cameras (EXIF) are ignored.
Result<Decoded> decode_picture(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

/// Reads a JPEG with one channel or three (T.81, baseline and progressive). The accurate integer transform is
/// used, so that equal files give equal pixels.
Result<Picture> decode_jpeg(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

/// Reads a WebP without animation: RGB, or RGBA if it has alpha.
Result<Decoded> decode_webp(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

/// Returns the first image of a TIFF (TIFF 6.0, BigTIFF) in strips or tiles, uncompressed or with LZW,
/// Deflate, PackBits or Zstandard. Grey, RGB and palettes of 8 or 16 bits become a picture, other numbers
/// samples. Rows of a GeoTIFF that run northwards are put in order.
Result<Decoded> decode_tiff(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

namespace detail {

/// Returns an error without a pointer.
Error refused_picture(std::string message);

/// Returns an error if a side of a picture is 0 or longer than the limit; nullopt otherwise.
std::optional<Error> size_error(const char* format, std::uint64_t width, std::uint64_t height,
                                const PngLimits& limits);

}  // namespace detail

}  // namespace seedmesh::texture
