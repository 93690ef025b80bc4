#pragma once
/// Images inside a request: data URIs (RFC 2397) and base64 (RFC 4648).
#include <memory>
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::texture {

/// Checks that a text is the data URI of a complete PNG or JPEG file. Returns an empty text if so, else the
/// error. The pixels are not decoded. Cost: about 2 ns a byte.
std::string error_of_image_uri(std::string_view text);

/// Returns the bytes of the file. A PNG file is decoded (png.h), so that a damaged file or one of more than 8,192
/// texels along a side is an error. Of a JPEG file, its end and the segments before its data are checked. The same
/// limit applies to the size in its frame header. The text may be hostile. The Issue of an error has an empty pointer.
Result<std::shared_ptr<const Image>> image_of_data_uri(std::string_view text, const std::string& name,
                                                       const Job& job);

/// Adds the image of a data URI to the textures of a model, and returns its index. Refuses the request with `pointer` if
/// the image has an error.
int add_image_of_uri(Model& model, const std::string& uri, const std::string& name,
                     const std::string& pointer, const Job& job);

/// Decodes base64 (RFC 4648 section 4, padding optional). If the text is a data URI of any type, only the part after
/// its head is decoded. An issue with an empty pointer names the first invalid character.
Result<Array<std::uint8_t>> bytes_of_base64(std::string_view text, const Job& job);

/// The brightness of each pixel, 0 to 1: the mean of its colour channels. Rows from the top.
struct Brightness {
  std::uint32_t width = 0, height = 0;
  Array<float> values;
};

/// Reads a PNG file in base64, as bytes_of_base64() and decode_png() do. The Issue of an error has an empty pointer.
Result<Brightness> brightness_of_png(std::string_view text, const Job& job);

/// Whether an image from a data URI has an alpha channel or a transparent colour. JPEG files have none.
bool has_alpha(const Image& image);

}  // namespace seedmesh::texture
