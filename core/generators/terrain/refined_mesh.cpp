#include "core/generators/terrain/refined_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/ground.h"
#include "core/generators/terrain/square.h"
#include "core/generators/terrain/surface.h"

namespace seedmesh::terrain {
namespace {

/// Squares of the window of a refinement and the vertices inside them and on their edges. Vertices of the field are the
/// samples; others are numbered after them.
class Lattice {
 public:
  Lattice(const Refinement& refinement, std::uint32_t first)
      : refinement_(refinement), window_(refinement.squares()), count_(first) {
    const auto wide = static_cast<std::size_t>(window_.width) + 1,
               deep = static_cast<std::size_t>(window_.depth) + 1;
    levels_.resize(wide * deep);
    inside_.resize(wide * deep);
    west_.resize(wide * deep);
    north_.resize(wide * deep);
    for (std::int32_t j = 0; j <= window_.depth; ++j) {
      for (std::int32_t i = 0; i <= window_.width; ++i) levels_[at(i, j)] = refinement.level(x(i), z(j));
    }
    const auto take = [this](std::vector<std::uint32_t>& of, std::size_t number, std::int32_t many) {
      of[number] = count_;
      count_ += static_cast<std::uint32_t>(many);
    };
    for (std::int32_t j = 0; j <= window_.depth; ++j) {
      for (std::int32_t i = 0; i <= window_.width; ++i) {
        const std::int32_t n = segments(i, j);
        take(inside_, at(i, j), (n - 1) * (n - 1));
        take(west_, at(i, j), west_segments(i, j) - 1);
        take(north_, at(i, j), north_segments(i, j) - 1);
      }
    }
  }

  std::uint32_t vertices() const { return count_; }
  const Window& window() const { return window_; }
  std::int32_t x(std::int32_t i) const { return static_cast<std::int32_t>(window_.x) + i; }
  std::int32_t z(std::int32_t j) const { return static_cast<std::int32_t>(window_.z) + j; }

  /// Returns the segments of a square along each side, 1 where it is not divided.
  std::int32_t segments(std::int32_t i, std::int32_t j) const { return 1 << level(i, j); }
  std::int32_t west_segments(std::int32_t i, std::int32_t j) const {
    return 1 << std::min(level(i - 1, j), level(i, j));
  }
  std::int32_t north_segments(std::int32_t i, std::int32_t j) const {
    return 1 << std::min(level(i, j - 1), level(i, j));
  }

  std::uint32_t sample(std::int32_t i, std::int32_t j) const {
    return static_cast<std::uint32_t>(z(j)) * static_cast<std::uint32_t>(refinement_.width) +
           static_cast<std::uint32_t>(x(i));
  }
  std::uint32_t inside(std::int32_t i, std::int32_t j, std::int32_t a, std::int32_t b) const {
    return inside_[at(i, j)] + static_cast<std::uint32_t>((b - 1) * (segments(i, j) - 1) + a - 1);
  }
  std::uint32_t west(std::int32_t i, std::int32_t j, std::int32_t b) const {
    return west_[at(i, j)] + static_cast<std::uint32_t>(b - 1);
  }
  std::uint32_t north(std::int32_t i, std::int32_t j, std::int32_t a) const {
    return north_[at(i, j)] + static_cast<std::uint32_t>(a - 1);
  }

 private:
  int level(std::int32_t i, std::int32_t j) const { return i < 0 || j < 0 ? 0 : levels_[at(i, j)]; }
  std::size_t at(std::int32_t i, std::int32_t j) const {
    return static_cast<std::size_t>(j) * (static_cast<std::size_t>(window_.width) + 1) +
           static_cast<std::size_t>(i);
  }

  const Refinement& refinement_;
  Window window_;
  std::uint32_t count_;
  std::vector<int> levels_;  ///< with one more row and column, whose squares are not divided
  std::vector<std::uint32_t> inside_, west_, north_;  ///< the first vertex of each
};

/// Writes positions and sites of vertices.
class VertexWriter {
 public:
  VertexWriter(const Field& field, const RefinedGround& ground, RefinedMesh& out)
      : ground_(field), sampler_(ground), out_(out) {}

  /// x and z in cells. Samples of the field keep their positions where there are no forms.
  void write(std::uint32_t v, double x, double z) {
    const Field& field = ground_.field;
    const RefinedPoint point = sampler_.at(x * field.cell, z * field.cell);
    out_.mesh.position[v] = {static_cast<float>(ground_.west + x * field.cell), point.height,
                             static_cast<float>(ground_.north + z * field.cell)};
    out_.mesh.uv[0][v] = {static_cast<float>(x / (field.width - 1)),
                          static_cast<float>(z / (field.depth - 1))};
    out_.sites[v] = {point.site, point.weight, point.small};
  }

 private:
  Ground ground_;
  RefinedGround::Sampler sampler_;
  RefinedMesh& out_;
};

/// Writes the vertices of all divided squares, row by row.
void write_vertices(const Lattice& lattice, const Field& field, const RefinedGround& ground, RefinedMesh& out,
                    const Job& job) {
  const Window& window = lattice.window();
  parallel_for(job, static_cast<std::size_t>(window.depth) + 1, 1,
               [&](std::size_t row, std::size_t, std::size_t) {
                 job.check();
                 VertexWriter writer(field, ground, out);
                 const auto j = static_cast<std::int32_t>(row);
                 for (std::int32_t i = 0; i <= window.width; ++i) {
                   const std::int32_t x = lattice.x(i), z = lattice.z(j);
                   writer.write(lattice.sample(i, j), x, z);
                   const auto along = [](std::int32_t k, std::int32_t count) {
                     return static_cast<double>(k) / count;
                   };
                   const std::int32_t east = lattice.north_segments(i, j),
                                      south = lattice.west_segments(i, j), inside = lattice.segments(i, j);
                   for (std::int32_t a = 1; a < east; ++a)
                     writer.write(lattice.north(i, j, a), x + along(a, east), z);
                   for (std::int32_t b = 1; b < south; ++b)
                     writer.write(lattice.west(i, j, b), x, z + along(b, south));
                   for (std::int32_t b = 1; b < inside; ++b) {
                     for (std::int32_t a = 1; a < inside; ++a)
                       writer.write(lattice.inside(i, j, a, b), x + along(a, inside), z + along(b, inside));
                   }
                 }
               });
}

/// Adds the triangles of divided squares.
class Divider {
 public:
  Divider(const Lattice& lattice, Mesh& mesh) : lattice_(lattice), mesh_(mesh) {}

  void divide(std::int32_t i, std::int32_t j) {
    const std::int32_t n = lattice_.segments(i, j);
    for (std::int32_t b = 1; b < n - 1; ++b) {
      for (std::int32_t a = 1; a < n - 1; ++a) {
        quad(lattice_.inside(i, j, a, b), lattice_.inside(i, j, a + 1, b), lattice_.inside(i, j, a, b + 1),
             lattice_.inside(i, j, a + 1, b + 1));
      }
    }
    const auto inner = [&](auto vertex) {
      inner_.clear();
      for (std::int32_t k = 1; k < n; ++k) inner_.push_back(vertex(k));
    };
    const auto outer = [&](std::uint32_t first, std::uint32_t last, std::int32_t count, auto vertex) {
      outer_.assign(1, first);
      for (std::int32_t k = 1; k < count; ++k) outer_.push_back(vertex(k));
      outer_.push_back(last);
    };
    const std::uint32_t nw = lattice_.sample(i, j), ne = lattice_.sample(i + 1, j),
                        sw = lattice_.sample(i, j + 1), se = lattice_.sample(i + 1, j + 1);
    inner([&](std::int32_t k) { return lattice_.inside(i, j, k, 1); });
    outer(nw, ne, lattice_.north_segments(i, j), [&](std::int32_t k) { return lattice_.north(i, j, k); });
    join(n, false);
    inner([&](std::int32_t k) { return lattice_.inside(i, j, k, n - 1); });
    outer(sw, se, lattice_.north_segments(i, j + 1),
          [&](std::int32_t k) { return lattice_.north(i, j + 1, k); });
    join(n, true);
    inner([&](std::int32_t k) { return lattice_.inside(i, j, 1, k); });
    outer(nw, sw, lattice_.west_segments(i, j), [&](std::int32_t k) { return lattice_.west(i, j, k); });
    join(n, true);
    inner([&](std::int32_t k) { return lattice_.inside(i, j, n - 1, k); });
    outer(ne, se, lattice_.west_segments(i + 1, j),
          [&](std::int32_t k) { return lattice_.west(i + 1, j, k); });
    join(n, false);
  }

 private:
  float height(std::uint32_t v) const { return mesh_.position[v].y; }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t v : {a, b, c}) mesh_.index.wide.push_back(v);
  }

  void quad(std::uint32_t nw, std::uint32_t ne, std::uint32_t sw, std::uint32_t se) {
    const bool falls = falls_to_south_east(height(nw), height(ne), height(sw), height(se));
    for (const auto& [a, b, c] : divided_square(falls, nw, ne, sw, se)) triangle(a, b, c);
  }

  /// Fills the strip between an edge and the vertices inside that are nearest to it: each step goes along the line whose
  /// next middle comes first. `turned`: the inside is on the right along the edge, seen from above.
  void join(std::int32_t n, bool turned) {
    const std::size_t last = outer_.size() - 1;
    const std::size_t step = static_cast<std::size_t>(n) / last;
    std::size_t k = 0, m = 0;
    while (k < last || m + 1 < inner_.size()) {
      // Position m of the inner line is m + 1 segments along the square.
      const bool along_edge = m + 1 == inner_.size() || (k < last && (2 * k + 1) * step <= 2 * m + 3);
      std::uint32_t b = inner_[m], c = along_edge ? outer_[k + 1] : inner_[m + 1];
      if (turned) std::swap(b, c);
      triangle(outer_[k], b, c);
      ++(along_edge ? k : m);
    }
  }

  const Lattice& lattice_;
  Mesh& mesh_;
  std::vector<std::uint32_t> outer_, inner_;
};

/// Removes the triangles of divided squares from those of a grid, of which each square has two.
void remove_divided(const Refinement& refinement, const Indices& from, Array<std::uint32_t>& to) {
  constexpr std::size_t corners_a_square = 6;
  const auto wide = static_cast<std::uint32_t>(refinement.width);
  for (std::size_t i = 0; i < from.size(); i += corners_a_square) {
    // The first corner of a square is the north-western one.
    const std::uint32_t corner = from.at(i);
    if (refinement.level(static_cast<std::int32_t>(corner % wide), static_cast<std::int32_t>(corner / wide)) >
        0)
      continue;
    for (std::size_t k = 0; k < corners_a_square; ++k) to.push_back(from.at(i + k));
  }
}

/// Sets the normals of vertices of divided squares to the mean of their triangles by area. Samples on the border of the
/// field keep those of the field, which its neighbours share.
void set_normals(const Lattice& lattice, const Field& field, Mesh& mesh, const Job& job) {
  const std::uint32_t samples =
      static_cast<std::uint32_t>(field.width) * static_cast<std::uint32_t>(field.depth);
  Array<std::uint8_t> is_new(job, mesh.position.size(), std::uint8_t{0});
  std::fill(is_new.begin() + samples, is_new.end(), std::uint8_t{1});
  const Window& window = lattice.window();
  for (std::int32_t j = 0; j <= window.depth; ++j) {
    for (std::int32_t i = 0; i <= window.width; ++i) {
      const std::int32_t x = lattice.x(i), z = lattice.z(j);
      if (x == 0 || z == 0 || x == field.width - 1 || z == field.depth - 1) continue;
      const bool touches = lattice.segments(i, j) > 1 || (i > 0 && lattice.segments(i - 1, j) > 1) ||
                           (j > 0 && lattice.segments(i, j - 1) > 1) ||
                           (i > 0 && j > 0 && lattice.segments(i - 1, j - 1) > 1);
      if (touches) is_new[lattice.sample(i, j)] = 1;
    }
  }
  Array<glm::vec3> sums(job, mesh.position.size(), glm::vec3(0));
  const Array<std::uint32_t>& index = mesh.index.wide;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    if (i % 12'288 == 0) job.check();
    const glm::vec3& a = mesh.position[index[i]];
    const glm::vec3 across = glm::cross(mesh.position[index[i + 1]] - a, mesh.position[index[i + 2]] - a);
    for (std::size_t k = 0; k < 3; ++k) sums[index[i + k]] += across;
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (is_new[v] != 0) mesh.normal[v] = math::unit(sums[v], glm::vec3(0, 1, 0));
  }
  turn_normals_up(mesh, job);
}

/// Adds the slopes of the small forms to the sites of vertices, and colours them. Hollows between the forms are darker,
/// since less light reaches them.
void set_colors(const GroundColors& colors, RefinedMesh& out, const Job& job) {
  constexpr float own_slope = 0.3F, shade = 0.2F;
  constexpr std::size_t vertices_a_chunk = 4096;
  parallel_for(job, out.sites.size(), vertices_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t v = begin; v < end; ++v) {
      VertexSite& site = out.sites[v];
      if (site.weight <= 0) continue;
      const glm::vec3& normal = out.mesh.normal[v];
      const float slope = std::sqrt(normal.x * normal.x + normal.z * normal.z) / normal.y;
      site.site.slope += site.weight * own_slope * (slope - site.site.slope);
      if (out.mesh.color.empty()) continue;
      const glm::vec3 color = glm::clamp(colors.color(site.site) * (1 + shade * site.small), 0.0F, 1.0F);
      const glm::u8vec3 bytes(color * 255.0F + 0.5F);
      out.mesh.color[v] = {bytes, 255};
    }
  });
}

}  // namespace

RefinedMesh refined_mesh(const Field& field, const RefinedGround& ground, const GroundColors& ground_colors,
                         const Array<glm::u8vec4>& colors, Job& job) {
  const Refinement& refinement = ground.refinement();
  const std::uint64_t added = added_triangles(refinement, job.limits().triangles);
  job.spend(Resource::triangles, added);
  RefinedMesh out;
  out.mesh = grid_mesh(field, {0, 0, field.width, field.depth}, colors, Shading::smooth, job);
  Mesh& mesh = out.mesh;
  const std::size_t samples = mesh.position.size();
  const Lattice lattice(refinement, static_cast<std::uint32_t>(samples));
  const Indices whole = std::exchange(mesh.index, {});
  mesh.index.wide = Array<std::uint32_t>(job);
  mesh.index.wide.reserve(whole.size() + 3 * added);
  remove_divided(refinement, whole, mesh.index.wide);
  mesh.position.resize(lattice.vertices());
  mesh.normal.resize(lattice.vertices());
  mesh.uv[0].resize(lattice.vertices());
  if (!mesh.color.empty()) mesh.color.resize(lattice.vertices());
  out.sites = Array<VertexSite>(job, lattice.vertices(), VertexSite{});
  write_vertices(lattice, field, ground, out, job);
  Divider divider(lattice, mesh);
  const Window& window = lattice.window();
  for (std::int32_t j = 0; j < window.depth; ++j) {
    job.check();
    for (std::int32_t i = 0; i < window.width; ++i) {
      if (lattice.segments(i, j) > 1) divider.divide(i, j);
    }
  }
  set_normals(lattice, field, mesh, job);
  if (!mesh.color.empty()) {
    for (std::size_t v = samples; v < lattice.vertices(); ++v) {
      const glm::vec3 color = ground_colors.color(out.sites[v].site) * 255.0F + 0.5F;
      mesh.color[v] = {glm::u8vec3(color), 255};
    }
  }
  set_colors(ground_colors, out, job);
  mesh.cache_ordered = false;
  return out;
}

}  // namespace seedmesh::terrain
