#pragma once
/// Triangles drawn from one side: a rasteriser of parallel light, for pictures that stand for models. Places
/// are fixed-point numbers and edges belong to one of two neighbours, so that the same triangles give the
/// same picture everywhere; of what is nearest to the viewer, the first drawn stays.
#include <glm/glm.hpp>

#include "core/base/array.h"
#include "core/model/mesh.h"
#include "core/texture/texels.h"

namespace seedmesh::texture {

/// The plane of a picture: x to the right, y up, and towards the viewer; each of length 1 and square to the
/// others.
struct ViewFrame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};
};

/// The part of the plane that a picture shows, in metres.
struct ViewWindow {
  glm::dvec2 low{0}, high{0};
};

/// How the surface of a mesh looks.
struct Surface {
  glm::vec4 color{1};              ///< linear; multiplies the texels
  const Texels* texels = nullptr;  ///< null: none
  bool repeat = true;
};

/// Samples, each the nearest of what covers its middle.
class Canvas {
 public:
  Canvas(const ViewFrame& frame, const ViewWindow& window, std::uint32_t width, std::uint32_t height,
         const Job& job);

  /// Triangles alone. About 60 ns each and 10 ns a sample that one covers.
  void draw(const Mesh& mesh, const glm::mat4& at, const Surface& surface, const Job& job);

  struct Sample {
    glm::u16vec3 color{0};         ///< linear
    std::uint16_t is_covered = 0;  ///< 0 or 1
    glm::i8vec4 normal{0};         ///< 127 is 1; right, up, towards the viewer: the side that is seen
  };
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Row 0 is at the top.
  const Sample& at(std::uint32_t x, std::uint32_t y) const { return samples_[std::size_t{y} * width_ + x]; }

 private:
  /// A corner as the picture sees it.
  struct Corner {
    std::int64_t x = 0, y = 0;  ///< in 16ths of a sample, y down
    double depth = 0;           ///< greater is nearer
    double light = 1;
    glm::dvec3 normal{0, 0, 1};  ///< right, up, towards the viewer
    glm::dvec2 uv{0};
    glm::dvec3 color{1};
  };
  Corner corner_of(const Mesh& mesh, std::uint32_t vertex, const glm::mat4& at) const;
  void draw(std::array<Corner, 3> corners, const Surface& surface);

  ViewFrame frame_;
  ViewWindow window_;
  std::uint32_t width_, height_;
  Array<Sample> samples_;
  Array<float> depth_;
};

}  // namespace seedmesh::texture
