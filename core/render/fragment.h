#pragma once
/// The colour and normal of a triangle at a position of the image. For core/render only.
#include <array>
#include <cmath>

#include "core/render/scene.h"

namespace seedmesh::render {

struct Fragment {
  float near = 0;      ///< 1 / distance along the axis of the camera
  glm::vec3 color{0};  ///< linear RGB
  float alpha = 1;     ///< 0: a hole of a cut-out texture
  glm::vec3 normal{
      0};  ///< unit normal of the visible side, in the frame of the model; 0 for lines and points
  std::uint32_t surface = 0;  ///< index into Surfaces
};

/// Reads fragments of a scene, one thread at a time. Neighbours of one triangle are cheaper.
class FragmentReader {
 public:
  explicit FragmentReader(const ProjectedScene& shown) : shown_(shown) {}

  /// `number` is that of the triangle in its drawing, or of the vertex where lines or points are drawn. The
  /// position is in fixed-point numbers and inside the triangle. Textures are averaged over `samples`
  /// samples. Cost: about 40 ns.
  Fragment at(std::uint32_t drawing, std::uint32_t number, float x, float y, float samples = 1);

 private:
  void take_drawing(std::uint32_t drawing);
  void take_triangle(std::uint32_t number);
  Fragment thin(std::uint32_t vertex) const;

  const ProjectedScene& shown_;
  std::uint32_t drawing_ = ~0U, number_ = ~0U;
  const Drawing* of_ = nullptr;
  const Surface* surface_ = nullptr;
  const Array<glm::vec2>* uv_ = nullptr;
  Lens lens_;
  glm::mat3 turn_{1};
  bool mirrored_ = false;
  // Values of the current triangle:
  std::array<Projected, 3> corner_;
  std::array<glm::vec3, 3> normal_;
  std::array<glm::vec3, 3> color_;
  std::array<glm::vec2, 3> at_;  ///< texture coordinates
  double texels_ = 0;            ///< number of texels that a sample covers
  double per_area_ = 0;
};

/// Returns the number of texels that a sample covers in a triangle with these texture coordinates. `per_area` is the
/// reciprocal of the doubled area of the triangle in fixed-point units.
inline double texels_of_sample(const texture::Texels& texels, const std::array<glm::vec2, 3>& at,
                               double per_area) {
  const glm::vec2 u = at[1] - at[0], v = at[2] - at[0];
  const auto share = static_cast<double>(u.x * v.y - u.y * v.x);
  return std::abs(share * per_area) * (static_cast<double>(texels.width()) * texels.height()) *
         (fixed_one * fixed_one);
}

}  // namespace seedmesh::render
