#include "core/render/camera.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/base/math.h"

namespace seedmesh::render {
namespace {

constexpr double half_width = 0.21;  ///< at distance 1: an angle of 24 degrees
constexpr double margin = 1.06;
constexpr std::size_t most_vertices = 2'000'000;  ///< beyond, boxes replace their meshes

/// How far the positions of all items reach along directions in space: the greatest dot products.
template <std::size_t n>
std::array<float, n> reach_of(const Model& model, const Items& items,
                              const std::array<glm::vec3, n>& directions) {
  std::size_t vertices = 0;
  for (const Item& item : items.list) {
    for (const Primitive& primitive : model.meshes[item.group].primitives)
      vertices += primitive.mesh.position.size();
  }
  std::array<float, n> reach;
  reach.fill(std::numeric_limits<float>::lowest());
  for (const Item& item : items.list) {
    // Directions in the frame of the mesh.
    std::array<glm::vec4, n> forms;
    for (std::size_t i = 0; i < n; ++i) {
      for (int column = 0; column < 4; ++column)
        forms[i][column] = glm::dot(directions[i], glm::vec3(item.at[column]));
    }
    const auto widen = [&](const glm::vec3& p) {
      for (std::size_t i = 0; i < n; ++i) {
        const float along = (forms[i].x * p.x + forms[i].y * p.y) + (forms[i].z * p.z + forms[i].w);
        reach[i] = std::max(reach[i], along);
      }
    };
    if (vertices > most_vertices) {
      for (int corner = 0; corner < 8; ++corner) widen(corner_of(items.boxes[item.group], corner));
      continue;
    }
    for (const Primitive& primitive : model.meshes[item.group].primitives) {
      for (const glm::vec3& p : primitive.mesh.position) widen(p);
    }
  }
  return reach;
}

}  // namespace

double elevation_of(const View& view, const Box& box) {
  if (view.elevation) return *view.elevation;
  constexpr double usual = 18, highest = 38;  // degrees
  constexpr double flat = 0.1, tall = 0.4;    // height by width
  const glm::dvec3 size(box.max - box.min);
  const double width = std::max(size.x, size.z);
  if (!(width > 0)) return usual;
  const double share = std::clamp((tall - size.y / width) / (tall - flat), 0.0, 1.0);
  return usual + (highest - usual) * share;
}

Frame frame_of(double azimuth, double elevation) {
  const math::SinCos turn = math::sincos_degrees(azimuth), rise = math::sincos_degrees(elevation);
  Frame frame;
  frame.towards = {rise.cos * turn.sin, rise.sin, rise.cos * turn.cos};
  frame.right = {turn.cos, 0, -turn.sin};
  frame.up = glm::cross(frame.towards, frame.right);
  return frame;
}

Camera camera_for(const Model& model, const Items& items, const Frame& frame, const glm::dvec2& share) {
  Camera camera;
  camera.frame = frame;
  camera.half = half_width;
  // The four sides of the pyramid of view touch the model: each side gives the least x - half * z of all points, and
  // two opposite sides meet at the eye. Positions are relative to the middle.
  const glm::dvec3 middle(0.5F * (items.box.min + items.box.max));
  const glm::dvec2 slope = share * (half_width / margin);
  const std::array<glm::dvec3, 5> sides = {
      frame.right + slope.x * frame.towards, slope.x * frame.towards - frame.right,
      frame.up + slope.y * frame.towards, slope.y * frame.towards - frame.up, frame.towards};
  std::array<glm::vec3, 5> directions;
  for (std::size_t i = 0; i < sides.size(); ++i) directions[i] = glm::vec3(sides[i]);
  const std::array<float, 5> reach = reach_of(model, items, directions);
  std::array<double, 5> from_middle;
  for (std::size_t i = 0; i < sides.size(); ++i)
    from_middle[i] = items.list.empty() ? 1 : static_cast<double>(reach[i]) - glm::dot(sides[i], middle);
  const auto [right, left, above, below, front] = from_middle;
  const double across = (right - left) / 2, high = (above - below) / 2;
  const double back =
      std::max({(right + left) / (2 * slope.x), (above + below) / (2 * slope.y), front * 1.001 + 1e-3});
  camera.eye = middle + frame.right * across + frame.up * high + frame.towards * back;
  return camera;
}

}  // namespace seedmesh::render
