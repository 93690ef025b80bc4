#include "core/render/eye.h"

namespace seedmesh::render {

Eye::Eye(const Camera& camera, std::uint32_t size) : is_perspective_(true), size_(size) {
  const double scale = 0.5 * size / camera.half;
  const auto row = [&camera](const glm::dvec3& axis) {
    return glm::dvec4(axis, -glm::dot(axis, camera.eye));
  };
  right_ = row(camera.frame.right) * scale;
  down_ = row(camera.frame.up) * -scale;
  towards_ = -row(camera.frame.towards);
}

Eye::Eye(const Frame& frame, const glm::dvec2& low, double step, std::uint32_t size)
    : right_(frame.right / step, -low.x / step),
      down_(frame.up / step, -low.y / step),
      towards_(frame.towards, 0),
      is_perspective_(false),
      size_(size) {}

Lens Eye::lens_at(const glm::mat4& at) const {
  const glm::dmat4 whole(at);
  const auto row = [&whole](const glm::dvec4& form) {
    glm::dvec4 out(0);
    for (int column = 0; column < 4; ++column) out[column] = glm::dot(form, whole[column]);
    return glm::vec4(out);
  };
  return {row(right_), row(down_), row(towards_), glm::vec2(0.5F * static_cast<float>(size_)),
          is_perspective_};
}

}  // namespace seedmesh::render
