#include "core/texture/decode.h"

#include <string>
#include <string_view>

namespace seedmesh::texture {
namespace detail {

Error refused_picture(std::string message) {
  return Error{Code::invalid, {{IssueKind::invalid_value, "", std::move(message)}}};
}

std::optional<Error> size_error(const char* format, std::uint64_t width, std::uint64_t height,
                                const PngLimits& limits) {
  if (width > 0 && height > 0 && width <= limits.longest_side && height <= limits.longest_side)
    return std::nullopt;
  return refused_picture(std::string("the ") + format + " has " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels; a side may have " +
                         std::to_string(limits.longest_side));
}

}  // namespace detail

std::string_view picture_format(std::span<const std::byte> file) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (text.starts_with("\x89PNG\r\n\x1A\n")) return "PNG";
  if (text.starts_with("RIFF") && text.size() >= 12 && text.substr(8, 4) == "WEBP") return "WebP";
  if (text.size() >= 11 && text.starts_with("\xFF\xD8\xFF") &&
      (text.substr(6, 4) == "JFIF" || text.substr(6, 4) == "Exif"))
    return "JPEG";
  for (const std::string_view head : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                      std::string_view("II+\0", 4), std::string_view("MM\0+", 4)}) {
    if (text.starts_with(head)) return "TIFF";
  }
  return "";
}

Result<Decoded> decode_picture(std::span<const std::byte> file, const PngLimits& limits, const Job& job) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const std::string_view format = picture_format(file);
  if (format == "TIFF") return decode_tiff(file, limits, job);
  const auto as_decoded = [](Result<Picture> picture, bool is_lossy) -> Result<Decoded> {
    if (!picture) return std::move(picture).error();
    Decoded decoded;
    decoded.is_lossy = is_lossy;
    decoded.picture.emplace(std::move(*picture));
    return decoded;
  };
  if (text.starts_with("\xFF\xD8\xFF")) return as_decoded(decode_jpeg(file, limits, job), true);
  if (format == "WebP") return decode_webp(file, limits, job);
  if (text.starts_with("\x89PNG")) return as_decoded(decode_png(file, limits, job), false);
  return detail::refused_picture("found " + std::to_string(file.size()) +
                                 " bytes without the signature of a PNG, JPEG, WebP or TIFF");
}

}  // namespace seedmesh::texture
