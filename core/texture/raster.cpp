#include "core/texture/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/math.h"

namespace seedmesh::texture {
namespace {

// Surfaces deep in a crown are darker, or crowns would look flat.
constexpr double light_behind = 0.8;

std::uint16_t word_of(double share) {
  return static_cast<std::uint16_t>(std::clamp(share, 0.0, 1.0) * 65'535 + 0.5);
}

glm::i8vec4 bytes_of(const glm::dvec3& direction) {
  const glm::dvec3 normal = math::unit(direction, glm::dvec3(0, 0, 1));
  glm::i8vec4 bytes(0);
  for (int axis = 0; axis < 3; ++axis)
    bytes[axis] = static_cast<std::int8_t>(std::floor(std::clamp(normal[axis], -1.0, 1.0) * 127 + 0.5));
  return bytes;
}

}  // namespace

Canvas::Canvas(const ViewFrame& frame, const ViewWindow& window, std::uint32_t width, std::uint32_t height,
               const Job& job)
    : frame_(frame),
      window_(window),
      width_(width),
      height_(height),
      samples_(job, std::size_t{width} * height, Sample{}),
      depth_(job, std::size_t{width} * height, -std::numeric_limits<float>::max()) {}

Canvas::Corner Canvas::corner_of(const Mesh& mesh, std::uint32_t vertex, const glm::mat4& at) const {
  const glm::dvec3 p(glm::vec3(at * glm::vec4(mesh.position[vertex], 1)));
  const glm::dvec2 size = window_.high - window_.low;
  Corner corner;
  corner.point.x = fixed((glm::dot(p, frame_.right) - window_.low.x) / size.x * width_);
  corner.point.y = fixed((window_.high.y - glm::dot(p, frame_.up)) / size.y * height_);
  corner.depth = glm::dot(p, frame_.towards);
  const double near = std::clamp(corner.depth / size.x + 0.5, 0.0, 1.0);
  corner.light = light_behind + (1 - light_behind) * near;
  if (!mesh.normal.empty()) {
    const glm::dvec3 normal =
        math::unit(glm::dvec3(glm::mat3(at) * mesh.normal[vertex]), glm::dvec3(frame_.towards));
    const double facing = glm::dot(normal, frame_.towards) < 0 ? -1 : 1;
    corner.normal = facing * glm::dvec3(glm::dot(normal, frame_.right), glm::dot(normal, frame_.up),
                                        glm::dot(normal, frame_.towards));
  }
  if (!mesh.uv[0].empty()) corner.uv = glm::dvec2(mesh.uv[0][vertex]);
  if (!mesh.color.empty()) corner.color = glm::dvec3(glm::u8vec3(mesh.color[vertex])) / 255.0;
  return corner;
}

void Canvas::draw(const Mesh& mesh, const glm::mat4& at, const Surface& surface, const Job& job) {
  if (mesh.topology != Topology::triangles) return;
  for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
    if (i % 12'288 == 0) job.check();
    draw({corner_of(mesh, mesh.index.at(i), at), corner_of(mesh, mesh.index.at(i + 1), at),
          corner_of(mesh, mesh.index.at(i + 2), at)},
         surface);
  }
}

void Canvas::draw(std::array<Corner, 3> c, const Surface& surface) {
  std::array<ScanPoint, 3> points = {c[0].point, c[1].point, c[2].point};
  std::int64_t area = scan_area(points);
  if (area == 0) return;
  if (area < 0) {  // seen from behind
    std::swap(c[1], c[2]);
    std::swap(points[1], points[2]);
    area = -area;
  }
  std::size_t level = 0;
  if (surface.texels) {
    const glm::dvec2 size(surface.texels->width(), surface.texels->height());
    const glm::dvec2 u = (c[1].uv - c[0].uv) * size, v = (c[2].uv - c[0].uv) * size;
    level = surface.texels->level_of(std::abs(u.x * v.y - u.y * v.x) * (1 / static_cast<double>(area)) *
                                     (fixed_one * fixed_one));
  }
  const auto put = [&](std::int64_t x, std::int64_t y, double a, double b, double d) {
    const std::size_t place = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
    const auto depth = static_cast<float>(a * c[0].depth + b * c[1].depth + d * c[2].depth);
    if (depth <= depth_[place]) return;
    glm::dvec3 color = glm::dvec3(glm::vec3(surface.color)) *
                       (a * c[0].color + b * c[1].color + d * c[2].color) *
                       (a * c[0].light + b * c[1].light + d * c[2].light);
    if (surface.texels) {
      const glm::dvec2 uv = a * c[0].uv + b * c[1].uv + d * c[2].uv;
      const glm::u16vec4 texel = surface.texels->at(uv, level, surface.repeat);
      if (texel.w == 0) return;
      color *= glm::dvec3(glm::u16vec3(texel)) / 65'535.0;
    }
    depth_[place] = depth;
    samples_[place] = {{word_of(color.x), word_of(color.y), word_of(color.z)},
                       1,
                       bytes_of(a * c[0].normal + b * c[1].normal + d * c[2].normal)};
  };
  scan(points, area, {0, 0, width_, height_}, put);
}

}  // namespace seedmesh::texture
