/// Edge functions after Pineda, "A parallel algorithm for polygon rasterization", 1988.
#include "core/texture/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/math.h"

namespace seedmesh::texture {
namespace {

constexpr std::int64_t one = 16;  ///< a sample in fixed-point numbers
// Coordinates are clamped to this: it is outside of every image, and products of two still fit 64 bits.
constexpr double farthest = 1 << 24;
// Surfaces deep in a crown are darker, or crowns would look flat.
constexpr double light_behind = 0.8;

std::int64_t fixed(double samples) {
  return math::to_int64(std::floor(std::clamp(samples, -farthest, farthest) * one + 0.5));
}

/// Twice the signed area of a, b and p; above 0 if p lies on the inner side of the edge.
struct Edge {
  std::int64_t ax, ay, dx, dy;
  std::int64_t least;  ///< 0 where the edge belongs to this triangle, else 1

  template <class Corner>
  Edge(const Corner& a, const Corner& b) : ax(a.x), ay(a.y), dx(b.x - a.x), dy(b.y - a.y) {
    const bool is_top = dy == 0 && dx > 0, is_left = dy < 0;
    least = is_top || is_left ? 0 : 1;
  }
  std::int64_t at(std::int64_t x, std::int64_t y) const { return dx * (y - ay) - dy * (x - ax); }
};

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
  corner.x = fixed((glm::dot(p, frame_.right) - window_.low.x) / size.x * width_);
  corner.y = fixed((window_.high.y - glm::dot(p, frame_.up)) / size.y * height_);
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
  std::int64_t area = Edge(c[0], c[1]).at(c[2].x, c[2].y);
  if (area == 0) return;
  if (area < 0) {  // seen from behind
    std::swap(c[1], c[2]);
    area = -area;
  }
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [top, bottom] = std::minmax({c[0].y, c[1].y, c[2].y});
  const std::int64_t x0 = std::max<std::int64_t>(0, left / one), y0 = std::max<std::int64_t>(0, top / one);
  const std::int64_t x1 = std::min<std::int64_t>(width_ - 1, right / one);
  const std::int64_t y1 = std::min<std::int64_t>(height_ - 1, bottom / one);
  const std::array<Edge, 3> edges = {Edge(c[1], c[2]), Edge(c[2], c[0]), Edge(c[0], c[1])};
  const double whole = 1 / static_cast<double>(area);
  std::size_t level = 0;
  if (surface.texels) {
    const glm::dvec2 size(surface.texels->width(), surface.texels->height());
    const glm::dvec2 u = (c[1].uv - c[0].uv) * size, v = (c[2].uv - c[0].uv) * size;
    level = surface.texels->level_of(std::abs(u.x * v.y - u.y * v.x) * whole * (one * one));
  }
  for (std::int64_t y = y0; y <= y1; ++y) {
    for (std::int64_t x = x0; x <= x1; ++x) {
      const std::int64_t px = x * one + one / 2, py = y * one + one / 2;
      const std::int64_t e0 = edges[0].at(px, py), e1 = edges[1].at(px, py), e2 = edges[2].at(px, py);
      if (e0 < edges[0].least || e1 < edges[1].least || e2 < edges[2].least) continue;
      const double a = static_cast<double>(e0) * whole, b = static_cast<double>(e1) * whole;
      const double d = static_cast<double>(e2) * whole;
      const std::size_t place = static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x);
      const auto depth = static_cast<float>(a * c[0].depth + b * c[1].depth + d * c[2].depth);
      if (depth <= depth_[place]) continue;
      glm::dvec3 color = glm::dvec3(glm::vec3(surface.color)) *
                         (a * c[0].color + b * c[1].color + d * c[2].color) *
                         (a * c[0].light + b * c[1].light + d * c[2].light);
      if (surface.texels) {
        const glm::dvec2 uv = a * c[0].uv + b * c[1].uv + d * c[2].uv;
        const glm::u16vec4 texel = surface.texels->at(uv, level, surface.repeat);
        if (texel.w == 0) continue;
        color *= glm::dvec3(glm::u16vec3(texel)) / 65'535.0;
      }
      depth_[place] = depth;
      samples_[place] = {{word_of(color.x), word_of(color.y), word_of(color.z)},
                         1,
                         bytes_of(a * c[0].normal + b * c[1].normal + d * c[2].normal)};
    }
  }
}

}  // namespace seedmesh::texture
