/// A text of any bytes as the data URI of a picture: it is refused in words, or the file in it comes out.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/texture/data_uri.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  Job::Options options;
  options.limits.memory_bytes = std::uint64_t{64} << 20U;
  const Job job(0, options);
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const auto image = texture::image_of_data_uri(text, "x", job);
    if (!image && image.error().issues.front().message.empty()) std::abort();
    if (image && ((*image)->bytes.empty() || !texture::error_of_image_uri(text).empty())) std::abort();
  } catch (const Stop&) {
    // The memory budget is exceeded, which the pipeline reports to the client.
  }
  return 0;
}
