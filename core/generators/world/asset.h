#pragma once
/// A model of another generator in a file that tiles share: parts of glTF whose indices begin at 0, and their bytes.
#include <array>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/job.h"
#include "core/schema/child.h"
#include "core/schema/json.h"

namespace seedmesh::world {

struct Asset {
  std::string hash;  ///< 16 hexadecimal digits of the content
  std::string file;  ///< the content: vertices, indices and images
  /// {accessors, bufferViews, meshes, materials, textures, images, samplers} of glTF; its one buffer is the file.
  Json parts;
  std::array<double, 3> low{}, high{};  ///< corners of the box around all vertices; +Y up
  std::uint64_t triangles = 0;
  std::uint64_t size = 0;  ///< size of all of it in memory
  std::uint64_t bytes() const { return size; }
};

/// near is a simplified mesh, far is an impostor.
enum class AssetForm { near, far };

/// Makes the model of the request at `pointer`. Its seed is that of the request, or else `seed`. Throws Stop if the
/// model cannot be made.
using MakeAsset = std::function<Asset(const Child& model, AssetForm form, std::uint64_t seed,
                                      const std::string& pointer, Job& job)>;

/// Returns the hash of a file, which is part of its name.
std::string hash_of(const std::string& bytes);

}  // namespace seedmesh::world
