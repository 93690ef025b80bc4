#pragma once
/// Images inside a request: data URIs (RFC 2397) in base64 (RFC 4648).
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
/// limit holds for the size in its frame header. The text may be hostile. The Issue of an error has an empty pointer.
Result<std::shared_ptr<const Image>> image_of_data_uri(std::string_view text, const std::string& name,
                                                       const Job& job);

/// Whether an image from a data URI has an alpha channel or a transparent colour. JPEG files have none.
bool has_alpha(const Image& image);

}  // namespace seedmesh::texture
