#include "core/render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/math.h"

namespace seedmesh::render {
namespace {

constexpr double half_width = 0.21;  ///< at distance 1: an angle of 24 degrees
constexpr double margin = 1.06;
constexpr std::size_t most_points = 200'000;  ///< beyond, boxes stand for their meshes

/// Points whose hull holds the model.
std::vector<glm::dvec3> outline_of(const Model& model, const Items& items) {
  std::size_t vertices = 0;
  for (const Item& item : items.list) {
    for (const Primitive& primitive : model.meshes[item.group].primitives)
      vertices += primitive.mesh.position.size();
  }
  std::vector<Box> boxes;
  for (const MeshGroup& group : model.meshes) boxes.push_back(box_of(group));
  std::vector<glm::dvec3> points;
  for (const Item& item : items.list) {
    if (vertices > most_points) {
      for (int corner = 0; corner < 8; ++corner)
        points.emplace_back(glm::vec3(item.at * glm::vec4(corner_of(boxes[item.group], corner), 1)));
      continue;
    }
    for (const Primitive& primitive : model.meshes[item.group].primitives) {
      for (const glm::vec3& p : primitive.mesh.position)
        points.emplace_back(glm::vec3(item.at * glm::vec4(p, 1)));
    }
  }
  return points;
}

}  // namespace

Frame frame_of(const View& view) {
  const math::SinCos turn = math::sincos_degrees(view.azimuth), rise = math::sincos_degrees(view.elevation);
  Frame frame;
  frame.towards = {rise.cos * turn.sin, rise.sin, rise.cos * turn.cos};
  frame.right = {turn.cos, 0, -turn.sin};
  frame.up = glm::cross(frame.towards, frame.right);
  return frame;
}

Seen seen(const Camera& camera, const glm::dvec3& position) {
  const glm::dvec3 from = position - camera.eye;
  const double distance = -glm::dot(from, camera.frame.towards);
  const double near = 1 / std::max(distance, 1e-9);
  return {glm::dot(from, camera.frame.right) * near / camera.half,
          glm::dot(from, camera.frame.up) * near / camera.half, near};
}

Camera camera_for(const Model& model, const Items& items, const View& view) {
  Camera camera;
  camera.frame = frame_of(view);
  camera.half = half_width;
  const Frame& frame = camera.frame;
  // The four sides of the pyramid of view touch the model: each side gives the least x - half * z of all points, and
  // two opposite sides meet at the eye. Positions are relative to the middle.
  const glm::dvec3 middle(0.5F * (items.box.min + items.box.max));
  const double slope = half_width / margin;
  constexpr double far = std::numeric_limits<double>::lowest();
  double right = far, left = far, above = far, below = far, front = far;
  for (const glm::dvec3& p : outline_of(model, items)) {
    const glm::dvec3 at = p - middle;
    const double x = glm::dot(at, frame.right), y = glm::dot(at, frame.up), z = glm::dot(at, frame.towards);
    right = std::max(right, x + slope * z);
    left = std::max(left, -x + slope * z);
    above = std::max(above, y + slope * z);
    below = std::max(below, -y + slope * z);
    front = std::max(front, z);
  }
  if (items.list.empty()) right = left = above = below = front = 1;
  const double across = (right - left) / 2, high = (above - below) / 2;
  const double back =
      std::max({(right + left) / (2 * slope), (above + below) / (2 * slope), front * 1.001 + 1e-3});
  camera.eye = middle + frame.right * across + frame.up * high + frame.towards * back;
  return camera;
}

}  // namespace seedmesh::render
