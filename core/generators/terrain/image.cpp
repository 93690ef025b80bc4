#include "core/generators/terrain/image.h"

#include <array>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/texture/png.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

constexpr std::int8_t no_digit = -1;

constexpr std::array<std::int8_t, 256> digit_values() {
  std::array<std::int8_t, 256> values{};
  for (std::int8_t& value : values) value = no_digit;
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < digits.size(); ++i)
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
  return values;
}
constexpr std::array<std::int8_t, 256> values = digit_values();

Error fault(std::string pointer, std::string message) {
  return Error{Code::invalid, {{std::move(pointer), std::move(message)}}};
}

/// What stands between the first and the last height, from the value of a pixel as a share of the greatest.
struct Scale {
  double low, span;
  float height(double share) const { return static_cast<float>(low + span * share); }
};

Result<Field> of_raw(const TerrainImage& image, std::span<const std::uint8_t> bytes, const Scale& scale,
                     const Job& job) {
  if (bytes.size() % 2 != 0 || bytes.size() < 8)
    return fault("/image/data", "found " + std::to_string(bytes.size()) +
                                    " bytes; samples have 2 bytes each, and there are at least 4");
  const std::size_t count = bytes.size() / 2;
  const auto root = static_cast<std::size_t>(std::floor(std::sqrt(static_cast<double>(count)) + 0.5));
  const std::size_t width = image.width ? static_cast<std::size_t>(*image.width) : root;
  if (width == 0 || count % width != 0 || count / width < 2 || (!image.width && root * root != count)) {
    return fault("/image/data", "found " + std::to_string(count) + " samples, which are not " +
                                    (image.width ? "rows of " + std::to_string(width)
                                                 : std::string("a square; give the width")));
  }
  if (width > 16'385 || count / width > 16'385)
    return fault("/image/data", "a side has more than 16385 samples");
  Field field(job, static_cast<std::int32_t>(width), static_cast<std::int32_t>(count / width), 0);
  const std::size_t high = image.encoding == TerrainEncoding::r16_big ? 0 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned value = (unsigned{bytes[2 * i + high]} << 8U) | bytes[2 * i + 1 - high];
    field.heights[i] = scale.height(value / 65535.0);
  }
  return field;
}

/// Whether a picture can hold heights in this way, in words where it cannot.
std::string misfit(const texture::Picture& picture, TerrainEncoding encoding) {
  const std::string found = "found " + std::to_string(picture.channels) + " channels of " +
                            std::to_string(picture.bits) + " bits; ";
  if (encoding == TerrainEncoding::grey && picture.channels > 2)
    return found + "grey is one channel (rgb24 and rgba32 pack a height into several)";
  if (encoding == TerrainEncoding::rgb24 && (picture.channels < 3 || picture.bits != 8))
    return found + "rgb24 is 3 channels of 8 bits";
  if (encoding == TerrainEncoding::rgba32 && (picture.channels != 4 || picture.bits != 8))
    return found + "rgba32 is 4 channels of 8 bits";
  if (picture.width < 2 || picture.height < 2)
    return "found " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
           " pixels; a field has at least 2 x 2";
  return "";
}

Result<Field> of_png(const TerrainImage& image, std::span<const std::uint8_t> bytes, const Scale& scale,
                     const Job& job) {
  Result<texture::Picture> read = texture::decode_png(std::as_bytes(bytes), {}, job);
  if (!read) return fault("/image/data", read.error().issues.front().message);
  const texture::Picture& picture = *read;
  const std::string wrong = misfit(picture, image.encoding);
  if (!wrong.empty()) return fault("/image/data", wrong);
  Field field(job, static_cast<std::int32_t>(picture.width), static_cast<std::int32_t>(picture.height), 0);
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const auto channel = [&](std::size_t k) { return picture.channel(i * channels + k); };
    double share = 0;
    if (image.encoding == TerrainEncoding::grey) {
      share = channel(0) / (picture.bits == 8 ? 255.0 : 65535.0);
    } else if (image.encoding == TerrainEncoding::rgb24) {
      share = (channel(0) << 16U | channel(1) << 8U | channel(2)) / 16777215.0;
    } else {
      share = (channel(0) << 24U | channel(1) << 16U | channel(2) << 8U | channel(3)) / 4294967295.0;
    }
    field.heights[i] = scale.height(share);
  }
  return field;
}

void flip(Field& field) {
  for (std::int32_t z = 0; z < field.depth / 2; ++z)
    std::swap_ranges(field.row(z), field.row(z) + field.width, field.row(field.depth - 1 - z));
}

}  // namespace

Result<Array<std::uint8_t>> bytes_of_base64(std::string_view text, const Job& job) {
  std::size_t start = 0;
  if (text.starts_with("data:")) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || !text.substr(0, comma).ends_with(";base64"))
      return fault("", "a data: URL is taken where it has base64: data:image/png;base64,…");
    start = comma + 1;
  }
  std::string_view digits = text.substr(start);
  for (int padding = 0; padding < 2 && digits.ends_with('='); ++padding) digits.remove_suffix(1);
  Array<std::uint8_t> bytes(job);
  bytes.reserve(digits.size() / 4 * 3 + 2);
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const std::int8_t value = values[static_cast<unsigned char>(digits[i])];
    if (value == no_digit) return fault("", "character " + std::to_string(start + i + 1) + " is no base64");
    word = word << 6U | static_cast<std::uint32_t>(value);
    if (i % 4 != 0) bytes.push_back(static_cast<std::uint8_t>(word >> (6 - i % 4 * 2)));
  }
  if (digits.size() % 4 == 1) return fault("", "base64 does not end after one character of four");
  return bytes;
}

Result<Field> field_of_image(const TerrainImage& image, const Job& job) {
  Result<Array<std::uint8_t>> bytes = bytes_of_base64(image.data, job);
  if (!bytes) return fault("/image/data", bytes.error().issues.front().message);
  const Scale scale{image.low, image.high - image.low};
  const bool raw = image.encoding == TerrainEncoding::r16 || image.encoding == TerrainEncoding::r16_big;
  Result<Field> field =
      raw ? of_raw(image, bytes->span(), scale, job) : of_png(image, bytes->span(), scale, job);
  if (field && image.flip) flip(*field);
  return field;
}

}  // namespace seedmesh::terrain
