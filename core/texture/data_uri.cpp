#include "core/texture/data_uri.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/base64.h"
#include "core/texture/png.h"

namespace seedmesh::texture {
namespace {

constexpr std::string_view png_head = "data:image/png;base64,", jpeg_head = "data:image/jpeg;base64,";
constexpr std::uint32_t longest_side = 8'192;

/// None if the text is not base64. Padding is optional; unused bits must be 0.
std::optional<std::vector<std::uint8_t>> decoded(std::string_view text) {
  while (!text.empty() && text.back() == '=' && text.size() % 4 != 1) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::uint8_t> bytes(base64_bytes(text.size()));
  const Base64End end = read_base64(text, bytes.data());
  if (end.bad != std::string_view::npos || end.unused != 0) return std::nullopt;
  return bytes;
}

/// The media type or the first characters of a text that is no image, for a message; may be empty.
std::string said_of(std::string_view text) {
  constexpr std::size_t most = 40;
  const std::string_view head = text.substr(0, std::min({text.find_first_of(",;"), text.size(), most}));
  const bool is_plain = std::ranges::all_of(head, [](char c) { return c > ' ' && c < 0x7F && c != '"'; });
  if (head.empty() || !is_plain) return "no image";
  return "\"" + std::string(head) + (head.size() < text.size() ? "…" : "") + "\", which is not such an image";
}

Error invalid_input(std::string message) {
  return {Code::invalid, {{IssueKind::invalid_value, "", std::move(message)}}};
}

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U |
         std::uint32_t{bytes[3]};
}

/// Checks the chunks of a PNG file (ISO/IEC 15948, 5.3), with the messages of decode_png.
std::string error_of_png(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  if (bytes.size() < signature.size() || !std::equal(signature.begin(), signature.end(), bytes.begin()))
    return "found " + std::to_string(bytes.size()) + " bytes without the signature of a PNG";
  constexpr std::size_t around = 12;  // length, name and checksum
  for (std::size_t at = signature.size(); at + around <= bytes.size();) {
    const std::size_t length = big_endian(bytes.data() + at);
    const std::string_view name(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4);
    if (length > bytes.size() - at - around) break;
    if (name == "IEND") return "";
    if (name == "IHDR" && length >= 8) {
      const std::uint32_t width = big_endian(bytes.data() + at + 8),
                          height = big_endian(bytes.data() + at + 12);
      if (std::max(width, height) > longest_side) {
        return "the PNG has " + std::to_string(width) + " x " + std::to_string(height) +
               " pixels; a side may have " + std::to_string(longest_side);
      }
    }
    at += around + length;
  }
  return "the PNG is truncated: it ends after " + std::to_string(bytes.size()) +
         " bytes, before the end of its data";
}

/// Checks the segments of a JPEG file up to its frame header (ISO/IEC 10918-1, B.1.1.4 and B.2.2), and its end.
std::string error_of_jpeg(const std::vector<std::uint8_t>& bytes) {
  std::string partial = "found no complete JPEG file";
  const std::size_t size = bytes.size();
  if (size < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8 || bytes[size - 2] != 0xFF || bytes[size - 1] != 0xD9)
    return partial;
  for (std::size_t at = 2; at + 9 <= size && bytes[at] == 0xFF;) {
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {  // filling before a marker
      ++at;
      continue;
    }
    // A frame header is C0 to CF, except C4, C8 and CC, which are tables and an extension.
    if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
      const unsigned height = bytes[at + 5] * 256U + bytes[at + 6],
                     width = bytes[at + 7] * 256U + bytes[at + 8];
      if (width == 0 || height == 0) return "the JPEG does not state its size";
      if (std::max(width, height) <= longest_side) return "";
      return "the JPEG has " + std::to_string(width) + " x " + std::to_string(height) +
             " pixels; a side may have " + std::to_string(longest_side);
    }
    if (marker < 0xC0 || marker == 0xD9 || marker == 0xDA) break;  // data before a frame
    const std::size_t length = bytes[at + 2] * 256U + bytes[at + 3];
    if (length < 2) break;
    at += 2 + length;
  }
  return partial;
}

}  // namespace

std::string error_of_image_uri(std::string_view text) {
  const bool is_png = text.starts_with(png_head);
  if (is_png || text.starts_with(jpeg_head)) {
    const auto bytes = decoded(text.substr(is_png ? png_head.size() : jpeg_head.size()));
    if (!bytes) return "found characters that are not base64";
    if (is_png) return error_of_png(*bytes);
    return error_of_jpeg(*bytes);
  }
  return "found " + said_of(text) + "; expected \"" + std::string(png_head) + "…\" or \"" +
         std::string(jpeg_head) + "…\"";
}

Result<std::shared_ptr<const Image>> image_of_data_uri(std::string_view text, const std::string& name,
                                                       const Job& job) {
  const bool is_png = text.starts_with(png_head);
  if (!is_png && !text.starts_with(jpeg_head)) return invalid_input(error_of_image_uri(text));
  auto bytes = decoded(text.substr(is_png ? png_head.size() : jpeg_head.size()));
  if (!bytes) return invalid_input("found characters that are not base64");
  if (is_png) {
    if (auto picture = decode_png(std::as_bytes(std::span(*bytes)), {longest_side}, job); !picture)
      return std::move(picture).error();
  } else if (std::string message = error_of_jpeg(*bytes); !message.empty()) {
    return invalid_input(std::move(message));
  }
  auto image = std::make_shared<Image>();
  image->name = name;
  image->mime = is_png ? "image/png" : "image/jpeg";
  image->is_given = true;
  image->bytes = std::move(*bytes);
  return std::shared_ptr<const Image>(std::move(image));
}

int add_image_of_uri(Model& model, const std::string& uri, const std::string& name,
                     const std::string& pointer, const Job& job) {
  Result<std::shared_ptr<const Image>> image = image_of_data_uri(uri, name, job);
  if (!image) job.refuse({IssueKind::invalid_value, pointer, image.error().issues.front().message});
  model.textures.push_back(*std::move(image));
  return static_cast<int>(model.textures.size()) - 1;
}

Result<Array<std::uint8_t>> bytes_of_base64(std::string_view text, const Job& job) {
  std::size_t start = 0;
  if (text.starts_with("data:")) {
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || !text.substr(0, comma).ends_with(";base64"))
      return invalid_input("found a data: URL without base64; expected data:image/png;base64,…");
    start = comma + 1;
  }
  const std::string_view digits = without_padding(text.substr(start));
  Array<std::uint8_t> bytes(job, base64_bytes(digits.size()));
  if (const Base64End end = read_base64(digits, bytes.data()); end.bad != std::string_view::npos)
    return invalid_input("character " + std::to_string(start + end.bad + 1) + " is not base64");
  if (digits.size() % 4 == 1)
    return invalid_input("found base64 whose last group has one character of four; expected two or more");
  return bytes;
}

Result<Brightness> brightness_of_png(std::string_view text, const Job& job) {
  const Result<Array<std::uint8_t>> bytes = bytes_of_base64(text, job);
  if (!bytes) return bytes.error();
  const Result<Picture> picture = decode_png(std::as_bytes(bytes->span()), {}, job);
  if (!picture) return picture.error();
  Brightness made{picture->width, picture->height, Array<float>(job)};
  const std::size_t count = std::size_t{made.width} * made.height;
  const auto channels = static_cast<std::size_t>(picture->channels);
  const std::size_t colors = channels < 3 ? 1 : 3;
  const double greatest = picture->bits == 8 ? 255.0 : 65535.0;
  made.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    double sum = 0;
    for (std::size_t k = 0; k < colors; ++k) sum += picture->channel(i * channels + k);
    made.values.push_back(static_cast<float>(sum / static_cast<double>(colors) / greatest));
  }
  return made;
}

bool has_alpha(const Image& image) {
  // The signature, then IHDR: length, name, width, height, depth, and the type of colour, whose bit 2 is
  // alpha.
  constexpr std::size_t type_of_color = 25, after_header = 33, around = 12;
  const std::vector<std::uint8_t>& bytes = image.bytes;
  if (image.mime != "image/png" || bytes.size() < after_header) return false;
  if ((bytes[type_of_color] & 4U) != 0) return true;
  for (std::size_t at = after_header; at + around <= bytes.size();) {
    const std::size_t length = big_endian(bytes.data() + at);
    if (std::string_view(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4) == "tRNS") return true;
    if (length > bytes.size() - at - around) return false;
    at += around + length;
  }
  return false;
}

}  // namespace seedmesh::texture
