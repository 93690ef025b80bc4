#pragma once
/// Pictures side by side, cut out by alpha, as a texture.
#include <memory>
#include <string>

#include "core/model/model.h"
#include "core/texture/raster.h"

namespace seedmesh::texture {

class Atlas {
 public:
  /// What has less alpha is not there.
  static constexpr float cutoff = 0.5F;

  Atlas(std::uint32_t size, const Job& job);

  std::uint32_t size() const { return size_; }

  struct Cell {
    std::uint32_t size;     ///< texels of a side
    std::uint32_t edge;     ///< texels around the picture that stay empty
    std::uint32_t samples;  ///< of a texel, each way
  };
  /// The samples of the canvas as texels of the cell that begins there. So much of the picture is there as of
  /// the samples; colours go on beyond the edges, so that no size of the texture has a rim. Different cells
  /// at once are safe.
  void put(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell);

  /// The same for the mean normals of the samples, in the space of the picture as glTF has them.
  void put_normals(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell);

  /// PNG files: of colours, RGBA in sRGB; of normals, RGB.
  std::shared_ptr<const Image> image(const std::string& name, const Job& job) const;
  std::shared_ptr<const Image> normal_image(const std::string& name, const Job& job) const;

 private:
  void spread(const glm::uvec2& corner, std::uint32_t side);
  glm::u8vec4& at(std::uint32_t x, std::uint32_t y) { return texels_[std::size_t{y} * size_ + x]; }

  std::uint32_t size_;
  Array<glm::u8vec4> texels_;
};

}  // namespace seedmesh::texture
