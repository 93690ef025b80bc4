/// A file of any bytes as a JPEG, WebP or TIFF: it is refused in words, or gives as many pixels as its sizes say.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/texture/decode.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  Job::Options options;
  options.limits.memory_bytes = std::uint64_t{64} << 20U;
  const Job job(0, options);
  try {
    const Result<texture::Decoded> decoded =
        texture::decode_picture(std::as_bytes(std::span(data, size)), {.longest_side = 2049}, job);
    if (!decoded) {
      if (decoded.error().issues.front().message.empty()) std::abort();
      return 0;
    }
    if (decoded->picture) {
      const texture::Picture& picture = *decoded->picture;
      const std::size_t bytes = std::size_t{picture.width} * picture.height *
                                static_cast<std::size_t>(picture.channels) *
                                static_cast<std::size_t>(picture.bits / 8);
      if (picture.bytes.size() != bytes || bytes == 0) std::abort();
    } else if (decoded->samples->values.size() !=
               std::size_t{decoded->samples->width} * decoded->samples->height) {
      std::abort();
    }
  } catch (const Stop&) {
    // The memory budget; the pipeline reports it.
  }
  return 0;
}
