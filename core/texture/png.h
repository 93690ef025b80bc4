#pragma once
/// Pictures as PNG files (ISO/IEC 15948), out and in, over libpng; the only room that includes it.
///
/// Writing: the same pixels give the same bytes with the same libpng and zlib, which the engine version
/// names: one fixed filter, one fixed level, no chunk but IHDR, IDAT and IEND, so no time and no author.
/// Reading takes files of strangers: sizes are checked against `PngLimits`, against what deflate could
/// possibly hold in a file of that length, and charged to the purse before pixels are allocated.
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/array.h"
#include "core/base/result.h"

namespace seedmesh::texture {

/// Pixels row by row from the top, without padding; the channels of a pixel stand together. Not owned.
struct PictureView {
  std::uint32_t width = 0, height = 0;
  int channels = 1;                  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  int bits = 8;                      ///< of a channel: 8, or 16 in the byte order of the machine
  std::span<const std::byte> bytes;  ///< width * height * channels * bits / 8
};

/// The same with its pixels, which are charged to a request.
struct Picture {
  std::uint32_t width = 0, height = 0;
  int channels = 1;
  int bits = 8;
  Array<std::uint8_t> bytes;

  /// The channel that stands `index` channels from the start, of either width.
  std::uint32_t channel(std::size_t index) const;
  PictureView view() const { return {width, height, channels, bits, std::as_bytes(bytes.span())}; }
};

/// What a file is for: `fast` (level 1, filter Up) for heights, whose noise no level compresses well;
/// `small` (level 6, filter Paeth) for pictures that are kept and sent often; `quick` (runs only, filter
/// Sub) for made textures: a third faster than with Paeth, a tenth larger; four times as fast as `small`.
enum class PngEffort { fast, small, quick };

/// A PNG file. Both sides are at least 1 and the bytes fit the size (asserted). About 50 ns a 16-bit grey
/// pixel with `fast`, 150 ns with `small`.
Array<std::uint8_t> encode_png(const PictureView& picture, PngEffort effort, const Job& job);

struct PngLimits {
  std::uint32_t longest_side = 16'385;
};

/// The pixels of a PNG file: palettes become RGB, fewer than 8 bits become 8, transparency given by one
/// colour becomes alpha; gamma and colour profiles are left alone. An Issue with an empty pointer says what
/// is wrong with a file that is truncated, damaged, too large or no PNG at all. About 20 ns a 16-bit grey
/// pixel.
Result<Picture> decode_png(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

}  // namespace seedmesh::texture
