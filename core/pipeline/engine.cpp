/// The engine version: a number that is raised by hand whenever a seed yields another model, and a
/// fingerprint of the libraries that decide about bytes.
#include <libdeflate.h>
#include <meshoptimizer.h>
#include <png.h>
#include <sleef.h>
#include <zlib.h>

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/rng.h"
#include "core/pipeline.h"
#include "core/texture/webp_write.h"

namespace seedmesh {
namespace {

constexpr int engine_number = 3;

std::string made_version() {
  const auto part = [](const char* name, auto... numbers) {
    std::string text = name;
    ((text += "." + std::to_string(numbers)), ...);
    return text + ";";
  };
  const std::string libraries =
      part("sleef", SLEEF_VERSION_MAJOR, SLEEF_VERSION_MINOR, SLEEF_VERSION_PATCHLEVEL) +
      part("meshoptimizer", MESHOPTIMIZER_VERSION) +
      part("zlib", ZLIB_VER_MAJOR, ZLIB_VER_MINOR, ZLIB_VER_REVISION) +
      part("libpng", PNG_LIBPNG_VER_MAJOR, PNG_LIBPNG_VER_MINOR, PNG_LIBPNG_VER_RELEASE) +
      part("libdeflate", LIBDEFLATE_VERSION_MAJOR, LIBDEFLATE_VERSION_MINOR) +
      part("libwebp", texture::webp_encoder_version()) +
      part("json", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  std::array<char, 16> digits{};
  const std::uint64_t fingerprint = Rng(0).at(libraries).key() & 0xFFFFFFFFU;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), fingerprint, 16);
  return std::to_string(engine_number) + "-" + std::string(digits.data(), end.ptr);
}

}  // namespace

std::string_view engine_version() {
  static const std::string version = made_version();
  return version;
}

std::string_view program_version() { return SEEDMESH_VERSION; }

}  // namespace seedmesh
