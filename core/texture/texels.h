#pragma once
/// Images for the rasteriser: linear colours with mip levels, so that distant textures are averaged.
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "core/base/array.h"
#include "core/texture/png.h"

namespace seedmesh::texture {

class Texels {
 public:
  /// Makes the levels of an image of at least 8 bits a channel, each half the size of the one before, down to
  /// one texel. Texels with alpha below `cutoff` are empty; the share of empty texels is the same at every
  /// level. Cost: about 40 ns a texel.
  Texels(const Picture& picture, float cutoff, const Job& job);

  /// Returns the level for a sample that covers this many texels.
  std::size_t level_of(double texels) const;

  /// Returns linear RGB and alpha from 0 to 65535; empty texels have alpha 0. With `repeat` the image tiles, else its
  /// edge continues.
  glm::u16vec4 at(const glm::dvec2& uv, std::size_t level, bool repeat) const;

  std::uint32_t width() const { return levels_.front().width; }
  std::uint32_t height() const { return levels_.front().height; }

  struct Level {
    std::uint32_t width = 1, height = 1;
    std::uint16_t cutoff = 0;  ///< least alpha of texels that are not empty
    Array<glm::u16vec4> texels;
    Array<std::uint8_t> filled;  ///< 0 for empty texels, else 1; without any holes, empty
  };
  const Level& level(std::size_t number) const { return levels_[number]; }
  std::size_t levels() const { return levels_.size(); }
  bool has_holes() const { return has_holes_; }  ///< some texels are empty

 private:
  std::vector<Level> levels_;
  bool has_holes_ = false;
};

}  // namespace seedmesh::texture
