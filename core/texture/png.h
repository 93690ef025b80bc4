#pragma once
/// PNG files (ISO/IEC 15948), written with libdeflate or libpng and read with libpng. No other file reads or
/// writes with libpng.
///
/// Writing: equal pixels give equal bytes with the same libraries, whose versions are part of the engine
/// version. The filter and the level are fixed. The chunks are IHDR, PLTE if there is a palette, IDAT and
/// IEND.
///
/// Reading: files may be hostile. Before pixels are allocated, sizes are checked against PngLimits and
/// against the greatest compression ratio of deflate, and are charged to the memory budget.
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "core/base/array.h"
#include "core/base/result.h"

namespace seedmesh::texture {

/// Pixels in rows from the top, without padding, with interleaved channels. Does not own them.
struct PictureView {
  std::uint32_t width = 0, height = 0;
  int channels = 1;                  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA
  int bits = 8;                      ///< bits of a channel: 8, or 16 in the byte order of the machine
  std::span<const std::byte> bytes;  ///< width * height * channels * bits / 8
  /// Up to 256 colours. If there are any, the picture has one channel of 8 bits, which contains indices into
  /// them.
  std::span<const glm::u8vec3> palette = {};
};

/// A picture that owns its pixels, whose memory is charged to a request.
struct Picture {
  std::uint32_t width = 0, height = 0;
  int channels = 1;
  int bits = 8;
  Array<std::uint8_t> bytes;

  /// Returns the value of the channel with this number, counted over all pixels, for 8 and 16 bits.
  std::uint32_t channel(std::size_t index) const;
  PictureView view() const { return {width, height, channels, bits, std::as_bytes(bytes.span())}; }
};

/// How a file is written. `streamed` needs no second copy of the pixels and is meant for large height maps
/// (libpng, level 1 of zlib); it has no palettes. `small` compresses all pixels at once (libdeflate, level
/// 4), and `quick` writes Huffman codes of single bytes and of runs (run_deflate.h). All use the filter Up.
/// For a texture of 512 x 512 RGB, `quick` takes 1 to 1.5 ms, `small` 5 to 9 ms.
enum class PngEffort { streamed, quick, small };

/// Writes a PNG file. Both sides have to be at least 1, and the number of bytes has to agree with the size
/// (both are asserted). Cost: about 50 ns a 16-bit grey pixel with `streamed`, 5 ns an RGB pixel with
/// `quick`.
Array<std::uint8_t> encode_png(const PictureView& picture, PngEffort effort, const Job& job);

struct PngLimits {
  std::uint32_t longest_side = 16'385;
};

/// Reads the pixels of a PNG file. Palettes become RGB, fewer than 8 bits become 8, and a transparent colour
/// becomes alpha. Gamma and colour profiles are ignored. A file that is truncated, damaged, too large or no
/// PNG is an Issue with an empty pointer. Cost: about 20 ns a 16-bit grey pixel.
Result<Picture> decode_png(std::span<const std::byte> file, const PngLimits& limits, const Job& job);

}  // namespace seedmesh::texture
