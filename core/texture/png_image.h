#pragma once
/// Images of a model as PNG files.
#include <memory>
#include <string>

#include "core/model/model.h"
#include "core/texture/png.h"

namespace seedmesh::texture {

/// Returns an image with the PNG file of a picture. Cost: that of encode_png().
std::shared_ptr<const Image> png_image(std::string name, const PictureView& picture, PngEffort effort,
                                       const Job& job);

}  // namespace seedmesh::texture
