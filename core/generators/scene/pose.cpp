#include <cmath>

#include "core/base/math.h"
#include "core/generators/scene/place_layers.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

constexpr std::uint64_t draw_lean = 5;

glm::dquat turn_about(const glm::dvec3& axis, double angle) {
  const math::SinCos half = math::sincos(angle / 2);
  return {half.cos, axis.x * half.sin, axis.y * half.sin, axis.z * half.sin};
}

}  // namespace

Transform transform_of(const Placement& placement, const SceneLayer& layer, const Ground& ground) {
  Transform transform;
  const double scale = static_cast<double>(placement.scale);
  transform.translation =
      glm::vec3(glm::dvec3(placement.at.x, ground.height(placement.at) - layer.sink, placement.at.y));
  transform.scale = glm::vec3(static_cast<float>(scale));
  glm::dquat rotation = turn_about({0, 1, 0}, static_cast<double>(placement.turn));
  if (layer.tilt > 0) {
    Rng rng(key_at(placement.key, draw_lean));
    const math::SinCos direction = math::sincos(rng.uniform(0, 2 * math::pi));
    rotation =
        turn_about({direction.cos, 0, direction.sin}, math::radians(layer.tilt * rng.unit())) * rotation;
  }
  if (layer.upright < 1) {
    const glm::dvec2 rise = ground.gradient(placement.at);
    const double steep = math::atan2(glm::length(rise), 1) * (1 - layer.upright);
    // The axis is horizontal along the contour line, so that up tilts downhill.
    const glm::dvec2 downhill = glm::length(rise) > 0 ? -rise / glm::length(rise) : glm::dvec2(0);
    rotation = turn_about({downhill.y, 0, -downhill.x}, steep) * rotation;
  }
  const double length = std::sqrt(glm::dot(rotation, rotation));
  transform.rotation = {static_cast<float>(rotation.w / length), static_cast<float>(rotation.x / length),
                        static_cast<float>(rotation.y / length), static_cast<float>(rotation.z / length)};
  return transform;
}

}  // namespace seedmesh::scene
