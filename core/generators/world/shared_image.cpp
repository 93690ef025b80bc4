#include "core/generators/world/shared_image.h"

#include "core/generators/world/asset.h"

namespace seedmesh::world {

SharedImage shared_image(const texture::PictureView& picture, const Job& job) {
  const Array<std::uint8_t> png = texture::encode_png(picture, texture::PngEffort::small, job);
  SharedImage image;
  image.file.assign(png.begin(), png.end());
  image.hash = hash_of(image.file);
  return image;
}

}  // namespace seedmesh::world
