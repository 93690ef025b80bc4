/// The picture that a request for terrain carries: the first byte chooses how heights are written in it, the
/// rest stands where base64 should. It is refused in words, or gives a field of finite heights.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/generators/terrain/image.h"
#include "generated/params/terrain.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  if (size == 0) return 0;
  TerrainImage image;
  image.encoding = static_cast<TerrainEncoding>(data[0] % 11);
  image.flip = data[0] >= 128;
  image.data.assign(reinterpret_cast<const char*>(data + 1), size - 1);
  Job::Options options;
  options.limits.memory_bytes = std::uint64_t{64} << 20U;
  const Job job(0, options);
  try {
    const Result<terrain::Field> field = terrain::field_of_image(image, job);
    if (!field) {
      if (!field.error().issues.front().pointer.starts_with("/image")) std::abort();
      return 0;
    }
    if (field->width < 2 || field->depth < 2) std::abort();
    for (const float height : field->heights) {
      if (!std::isfinite(height)) std::abort();
    }
  } catch (const Stop&) {
    // The memory budget is exceeded, which the pipeline reports to the client.
  }
  return 0;
}
