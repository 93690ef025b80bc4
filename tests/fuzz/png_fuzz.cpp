/// A file of any bytes as a PNG: it is refused in words, or its pixels survive being written and read again.
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>

#include "core/texture/png.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  Job::Options options;
  options.limits.memory_bytes = std::uint64_t{64} << 20U;
  const Job job(0, options);
  try {
    const Result<texture::Picture> picture =
        texture::decode_png(std::as_bytes(std::span(data, size)), {.longest_side = 2049}, job);
    if (!picture) {
      if (picture.error().issues.front().message.empty()) std::abort();
      return 0;
    }
    const Array<std::uint8_t> file = texture::encode_png(picture->view(), texture::PngEffort::streamed, job);
    const Result<texture::Picture> again =
        texture::decode_png(std::as_bytes(file.span()), {.longest_side = 2049}, job);
    if (!again || again->channels != picture->channels || again->bits != picture->bits ||
        again->bytes.size() != picture->bytes.size() ||
        std::memcmp(again->bytes.data(), picture->bytes.data(), picture->bytes.size()) != 0) {
      std::abort();
    }
  } catch (const Stop&) {
    // The memory budget is exceeded, which the pipeline reports to the client.
  }
  return 0;
}
