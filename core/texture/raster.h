#pragma once
/// A rasteriser with parallel projection, for images of models. Coordinates are fixed-point numbers, and an edge
/// belongs to one of its two triangles. The same triangles therefore give the same image on every machine. At equal
/// depth the first triangle wins.
#include <glm/glm.hpp>

#include "core/base/array.h"
#include "core/model/mesh.h"
#include "core/texture/scan.h"
#include "core/texture/texels.h"

namespace seedmesh::texture {

/// The axes of an image: right, up, and towards the viewer. They are orthonormal.
struct ViewFrame {
  glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, towards{0, 0, 1};
};

/// The part of the plane that an image covers, in metres.
struct ViewWindow {
  glm::dvec2 low{0}, high{0};
};

/// The appearance of the surface of a mesh.
struct Surface {
  glm::vec4 color{1};              ///< linear; multiplies the texels
  const Texels* texels = nullptr;  ///< null: none
  bool repeat = true;
};

/// An image of samples. Each has the nearest surface at its centre.
class Canvas {
 public:
  Canvas(const ViewFrame& frame, const ViewWindow& window, std::uint32_t width, std::uint32_t height,
         const Job& job);

  /// Draws the triangles of a mesh. Cost: about 60 ns a triangle and 10 ns a covered sample.
  void draw(const Mesh& mesh, const glm::mat4& at, const Surface& surface, const Job& job);

  struct Sample {
    glm::u16vec3 color{0};         ///< linear
    std::uint16_t is_covered = 0;  ///< 0 or 1
    /// Normal of the visible side: right, up, towards the viewer, as signed 8-bit shares.
    glm::i8vec4 normal{0};
  };
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  /// Row 0 is at the top.
  const Sample& at(std::uint32_t x, std::uint32_t y) const { return samples_[std::size_t{y} * width_ + x]; }

 private:
  /// A projected vertex.
  struct Corner {
    ScanPoint point;
    double depth = 0;  ///< greater is nearer
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
