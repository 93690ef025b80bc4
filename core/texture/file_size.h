#pragma once
/// Estimates of the bytes of generated textures, without making them.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/model/model.h"

namespace seedmesh::texture {

/// Whether paint() adds a normal map, so that vertices need tangents.
bool has_normals(const TextureRecipe& recipe);

/// The different textures of some materials. Recipes of one kind share the images beside the colour.
class TextureSizes {
 public:
  void add(const Material& material);

  /// Returns the bytes of each PNG file by what it shows, for textures of `size` texels; empty for size 0. Their sum is
  /// right within a quarter for sizes from 256 to 1024.
  std::map<std::string, std::uint64_t> images(int size) const;

 private:
  std::set<std::pair<std::string, std::uint32_t>> colors_;  ///< kind and colour
  std::map<std::string, bool> has_normals_;                 ///< whether each kind has normals
};

}  // namespace seedmesh::texture
