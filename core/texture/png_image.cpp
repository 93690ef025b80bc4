#include "core/texture/png_image.h"

namespace seedmesh::texture {

std::shared_ptr<const Image> png_image(std::string name, const PictureView& picture, PngEffort effort,
                                       const Job& job) {
  const Array<std::uint8_t> file = encode_png(picture, effort, job);
  auto image = std::make_shared<Image>();
  image->name = std::move(name);
  image->bytes.assign(file.begin(), file.end());
  return image;
}

}  // namespace seedmesh::texture
