#pragma once
/// Estimates of the bytes of generated textures, without making them.
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/model/model.h"

namespace seedmesh::texture {

/// The different textures of some materials. Recipes of one kind share the images beside the colour.
class TextureSizes {
 public:
  void add(const Material& material);

  /// Returns the bytes of all PNG files for textures of `size` texels, within a quarter for sizes from 256 to 1024.
  std::uint64_t bytes(int size) const;

 private:
  std::set<std::pair<std::string, std::uint32_t>> colors_;  ///< kind and colour
  std::map<std::string, bool> has_normals_;                 ///< whether each kind has normals
};

}  // namespace seedmesh::texture
