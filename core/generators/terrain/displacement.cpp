#include "core/generators/terrain/displacement.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/geom/mesh/point_grid.h"
#include "core/geom/mesh/split_inward_corners.h"
#include "core/model/index_width.h"
#include "core/texture/png_image.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t vertices_a_chunk = 4096;
constexpr std::uint32_t none = 0xFFFFFFFFU;
// Vertices nearer than this share of the model's diagonal are welded.
constexpr float weld_share = 1e-6F;

/// Returns the size of the field in metres.
glm::dvec2 reach_of(const Field& field) {
  return {(field.width - 1) * field.cell, (field.depth - 1) * field.cell};
}

/// Projects a point along an axis to the field, whose centre is at the origin.
glm::dvec2 projected_along(int axis, const glm::dvec3& p, const glm::dvec2& reach) {
  const glm::dvec2 at = axis == 0   ? glm::dvec2(p.z, -p.y)
                        : axis == 1 ? glm::dvec2(p.x, p.z)
                                    : glm::dvec2(p.x, -p.y);
  return at + 0.5 * reach;
}

double height_at(const Field& field, const glm::dvec3& position, const glm::dvec3& normal) {
  double height = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double weight = normal[axis] * normal[axis];
    if (weight == 0) continue;
    const glm::dvec2 at = projected_along(axis, position, reach_of(field));
    height += weight * mirrored_height(field, at.x, at.y);
  }
  return height;
}

bool is_surface(const Mesh& mesh) { return mesh.topology == Topology::triangles && !mesh.normal.empty(); }

/// Subdivides a mesh. A table holds the vertex in the middle of each edge.
class Cutting {
 public:
  Cutting(Mesh& mesh, Job& job) : mesh_(mesh), job_(job), halves_(job, mesh.index.size() / 2) {}

  void cut() {
    const std::size_t triangles = mesh_.index.size() / 3;
    job_.spend(Resource::triangles, 3 * triangles);
    Array<std::uint32_t> index(job_, 12 * triangles);
    std::uint32_t* out = index.data();
    for (std::size_t t = 0; t < triangles; ++t) {
      if (t % 4096 == 0) job_.check();
      const std::uint32_t a = mesh_.index.at(3 * t), b = mesh_.index.at(3 * t + 1),
                          c = mesh_.index.at(3 * t + 2);
      const std::uint32_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
      for (const std::uint32_t i : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) *out++ = i;
    }
    mesh_.index.small = Array<std::uint16_t>();
    mesh_.index.wide = std::move(index);
    mesh_.cache_ordered = false;
  }

 private:
  std::uint32_t half(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    std::uint32_t& number = halves_[edge];
    if (number == none) {
      number = static_cast<std::uint32_t>(mesh_.position.size());
      add(a, b);
    }
    return number;
  }

  void add(std::uint32_t a, std::uint32_t b) {
    mesh_.position.push_back((mesh_.position[a] + mesh_.position[b]) * 0.5F);
    const glm::vec3 normal = mesh_.normal[a] + mesh_.normal[b];
    mesh_.normal.push_back(glm::vec3(math::unit(glm::dvec3(normal), glm::dvec3(mesh_.normal[a]))));
    for (Array<glm::vec2>& uv : mesh_.uv) {
      if (!uv.empty()) uv.push_back((uv[a] + uv[b]) * 0.5F);
    }
    if (!mesh_.color.empty()) {
      glm::u8vec4 mean;
      for (int i = 0; i < 4; ++i)
        mean[i] = static_cast<std::uint8_t>((mesh_.color[a][i] + mesh_.color[b][i] + 1) / 2);
      mesh_.color.push_back(mean);
    }
  }

  Mesh& mesh_;
  Job& job_;
  NumberTable halves_;  ///< for each edge
};

/// Calls use(a, b, c, normal) for every triangle. The length of the normal is twice the area.
template <class Use>
void each_triangle(const Mesh& mesh, const Job& job, Use use) {
  for (std::size_t t = 0; t < mesh.index.size(); t += 3) {
    if (t % 12288 == 0) job.check();
    const std::uint32_t a = mesh.index.at(t), b = mesh.index.at(t + 1), c = mesh.index.at(t + 2);
    const glm::dvec3 from(mesh.position[a]);
    use(a, b, c, glm::cross(glm::dvec3(mesh.position[b]) - from, glm::dvec3(mesh.position[c]) - from));
  }
}

/// Numbers the welded vertices of several meshes and gives each a normal: the sum of those of its triangles,
/// weighted by area. So a corner of a block moves along its diagonal for any triangulation.
class WeldedPoints {
 public:
  WeldedPoints(const std::vector<Mesh*>& meshes, const Job& job) : point_(job), weld_of_(job), normal_(job) {
    for (const Mesh* mesh : meshes) {
      first_.push_back(point_.size());
      point_.append(mesh->position.span());
    }
    const Box box = bounds_of(point_.span());
    const glm::vec3 extent = box.max - box.min;
    Weld weld(job, box, weld_share * std::sqrt(glm::dot(extent, extent)), point_.span());
    weld_of_.resize(point_.size());
    for (std::uint32_t i = 0; i < point_.size(); ++i) {
      if (i % 4096 == 0) job.check();
      weld_of_[i] = weld.number(i);
    }
    normal_ = Array<glm::dvec3>(job, weld.size(), glm::dvec3(0));
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::uint32_t* weld_of = of(m);
      each_triangle(*meshes[m], job,
                    [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, const glm::dvec3& face) {
                      for (const std::uint32_t corner : {a, b, c}) normal_[weld_of[corner]] += face;
                    });
    }
  }

  std::size_t size() const { return normal_.size(); }
  /// Returns the numbers of the vertices of mesh `m`.
  const std::uint32_t* of(std::size_t m) const { return weld_of_.data() + first_[m]; }
  glm::dvec3 normal(std::uint32_t weld_of) const { return math::unit(normal_[weld_of], glm::dvec3(0)); }

 private:
  std::vector<std::size_t> first_;
  Array<glm::vec3> point_;
  Array<std::uint32_t> weld_of_;
  Array<glm::dvec3> normal_;
};

/// Sets the normals of the displaced surface. Welded vertices that had one normal get that of their triangles.
void shade(Mesh& mesh, const std::uint32_t* weld_of, std::size_t welds, const Job& job) {
  struct Group {
    std::uint32_t next;  ///< next group of the same weld
    glm::vec3 before;
    glm::dvec3 sum;
  };
  Array<Group> groups(job);
  Array<std::uint32_t> first(job, welds, none), group_of(job, mesh.position.size());
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    std::uint32_t group = first[weld_of[i]];
    while (group != none && groups[group].before != mesh.normal[i]) group = groups[group].next;
    if (group == none) {
      group = static_cast<std::uint32_t>(groups.size());
      groups.push_back({first[weld_of[i]], mesh.normal[i], glm::dvec3(0)});
      first[weld_of[i]] = group;
    }
    group_of[i] = group;
  }
  each_triangle(mesh, job, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, const glm::dvec3& face) {
    for (const std::uint32_t corner : {a, b, c}) groups[group_of[corner]].sum += face;
  });
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    mesh.normal[i] = glm::vec3(math::unit(groups[group_of[i]].sum, glm::dvec3(mesh.normal[i])));
}

void displace_group(MeshGroup& group, const Field& field, int rounds, Job& job) {
  std::vector<Mesh*> meshes;
  for (Primitive& each : group.primitives) {
    if (!is_surface(each.mesh)) continue;
    for (int round = 0; round < rounds; ++round) Cutting(each.mesh, job).cut();
    meshes.push_back(&each.mesh);
  }
  const WeldedPoints welds(meshes, job);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    Mesh& mesh = *meshes[m];
    const std::uint32_t* weld_of = welds.of(m);
    parallel_for(job, mesh.position.size(), vertices_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   for (std::size_t i = begin; i < end; ++i) {
                     const glm::dvec3 normal = welds.normal(weld_of[i]), at(mesh.position[i]);
                     mesh.position[i] = glm::vec3(at + normal * height_at(field, at, normal));
                   }
                 });
    shade(mesh, weld_of, welds.size(), job);
    mesh.tangent = Array<glm::vec4>();
    // Where a displacement folds the surface, faces of one corner can face opposite sides.
    split_inward_corners(mesh, job);
  }
}

/// Returns the axis nearest to the normal of a triangle; the first of equal ones.
int axis_of(const Mesh& mesh, std::size_t t) {
  const glm::vec3 a = mesh.position[mesh.index.at(t)];
  const glm::vec3 face =
      glm::abs(glm::cross(mesh.position[mesh.index.at(t + 1)] - a, mesh.position[mesh.index.at(t + 2)] - a));
  if (face.y >= face.x && face.y >= face.z) return 1;
  return face.x >= face.z ? 0 : 2;
}

/// Duplicates vertices between triangles that are projected along different axes, and writes uv set 1.
void unfold(Mesh& mesh, const glm::dvec2& reach, const Job& job) {
  const auto old_count = static_cast<std::uint32_t>(mesh.position.size());
  Array<std::uint32_t> copies(job, 3 * std::size_t{old_count}, none);  // by vertex and axis
  Array<std::uint8_t> axis(job, old_count, std::uint8_t{3});
  Array<std::uint32_t> index(job, mesh.index.size());
  const auto copy_of = [&](std::uint32_t vertex, int wanted) {
    if (axis[vertex] == 3) axis[vertex] = static_cast<std::uint8_t>(wanted);
    if (axis[vertex] == wanted) return vertex;
    std::uint32_t& copy = copies[3 * std::size_t{vertex} + static_cast<std::size_t>(wanted)];
    if (copy == none) {
      copy = static_cast<std::uint32_t>(mesh.position.size());
      mesh.position.push_back(mesh.position[vertex]);
      mesh.normal.push_back(mesh.normal[vertex]);
      for (Array<glm::vec2>& uv : mesh.uv) {
        if (!uv.empty()) uv.push_back(uv[vertex]);
      }
      if (!mesh.color.empty()) mesh.color.push_back(mesh.color[vertex]);
      axis.push_back(static_cast<std::uint8_t>(wanted));
    }
    return copy;
  };
  mesh.uv[1] = Array<glm::vec2>();
  for (std::size_t t = 0; t < mesh.index.size(); t += 3) {
    if (t % 12288 == 0) job.check();
    const int wanted = axis_of(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) index[t + k] = copy_of(mesh.index.at(t + k), wanted);
  }
  mesh.uv[1] = Array<glm::vec2>(job, mesh.position.size());
  for (std::size_t i = 0; i < mesh.position.size(); ++i)
    mesh.uv[1][i] = glm::vec2(projected_along(axis[i], glm::dvec3(mesh.position[i]), reach) / (2.0 * reach));
  mesh.index.small = Array<std::uint16_t>();
  mesh.index.wide = std::move(index);
  mesh.tangent = Array<glm::vec4>();
}

std::uint8_t byte_of(double value) {
  return static_cast<std::uint8_t>(std::clamp(value * 127.5 + 128.0, 0.0, 255.0));
}

/// Returns the slopes of the mirrored field over both its periods as an image; green is towards its top.
texture::Picture slopes_picture(const Field& field, const glm::dvec2& period, std::int32_t side,
                                const Job& job) {
  texture::Picture picture;
  picture.width = picture.height = static_cast<std::uint32_t>(side);
  picture.channels = 3;
  picture.bytes =
      Array<std::uint8_t>(job, 3 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  const glm::dvec2 step = period / static_cast<double>(side);
  parallel_for(job, static_cast<std::size_t>(side), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t row = begin; row < end; ++row) {
      const double z = (static_cast<double>(row) + 0.5) * step.y;
      std::uint8_t* out = picture.bytes.data() + 3 * row * static_cast<std::size_t>(side);
      for (std::int32_t column = 0; column < side; ++column) {
        const double x = (column + 0.5) * step.x;
        const double east =
            (mirrored_height(field, x + step.x, z) - mirrored_height(field, x - step.x, z)) / (2 * step.x);
        const double south =
            (mirrored_height(field, x, z + step.y) - mirrored_height(field, x, z - step.y)) / (2 * step.y);
        const double length = std::sqrt(1 + (east * east + south * south));
        for (const double part : {-east / length, south / length, 1 / length}) *out++ = byte_of(part);
      }
    }
  });
  return picture;
}

}  // namespace

double mirrored_height(const Field& field, double x, double z) {
  const auto along = [&](double metres, std::int32_t samples) {
    const double last = samples - 1, twice = 2 * last;
    double at = metres / field.cell;
    at -= twice * std::floor(at / twice);
    return std::clamp(at > last ? twice - at : at, 0.0, last);
  };
  const double px = along(x, field.width), pz = along(z, field.depth);
  const auto ix = std::min(static_cast<std::int32_t>(px), field.width - 2);
  const auto iz = std::min(static_cast<std::int32_t>(pz), field.depth - 2);
  const double fx = px - ix, fz = pz - iz;
  const float *north = field.row(iz) + ix, *south = field.row(iz + 1) + ix;
  const double top = north[0] + (static_cast<double>(north[1]) - north[0]) * fx;
  const double low = south[0] + (static_cast<double>(south[1]) - south[0]) * fx;
  return top + (low - top) * fz;
}

void displace(Model& model, const Field& field, int rounds, Job& job) {
  widen(model, job);
  for (MeshGroup& group : model.meshes) displace_group(group, field, rounds, job);
}

void add_normal_map(Model& model, const Field& field, std::int32_t side, Job& job) {
  const glm::dvec2 reach = reach_of(field);
  const texture::Picture slopes = slopes_picture(field, 2.0 * reach, side, job);
  model.textures.push_back(
      texture::png_image("relief_normal", slopes.view(), texture::PngEffort::small, job));
  const TextureUse use{static_cast<int>(model.textures.size()) - 1, 1, true};
  for (MeshGroup& group : model.meshes) {
    for (Primitive& each : group.primitives) {
      if (!is_surface(each.mesh)) continue;
      unfold(each.mesh, reach, job);
      if (each.material < 0) {
        each.material = static_cast<int>(model.materials.size());
        model.materials.emplace_back().name = "surface";
      }
      Material& material = model.materials[static_cast<std::size_t>(each.material)];
      material.recipe = {};
      material.normal_texture = use;
    }
  }
}

}  // namespace seedmesh::terrain
