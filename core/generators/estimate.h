#pragma once
/// The size of a model that has not been made.
#include <cstdint>
#include <map>
#include <string>

#include "core/model/demand.h"
#include "core/model/model.h"

namespace seedmesh {

struct Estimate {
  std::uint64_t triangles = 0;  ///< 0 where the model consists of lines or points
  std::uint64_t bytes = 0;      ///< approximate size of the GLB, with its images
  bool exact = false;           ///< `triangles` is the exact number
  /// The bytes of each image, which are part of `bytes`. Models in one file share images with equal names.
  std::map<std::string, std::uint64_t> images = {};
};

/// Returns the bytes of all images.
std::uint64_t image_bytes(const Estimate& estimate);

/// Adds images by their names. Those that it has already are not counted again.
void add_images(Estimate& estimate, const std::map<std::string, std::uint64_t>& images);

/// Adds the generated and the given images of the materials of a model, for textures of `size` texels.
void add_images_of(Estimate& estimate, const Model& model, int size);

/// Adds the bytes of another model that is in the same file, except those of images that both have. Leaves the triangles
/// as they are.
void add_bytes(Estimate& sum, const Estimate& part);

/// Counts a model that was made. Its textures are not painted yet, and it has no tangents and perhaps no texture
/// coordinates yet.
Estimate estimate_of_made(const Model& model, const Demand& demand);

}  // namespace seedmesh
