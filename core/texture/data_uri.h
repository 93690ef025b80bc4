#pragma once
/// Pictures that come inside a request, as data URIs (RFC 2397) in base64 (RFC 4648).
#include <memory>
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::texture {

/// Is it the data URI of a PNG or JPEG file that is there from its first to its last byte? Empty where it is,
/// else what is wrong. The pixels are not looked at. Cost: that of reading base64, about 2 ns a byte.
std::string fault_of_image_uri(std::string_view text);

/// The file, byte for byte. A PNG file is read through (png.h), so that none that is damaged or larger than
/// 8,192 texels goes out again; of a JPEG file only the first and last bytes are looked at. The text is
/// hostile until shown otherwise; an Issue with an empty pointer says what is wrong.
Result<std::shared_ptr<const Image>> image_of_data_uri(std::string_view text, const std::string& name,
                                                       const Job& job);

/// Has a picture that came so an alpha channel, or one colour that is transparent? JPEG files have none.
bool has_alpha(const Image& image);

}  // namespace seedmesh::texture
