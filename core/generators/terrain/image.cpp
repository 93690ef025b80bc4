#include "core/generators/terrain/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "core/generators/terrain/voids.h"
#include "core/texture/data_uri.h"
#include "core/texture/decode.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

// Steps of 255 by which WebP and JPEG change the channels of grey.
constexpr std::uint32_t lossy_slack = 8;

constexpr std::uint32_t longest_side = 16'385;
constexpr float no_height = std::numeric_limits<float>::quiet_NaN();

Error invalid_input(std::string pointer, std::string message) {
  return Error{Code::invalid, {{IssueKind::invalid_value, std::move(pointer), std::move(message)}}};
}

/// Maps the value of a pixel, as a share of the greatest value, to a height between the first and the last.
struct Scale {
  double low, span;
  float height(double share) const { return static_cast<float>(low + span * share); }
};

// Files mark voids with heights beyond this number of metres, which do not exist on the Earth.
constexpr double farthest = 2e6;
constexpr int short_void = -32768;

bool is_signed(TerrainEncoding encoding) {
  return encoding == TerrainEncoding::s16 || encoding == TerrainEncoding::s16_big ||
         encoding == TerrainEncoding::hgt;
}
bool is_raw(TerrainEncoding encoding) {
  return encoding == TerrainEncoding::r16 || encoding == TerrainEncoding::r16_big || is_signed(encoding);
}

/// Reads raw samples of 16 bits: shares of the greatest value, or signed metres.
Result<Field> of_raw(const TerrainImage& image, std::span<const std::uint8_t> bytes, const Scale& scale,
                     const Job& job) {
  if (const std::string_view format = texture::picture_format(std::as_bytes(bytes)); !format.empty()) {
    return invalid_input("/image/encoding",
                         "found a " + std::string(format) + " file, expected raw samples for this encoding");
  }
  if (bytes.size() % 2 != 0 || bytes.size() < 8) {
    return invalid_input("/image/data", "found " + std::to_string(bytes.size()) +
                                            " bytes; expected at least 4 samples of 2 bytes each");
  }
  const std::size_t count = bytes.size() / 2;
  const auto root = static_cast<std::size_t>(std::floor(std::sqrt(static_cast<double>(count)) + 0.5));
  const std::size_t width = image.width ? static_cast<std::size_t>(*image.width) : root;
  if (width == 0 || count % width != 0 || count / width < 2 || (!image.width && root * root != count)) {
    const bool is_hgt = image.encoding == TerrainEncoding::hgt;
    return invalid_input("/image/data", "found " + std::to_string(count) + " samples, which are not " +
                                            (image.width ? "rows of " + std::to_string(*image.width)
                                             : is_hgt    ? std::string("a square; an .hgt file is square")
                                                         : std::string("a square; give the width")));
  }
  if (width > longest_side || count / width > longest_side)
    return invalid_input("/image/data", "a side has more than 16385 samples");
  Field field(job, static_cast<std::int32_t>(width), static_cast<std::int32_t>(count / width), 0);
  const bool is_big = image.encoding == TerrainEncoding::r16_big ||
                      image.encoding == TerrainEncoding::s16_big || image.encoding == TerrainEncoding::hgt;
  const std::size_t high = is_big ? 0 : 1;
  const bool has_sign = is_signed(image.encoding);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const unsigned value = (unsigned{bytes[2 * i + high]} << 8U) | bytes[2 * i + 1 - high];
    if (has_sign) {
      const int metres = value < 0x8000U ? static_cast<int>(value) : static_cast<int>(value) - 0x10000;
      field.heights[i] = metres == short_void ? no_height : static_cast<float>(metres);
    } else {
      field.heights[i] = scale.height(value / 65535.0);
    }
  }
  return field;
}

/// Whether a picture can store heights in this way; the reason where it cannot.
std::string picture_error(const texture::Picture& picture, TerrainEncoding encoding) {
  const std::string found = "found " + std::to_string(picture.channels) + " channels of " +
                            std::to_string(picture.bits) + " bits; ";
  if (encoding == TerrainEncoding::metres && picture.channels > 2) return found + "metres is one channel";
  if (encoding == TerrainEncoding::rgb24 && (picture.channels < 3 || picture.bits != 8))
    return found + "rgb24 is 3 channels of 8 bits";
  if (encoding == TerrainEncoding::rgba32 && (picture.channels != 4 || picture.bits != 8))
    return found + "rgba32 is 4 channels of 8 bits";
  if (encoding == TerrainEncoding::terrain_rgb && (picture.channels < 3 || picture.bits != 8))
    return found + "terrain_rgb is 3 channels of 8 bits";
  if (encoding == TerrainEncoding::terrarium && (picture.channels < 3 || picture.bits != 8))
    return found + "terrarium is 3 channels of 8 bits";
  if (picture.width < 2 || picture.height < 2) {
    return "found " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
           " pixels; a field has at least 2 x 2";
  }
  return "";
}

/// Whether the channels of a pixel are digits of one number.
bool packs_digits(TerrainEncoding encoding) {
  return encoding == TerrainEncoding::terrain_rgb || encoding == TerrainEncoding::terrarium ||
         encoding == TerrainEncoding::rgb24 || encoding == TerrainEncoding::rgba32;
}

/// The first pixel whose channels differ by more than `slack`, of a grey picture that is saved in colour; -1 without one.
std::int64_t first_colored(const texture::Picture& picture, std::uint32_t slack) {
  if (picture.channels < 3) return -1;
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t count = std::size_t{picture.width} * picture.height;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t red = picture.channel(i * channels), green = picture.channel(i * channels + 1),
                        blue = picture.channel(i * channels + 2);
    if (std::max({red, green, blue}) - std::min({red, green, blue}) > slack)
      return static_cast<std::int64_t>(i);
  }
  return -1;
}

/// The height of a pixel whose channels are given by their number.
template <class Channel>
float height_of(const Channel& channel, TerrainEncoding encoding, int bits, const Scale& scale) {
  switch (encoding) {
    case TerrainEncoding::rgb24:
      return scale.height((channel(0) << 16U | channel(1) << 8U | channel(2)) / 16777215.0);
    case TerrainEncoding::rgba32:
      return scale.height((channel(0) << 24U | channel(1) << 16U | channel(2) << 8U | channel(3)) /
                          4294967295.0);
    case TerrainEncoding::terrain_rgb:
      return static_cast<float>(-10000 + (channel(0) << 16U | channel(1) << 8U | channel(2)) * 0.1);
    case TerrainEncoding::terrarium:
      return static_cast<float>((channel(0) << 8U | channel(1)) + channel(2) / 256.0 - 32768);
    case TerrainEncoding::metres:
      return static_cast<float>(channel(0));
    default:
      return scale.height(channel(0) / (bits == 8 ? 255.0 : 65535.0));
  }
}

/// The number of pixels that are not opaque; 0 for pictures without alpha.
std::uint64_t transparent_pixels(const texture::Picture& picture) {
  if (picture.channels != 2 && picture.channels != 4) return 0;
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::uint32_t opaque = picture.bits == 8 ? 255 : 65535;
  std::uint64_t count = 0;
  for (std::size_t i = 1; i <= std::size_t{picture.width} * picture.height; ++i)
    count += picture.channel(i * channels - 1) == opaque ? 0 : 1;
  return count;
}

Result<Field> of_picture(const TerrainImage& image, const texture::Decoded& decoded, const Scale& scale,
                         const Job& job) {
  const texture::Picture& picture = *decoded.picture;
  std::string wrong = picture_error(picture, image.encoding);
  if (wrong.empty() && decoded.is_lossy && packs_digits(image.encoding)) {
    wrong =
        "found lossy compression (JPEG or WebP), which changes the digits of heights; expected a PNG or a "
        "lossless WebP";
  }
  if (!wrong.empty()) return invalid_input("/image/data", wrong);
  const std::int64_t colored = image.encoding == TerrainEncoding::grey
                                   ? first_colored(picture, decoded.is_lossy ? lossy_slack : 0)
                                   : -1;
  if (colored >= 0) {
    return invalid_input(
        "/image/data",
        "the pixel in column " + std::to_string(colored % picture.width) + " of row " +
            std::to_string(colored / picture.width) +
            " is not grey (rgb24, rgba32, terrain_rgb and terrarium pack a height into several channels)");
  }
  Field field(job, static_cast<std::int32_t>(picture.width), static_cast<std::int32_t>(picture.height), 0);
  const auto channels = static_cast<std::size_t>(picture.channels);
  const bool has_voids = image.encoding == TerrainEncoding::metres && decoded.no_data.has_value();
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const auto channel = [&](std::size_t k) { return picture.channel(i * channels + k); };
    const bool is_void = has_voids && static_cast<double>(channel(0)) == *decoded.no_data;
    field.heights[i] = is_void ? no_height : height_of(channel, image.encoding, picture.bits, scale);
  }
  const std::uint64_t transparent =
      image.encoding == TerrainEncoding::rgba32 ? 0 : transparent_pixels(picture);
  if (transparent > 0) {
    field.notes.push_back({"/image/data",
                           "the transparency of " + std::to_string(transparent) + " of " +
                               std::to_string(field.heights.size()) +
                               " pixels has no effect; their heights are used",
                           0, 0});
  }
  return field;
}

/// Adds the warning of heights that the Earth does not have to a field whose encoding is made for the Earth.
void warn_of_heights(const TerrainImage& image, Field& field) {
  constexpr float deepest = -11'500, highest = 9'000;
  if (image.encoding != TerrainEncoding::terrain_rgb && image.encoding != TerrainEncoding::terrarium) return;
  const auto [low, high] = std::ranges::minmax(field.heights.span());
  if (low >= deepest && high <= highest) return;
  field.notes.push_back({"/image/encoding",
                         "found heights from " + std::to_string(std::lround(low)) + " to " +
                             std::to_string(std::lround(high)) +
                             " metres, which the Earth does not have; the image may have another encoding",
                         0, 0});
}

Result<Field> of_samples(const TerrainImage& image, const texture::Decoded& decoded, const Job& job) {
  const texture::Samples& samples = *decoded.samples;
  if (image.encoding != TerrainEncoding::metres) {
    return invalid_input("/image/encoding",
                         "found a TIFF of signed, 32-bit or floating-point samples; expected metres");
  }
  if (samples.width < 2 || samples.height < 2) {
    return invalid_input("/image/data", "found " + std::to_string(samples.width) + " x " +
                                            std::to_string(samples.height) +
                                            " samples; a field has at least 2 x 2");
  }
  Field field(job, static_cast<std::int32_t>(samples.width), static_cast<std::int32_t>(samples.height), 0);
  const bool has_voids = decoded.no_data.has_value();
  const auto missing = static_cast<float>(decoded.no_data.value_or(0));
  for (std::size_t i = 0; i < field.heights.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const float value = samples.values[i];
    const bool is_void =
        (has_voids && value == missing) || !(std::abs(static_cast<double>(value)) <= farthest);
    field.heights[i] = is_void ? no_height : value;
  }
  return field;
}

Result<Field> of_file(const TerrainImage& image, std::span<const std::uint8_t> bytes, const Scale& scale,
                      const Job& job) {
  Result<texture::Decoded> read =
      texture::decode_picture(std::as_bytes(bytes), {.longest_side = longest_side}, job);
  if (!read) return invalid_input("/image/data", read.error().issues.front().message);
  return read->picture ? of_picture(image, *read, scale, job) : of_samples(image, *read, job);
}

void flip(Field& field) {
  for (std::int32_t z = 0; z < field.depth / 2; ++z)
    std::swap_ranges(field.row(z), field.row(z) + field.width, field.row(field.depth - 1 - z));
}

}  // namespace

Result<Field> field_of_image(const TerrainImage& image, const Job& job) {
  Result<Array<std::uint8_t>> bytes = texture::bytes_of_base64(image.data, job);
  if (!bytes) return invalid_input("/image/data", bytes.error().issues.front().message);
  const Scale scale{image.low, image.high - image.low};
  Result<Field> field = is_raw(image.encoding) ? of_raw(image, bytes->span(), scale, job)
                                               : of_file(image, bytes->span(), scale, job);
  if (!field) return field;
  if (!fill_voids(*field, job)) return invalid_input("/image/data", "no sample has a height");
  warn_of_heights(image, *field);
  if (image.flip) flip(*field);
  return field;
}

}  // namespace seedmesh::terrain
