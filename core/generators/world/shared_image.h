#pragma once
/// Images in files that tiles share.
#include <cstdint>
#include <string>

#include "core/base/job.h"
#include "core/texture/png.h"

namespace seedmesh::world {

/// A PNG file, and 16 hexadecimal digits of its content, which are its name.
struct SharedImage {
  std::string hash, file;
  std::uint64_t bytes() const { return sizeof(SharedImage) + file.size(); }
};

/// Returns the image as a small file.
SharedImage shared_image(const texture::PictureView& picture, const Job& job);

}  // namespace seedmesh::world
