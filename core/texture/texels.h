#pragma once
/// Pictures as a rasteriser reads them: linear colours at several sizes, so that a texture seen from afar is
/// its mean and not a texel by chance.
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "core/base/array.h"
#include "core/texture/png.h"

namespace seedmesh::texture {

class Texels {
 public:
  /// Of a picture of 8 bits or more a channel. Each size is half the one before, down to one texel. Below
  /// `cutoff` nothing is there: how much of the picture that is stays the same at every size. About 40 ns a
  /// texel.
  Texels(const Picture& picture, float cutoff, const Job& job);

  /// The size for one sample that covers so many texels.
  std::size_t level_of(double texels) const;

  /// Linear RGB, 0..65535, and alpha: 0 where nothing is there. `repeat`: outside of 0..1 the picture goes
  /// on, else its edge does.
  glm::u16vec4 at(const glm::dvec2& uv, std::size_t level, bool repeat) const;

  std::uint32_t width() const { return levels_.front().width; }
  std::uint32_t height() const { return levels_.front().height; }

 private:
  struct Level {
    std::uint32_t width = 1, height = 1;
    std::uint16_t cutoff = 0;  ///< least alpha of what is there
    Array<glm::u16vec4> texels;
  };
  std::vector<Level> levels_;
};

}  // namespace seedmesh::texture
