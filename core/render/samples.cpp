#include "core/render/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/render/eye.h"

namespace seedmesh::render {
namespace {

using texture::fixed_one;
using texture::scan;
using texture::scan_area;
using texture::ScanPoint;
using texture::ScanWindow;

constexpr std::uint32_t bands = 8;
constexpr std::size_t check_every = 8'192;  ///< triangles
constexpr float darkest = std::numeric_limits<float>::lowest();

/// A triangle on its way to the samples.
struct Triangle {
  std::array<std::uint32_t, 3> vertex;
  std::array<ScanPoint, 3> point;
  std::array<double, 3> depth;
  std::int64_t area = 0;
  bool from_behind = false;
};

/// Calls visit(triangle) for each triangle of a mesh that faces the eye or has both sides, with its corners in the
/// order of scan().
template <class Visit>
void each_triangle(const Mesh& mesh, const Array<Projected>& seen, const ScanWindow& rows, bool mirrored,
                   bool both_sides, const Job& job, const Visit& visit) {
  for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
    if (i % (3 * check_every) == 0) job.check();
    Triangle t;
    for (std::size_t c = 0; c < 3; ++c) {
      t.vertex[c] = mesh.index.at(i + c);
      t.point[c] = seen[t.vertex[c]].point;
      t.depth[c] = seen[t.vertex[c]].depth;
    }
    const auto [top, bottom] = std::minmax({t.point[0].y, t.point[1].y, t.point[2].y});
    if (bottom < rows.y0 * fixed_one || top >= rows.y1 * fixed_one) continue;
    t.area = scan_area(t.point);
    t.from_behind = (t.area > 0) != mirrored;  // rows run downwards
    if (t.area == 0 || (t.from_behind && !both_sides)) continue;
    if (t.area < 0) {
      std::swap(t.vertex[1], t.vertex[2]);
      std::swap(t.point[1], t.point[2]);
      std::swap(t.depth[1], t.depth[2]);
      t.area = -t.area;
    }
    visit(t);
  }
}

/// The level of a texture for a triangle.
std::size_t level_of(const texture::Texels& texels, const Array<glm::vec2>& uv, const Triangle& t) {
  const glm::dvec2 size(texels.width(), texels.height());
  const glm::dvec2 a(uv[t.vertex[0]]), u = (glm::dvec2(uv[t.vertex[1]]) - a) * size,
                                       v = (glm::dvec2(uv[t.vertex[2]]) - a) * size;
  return texels.level_of(std::abs(u.x * v.y - u.y * v.x) / static_cast<double>(t.area) *
                         (fixed_one * fixed_one));
}

const Array<glm::vec2>* uv_of(const Mesh& mesh, const Surface& surface) {
  if (!surface.texels || static_cast<std::size_t>(surface.uv_set) >= mesh.uv.size()) return nullptr;
  const Array<glm::vec2>& uv = mesh.uv[static_cast<std::size_t>(surface.uv_set)];
  return uv.empty() ? nullptr : &uv;
}

/// The weights of the corners in the plane of the triangle. `depth` is 1 / distance for a camera.
struct Weights {
  double a, b, c;
};

double near_of(const Triangle& t, double a, double b, double c) {
  return a * t.depth[0] + b * t.depth[1] + c * t.depth[2];
}

Weights in_space(const Triangle& t, double a, double b, double c, double near) {
  const double distance = 1 / near;
  return {a * t.depth[0] * distance, b * t.depth[1] * distance, c * t.depth[2] * distance};
}

std::uint16_t word_of(double share) {
  return static_cast<std::uint16_t>(std::clamp(share, 0.0, 1.0) * 65'535 + 0.5);
}

glm::i8vec4 bytes_of(const glm::dvec3& direction) {
  const glm::dvec3 normal = math::unit(direction, glm::dvec3(0, 1, 0));
  glm::i8vec4 bytes(0);
  for (int axis = 0; axis < 3; ++axis)
    bytes[axis] = static_cast<std::int8_t>(std::floor(std::clamp(normal[axis], -1.0, 1.0) * 127 + 0.5));
  return bytes;
}

/// Draws into the rows of one band.
class Band {
 public:
  Band(const Scene& scene, const Eye& eye, const ScanWindow& rows, const Job& job)
      : scene_(scene), eye_(eye), rows_(rows), job_(job), own_(job) {}

  /// Calls draw(primitive, item, number of its surface) for each primitive in the rows, with its vertices in seen().
  template <class Draw>
  void each_primitive(bool blending, const Draw& draw) {
    std::size_t first = 0;  // of the item, into Scene::seen
    for (const Item& item : scene_.items.list) {
      const std::vector<Primitive>& primitives = scene_.model.meshes[item.group].primitives;
      const std::size_t begin = std::exchange(first, first + primitives.size());
      if (!touches(scene_, item, eye_, rows_)) continue;
      for (std::size_t i = 0; i < primitives.size(); ++i) {
        const std::size_t surface = scene_.surfaces.number_of(primitives[i]);
        if (scene_.surfaces[surface].blends != blending) continue;
        seen_ = scene_.seen.empty() ? project_here(item, primitives[i].mesh) : &scene_.seen[begin + i];
        draw(primitives[i].mesh, item, surface);
      }
    }
  }

  void draw_samples(Samples& samples) {
    for (const bool blending : {false, true}) {
      each_primitive(blending, [&](const Mesh& mesh, const Item& item, std::size_t surface) {
        if (mesh.topology == Topology::triangles) return draw_mesh(mesh, item, surface, samples);
        draw_thin(mesh, surface, samples);
      });
    }
  }

  void draw_depth(ShadowMap& map) {
    each_primitive(false, [&](const Mesh& mesh, const Item&, std::size_t number) {
      if (mesh.topology != Topology::triangles) return;
      const Surface& surface = scene_.surfaces[number];
      const Array<glm::vec2>* uv = uv_of(mesh, surface);
      each_triangle(mesh, *seen_, rows_, true, true, job_, [&](const Triangle& t) {
        const std::size_t level = uv ? level_of(*surface.texels, *uv, t) : 0;
        scan(t.point, t.area, rows_, [&](std::int64_t x, std::int64_t y, double a, double b, double c) {
          float& held = map.depth[static_cast<std::size_t>(y) * map.size + static_cast<std::size_t>(x)];
          const auto depth = static_cast<float>(a * t.depth[0] + b * t.depth[1] + c * t.depth[2]);
          if (depth <= held) return;
          if (uv) {
            const glm::dvec2 at = a * glm::dvec2((*uv)[t.vertex[0]]) + b * glm::dvec2((*uv)[t.vertex[1]]) +
                                  c * glm::dvec2((*uv)[t.vertex[2]]);
            if (surface.texels->at(at, level, surface.repeat).w == 0) return;
          }
          held = depth;
        });
      });
    });
  }

 private:
  const Array<Projected>* project_here(const Item& item, const Mesh& mesh) {
    own_.resize(mesh.position.size());
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (i % check_every == 0) job_.check();
      own_[i] = projected(eye_, item, mesh, i);
    }
    return &own_;
  }

  void draw_mesh(const Mesh& mesh, const Item& item, std::size_t number, Samples& samples) {
    const Surface& surface = scene_.surfaces[number];
    const Array<glm::vec2>* uv = uv_of(mesh, surface);
    // Of a transform that stretches along its axes, normals shrink there.
    glm::dmat3 turn(glm::mat3(item.at));
    for (int axis = 0; axis < 3; ++axis) turn[axis] /= std::max(glm::dot(turn[axis], turn[axis]), 1e-30);
    const bool mirrored = glm::determinant(turn) < 0;
    each_triangle(
        mesh, *seen_, rows_, mirrored, surface.both_sides || surface.blends, job_, [&](const Triangle& t) {
          const double side = t.from_behind ? -1 : 1;
          const std::size_t level = uv ? level_of(*surface.texels, *uv, t) : 0;
          scan(t.point, t.area, rows_, [&](std::int64_t x, std::int64_t y, double a, double b, double c) {
            Sample& held =
                samples.of[static_cast<std::size_t>(y) * samples.size + static_cast<std::size_t>(x)];
            const double depth = near_of(t, a, b, c);
            const auto near = static_cast<float>(depth);
            if (near <= held.near) return;
            const Weights w = in_space(t, a, b, c, depth);
            const auto mixed = [&](const auto& values) {
              return w.a * glm::dvec3(values[t.vertex[0]]) + w.b * glm::dvec3(values[t.vertex[1]]) +
                     w.c * glm::dvec3(values[t.vertex[2]]);
            };
            glm::dvec3 color(surface.color);
            double alpha = static_cast<double>(surface.alpha);
            if (uv) {
              const glm::dvec2 at = w.a * glm::dvec2((*uv)[t.vertex[0]]) +
                                    w.b * glm::dvec2((*uv)[t.vertex[1]]) +
                                    w.c * glm::dvec2((*uv)[t.vertex[2]]);
              const glm::u16vec4 texel = surface.texels->at(at, level, surface.repeat);
              if (texel.w == 0) return;
              color *= glm::dvec3(glm::u16vec3(texel)) / 65'535.0;
              alpha *= texel.w / 65'535.0;
            }
            if (!mesh.color.empty()) color *= mixed(mesh.color) / 255.0;
            const glm::dvec3 normal =
                mesh.normal.empty() ? glm::dvec3(0) : turn * (side * mixed(mesh.normal));
            put(held, surface,
                {near,
                 {word_of(color.x), word_of(color.y), word_of(color.z)},
                 static_cast<std::uint16_t>(number),
                 mesh.normal.empty() ? glm::i8vec4(0) : bytes_of(normal)},
                alpha);
          });
        });
  }

  /// Sheets that blend leave the depth of what is behind them.
  static void put(Sample& held, const Surface& surface, const Sample& next, double alpha) {
    if (!surface.blends || held.near == 0) {
      held = next;
      return;
    }
    for (int c = 0; c < 3; ++c)
      held.color[c] = word_of((held.color[c] * (1 - alpha) + next.color[c] * alpha) / 65'535.0);
    if (alpha < 0.5) return;
    held.normal = next.normal;
    held.surface = next.surface;
  }

  /// Lines and points, two samples thick.
  void draw_thin(const Mesh& mesh, std::size_t number, Samples& samples) {
    const Surface& surface = scene_.surfaces[number];
    const auto dot = [&](const Projected& at, const glm::dvec3& color) {
      for (std::int64_t y = at.point.y / fixed_one - 1; y <= at.point.y / fixed_one; ++y) {
        for (std::int64_t x = at.point.x / fixed_one - 1; x <= at.point.x / fixed_one; ++x) {
          if (x < 0 || x >= rows_.x1 || y < rows_.y0 || y >= rows_.y1) continue;
          Sample& held = samples.of[static_cast<std::size_t>(y) * samples.size + static_cast<std::size_t>(x)];
          if (static_cast<float>(at.depth) <= held.near) continue;
          held = {static_cast<float>(at.depth),
                  {word_of(color.x), word_of(color.y), word_of(color.z)},
                  static_cast<std::uint16_t>(number),
                  glm::i8vec4(0)};
        }
      }
    };
    const auto color_of = [&](std::uint32_t vertex) {
      const glm::dvec3 color(surface.color);
      return mesh.color.empty() ? color : color * glm::dvec3(glm::u8vec3(mesh.color[vertex])) / 255.0;
    };
    if (mesh.topology == Topology::points) {
      for (std::size_t i = 0; i < seen_->size(); ++i) {
        if (i % check_every == 0) job_.check();
        dot((*seen_)[i], color_of(static_cast<std::uint32_t>(i)));
      }
      return;
    }
    for (std::size_t i = 0; i + 1 < mesh.index.size(); i += 2) {
      if (i % check_every == 0) job_.check();
      const Projected &a = (*seen_)[mesh.index.at(i)], &b = (*seen_)[mesh.index.at(i + 1)];
      const std::int64_t dx = b.point.x - a.point.x, dy = b.point.y - a.point.y;
      const std::int64_t steps = std::max({std::abs(dx), std::abs(dy), fixed_one}) / fixed_one;
      // A line that leaves the picture by far is cut off.
      for (std::int64_t step = 0; step <= std::min<std::int64_t>(steps, 8 * samples.size); ++step) {
        const double share = static_cast<double>(step) / static_cast<double>(steps);
        dot({{a.point.x + dx * step / steps, a.point.y + dy * step / steps},
             a.depth + (b.depth - a.depth) * share},
            color_of(mesh.index.at(i)));
      }
    }
  }

  const Scene& scene_;
  const Eye& eye_;
  ScanWindow rows_;
  const Job& job_;
  const Array<Projected>* seen_ = nullptr;  ///< the vertices of the primitive that is drawn
  Array<Projected> own_;
};

/// Calls draw(band) for all bands in parallel.
template <class Draw>
void each_band(const Scene& scene, const Eye& eye, const Job& job, const Draw& draw) {
  const std::uint32_t size = eye.size(), height = (size + bands - 1) / bands;
  parallel_for(job, bands, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto y0 = static_cast<std::int64_t>(i) * height;
      Band band(scene, eye, {0, y0, size, std::min<std::int64_t>(y0 + height, size)}, job);
      draw(band);
    }
  });
}

}  // namespace

Samples draw_samples(const Model& model, const Items& items, const Surfaces& surfaces, const Camera& camera,
                     std::uint32_t size, const Job& job) {
  Samples samples{size, Array<Sample>(job, std::size_t{size} * size, Sample{})};
  Scene scene = scene_of(model, items, surfaces);
  const Eye eye(camera, size);
  project(scene, eye, job);
  each_band(scene, eye, job, [&](Band& band) { band.draw_samples(samples); });
  return samples;
}

ShadowMap draw_shadows(const Model& model, const Items& items, const Surfaces& surfaces, const View& sun,
                       std::uint32_t size, const Job& job) {
  ShadowMap map;
  map.frame = frame_of(sun);
  map.size = size;
  map.depth = Array<float>(job, std::size_t{size} * size, darkest);
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner_of(items.box, corner));
    const glm::dvec2 at(glm::dot(p, map.frame.right), glm::dot(p, map.frame.up));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  constexpr double edge = 4;  // texels
  const double across = std::max({high.x - low.x, high.y - low.y, 1e-6});
  map.step = across / (size - 2 * edge);
  map.low = 0.5 * (low + high) - 0.5 * map.step * size;
  Scene scene = scene_of(model, items, surfaces);
  const Eye eye(map);
  project(scene, eye, job);
  each_band(scene, eye, job, [&](Band& band) { band.draw_depth(map); });
  return map;
}

}  // namespace seedmesh::render
