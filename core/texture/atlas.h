#pragma once
/// An atlas: several images in one texture, cut out by alpha.
#include <memory>
#include <string>

#include "core/model/model.h"
#include "core/texture/raster.h"

namespace seedmesh::texture {

class Atlas {
 public:
  /// Texels with less alpha are empty.
  static constexpr float cutoff = 0.5F;

  /// Makes an empty atlas of size x size texels, whose memory is charged to the job.
  Atlas(std::uint32_t size, const Job& job);

  std::uint32_t size() const { return size_; }

  struct Cell {
    std::uint32_t size;     ///< texels along a side
    std::uint32_t edge;     ///< empty texels around the image
    std::uint32_t samples;  ///< number of samples of a texel along each axis
  };
  /// Writes the samples of the canvas as texels of the cell that begins at `corner`. The image covers as many
  /// texels as the samples do. Colours continue beyond the outline, so that no mip level has a rim. Threads
  /// may write different cells at the same time.
  void put(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell);

  /// The same for the mean normals of the samples, in the tangent space of glTF.
  void put_normals(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell);

  /// PNG files: colours as RGBA in sRGB, normals as RGB.
  std::shared_ptr<const Image> image(const std::string& name, const Job& job) const;
  std::shared_ptr<const Image> normal_image(const std::string& name, const Job& job) const;

 private:
  void spread(const glm::uvec2& corner, std::uint32_t side);
  glm::u8vec4& at(std::uint32_t x, std::uint32_t y) { return texels_[std::size_t{y} * size_ + x]; }

  std::uint32_t size_;
  Array<glm::u8vec4> texels_;
};

}  // namespace seedmesh::texture
