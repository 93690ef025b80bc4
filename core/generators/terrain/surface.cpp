#include "core/generators/terrain/surface.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/scan.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Squares of a band: both rows of samples around a row of them fit into a cache of 16 vertices.
constexpr std::int32_t band = 6;
// Where no step between neighbours is steeper, no smooth normal looks behind a triangle: 2 s s < 1.
constexpr float gentle = 0.7F;
// How far from behind a triangle a normal keeps.
constexpr float clear = 0.95F;

/// Where samples lie.
struct Ground {
  explicit Ground(const Field& given)
      : field(given),
        west(-(given.width - 1) / 2.0 * given.cell),
        north(-(given.depth - 1) / 2.0 * given.cell) {}
  float x(std::int32_t i) const { return static_cast<float>(west + i * field.cell); }
  float z(std::int32_t j) const { return static_cast<float>(north + j * field.cell); }
  float u(std::int32_t i) const { return static_cast<float>(static_cast<double>(i) / (field.width - 1)); }
  float v(std::int32_t j) const { return static_cast<float>(static_cast<double>(j) / (field.depth - 1)); }

  const Field& field;
  double west, north;
};

/// Slopes along a row of the part, from both neighbours where they are.
struct Slopes {
  const float *here, *north, *south;
  float per_rows, per_cell;
  std::int32_t first, last;  ///< columns that there are, margin included
  glm::vec2 at(std::int32_t x) const {
    const std::int32_t west = std::max(x - 1, first), east = std::min(x + 1, last);
    return {(here[east] - here[west]) * per_cell / static_cast<float>(east - west),
            (south[x] - north[x]) * per_rows};
  }
};

Slopes slopes_of(const Field& field, std::int32_t z) {
  const std::int32_t m = field.margin;
  const std::int32_t north = std::max(z - 1, -m), south = std::min(z + 1, field.depth - 1 + m);
  const auto per_cell = static_cast<float>(1 / field.cell);
  return {field.row(z),       field.row(north),
          field.row(south),   per_cell / static_cast<float>(south - north),
          per_cell,           -m,
          field.width - 1 + m};
}

glm::vec3 normal_of(const glm::vec2& slope) {
  const float length = std::sqrt(1 + (slope.x * slope.x + slope.y * slope.y));
  return {-slope.x / length, 1 / length, -slope.y / length};
}

glm::vec2 slope_of(const glm::vec3& normal) { return {-normal.x / normal.y, -normal.z / normal.y}; }

float dot(const glm::vec2& a, const glm::vec2& b) { return a.x * b.x + a.y * b.y; }

/// The normal of a slope, turned towards straight up as far as is needed to look behind no triangle around:
/// in slopes, triangle t and vertex v are on one side where 1 + t.v > 0. `least` is the smallest t.v.
glm::vec3 leaning_back(const glm::vec2& slope, float least) {
  return normal_of(least <= -clear ? slope * (clear / -least) : slope);
}

/// The smallest product with `own` of the slopes that triangles around a sample can have, however its squares
/// are cut: of neighbours too, so that both sides of a border between tiles agree.
float least_around(const Field& field, std::int32_t x, std::int32_t z, const glm::vec2& own) {
  const std::int32_t m = field.margin;
  const auto per_cell = static_cast<float>(1 / field.cell);
  float least = 0;
  for (std::int32_t j = std::max(z - 1, -m); j <= std::min(z, field.depth - 2 + m); ++j) {
    for (std::int32_t i = std::max(x - 1, -m); i <= std::min(x, field.width - 2 + m); ++i) {
      const float nw = field.at(i, j), ne = field.at(i + 1, j), sw = field.at(i, j + 1),
                  se = field.at(i + 1, j + 1);
      for (const float east : {ne - nw, se - sw}) {
        for (const float south : {sw - nw, se - ne})
          least = std::min(least, dot(glm::vec2(east, south) * per_cell, own));
      }
    }
  }
  return least;
}

bool on_border(const Window& part, Place at) {
  return at.x == part.x || at.z == part.z || at.x == part.x + part.width - 1 ||
         at.z == part.z + part.depth - 1;
}

/// The slope between samples so far to either side, as far as there are any.
glm::vec2 wide_slope(const Field& field, Place at, std::int32_t reach) {
  const std::int32_t m = field.margin;
  const std::int32_t west = std::max(at.x - reach, -m), east = std::min(at.x + reach, field.width - 1 + m);
  const std::int32_t north = std::max(at.z - reach, -m), south = std::min(at.z + reach, field.depth - 1 + m);
  const auto per_cell = static_cast<float>(1 / field.cell);
  return {(field.at(east, at.z) - field.at(west, at.z)) * per_cell / static_cast<float>(east - west),
          (field.at(at.x, south) - field.at(at.x, north)) * per_cell / static_cast<float>(south - north)};
}

/// leaning_back() for the normals of a reduced mesh, over the triangles that it has.
void lean_back(Mesh& mesh, const Job& job) {
  Array<float> least(job, mesh.position.size(), 0.0F);
  const Array<std::uint32_t>& index = mesh.index.wide;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    if (i % 12288 == 0) job.check();
    const glm::vec3& a = mesh.position[index[i]];
    const glm::vec2 face =
        slope_of(glm::cross(mesh.position[index[i + 1]] - a, mesh.position[index[i + 2]] - a));
    for (std::size_t k = 0; k < 3; ++k) {
      float& own = least[index[i + k]];
      own = std::min(own, dot(face, slope_of(mesh.normal[index[i + k]])));
    }
  }
  for (std::size_t i = 0; i < least.size(); ++i)
    mesh.normal[i] = leaning_back(slope_of(mesh.normal[i]), least[i]);
}

/// Triangles in an order that a vertex cache likes, vertices in the order of their first use.
void order_for_cache(Triangulation& plan, const Job& job) {
  Array<std::uint32_t> ordered(job, plan.index.size());
  meshopt_optimizeVertexCache(ordered.data(), plan.index.data(), plan.index.size(), plan.samples.size());
  job.check();
  Array<std::uint32_t> place(job, plan.samples.size(), 0xFFFFFFFFU);
  Array<std::uint32_t> samples(job);
  samples.reserve(plan.samples.size());
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    std::uint32_t& at = place[ordered[i]];
    if (at == 0xFFFFFFFFU) {
      at = static_cast<std::uint32_t>(samples.size());
      samples.push_back(plan.samples[ordered[i]]);
    }
    plan.index[i] = at;
  }
  plan.samples = std::move(samples);
}

void make_upright(Mesh& mesh, const Job& job) {
  mesh.normal = Array<glm::vec3>(job, mesh.position.size(), glm::vec3(0, 1, 0));
  mesh.tangent = Array<glm::vec4>(job, mesh.position.size(), glm::vec4(1, 0, 0, 1));
}

/// Positions, normals, texture coordinates and colours of one row of a part; gives the steepest step to a
/// neighbour eastwards or southwards.
float fill_row(const Ground& ground, const Window& part, std::int32_t j, const Array<glm::u8vec4>& colors,
               Mesh& mesh) {
  const Field& field = ground.field;
  const auto left = static_cast<std::int32_t>(part.x);
  const std::int32_t z = static_cast<std::int32_t>(part.z) + j;
  const std::size_t first = static_cast<std::size_t>(j) * static_cast<std::size_t>(part.width);
  const Slopes slopes = slopes_of(field, z);
  const float* below = field.row(std::min(z + 1, field.depth - 1));
  const float at_z = ground.z(z), v = ground.v(z);
  const double across = 1.0 / (field.width - 1);
  float steepest = 0;
  glm::vec3* position = mesh.position.data() + first;
  glm::vec2* uv = mesh.uv[0].data() + first;
  for (std::int32_t i = 0; i < part.width; ++i) {
    const std::int32_t x = left + i;
    position[i] = {static_cast<float>(ground.west + x * field.cell), slopes.here[x], at_z};
    uv[i] = {static_cast<float>(x * across), v};
    const float down = std::abs(below[x] - slopes.here[x]);
    steepest = down > steepest ? down : steepest;
  }
  if (!mesh.normal.empty()) {
    glm::vec3* normal = mesh.normal.data() + first;
    // Ends by themselves, so that the loop between them has no choice to make.
    const auto plain = [&](std::int32_t i) { normal[i] = normal_of(slopes.at(left + i)); };
    plain(0);
    plain(part.width - 1);
    for (std::int32_t i = 1; i < part.width - 1; ++i) {
      const std::int32_t x = left + i;
      const float gx = (slopes.here[x + 1] - slopes.here[x - 1]) * (slopes.per_cell * 0.5F);
      const float gz = (slopes.south[x] - slopes.north[x]) * slopes.per_rows;
      const float inverse = 1 / std::sqrt(1 + (gx * gx + gz * gz));
      normal[i] = {-gx * inverse, inverse, -gz * inverse};
    }
    for (std::int32_t i = 0; i + 1 < part.width; ++i) {
      const float step = std::abs(slopes.here[left + i + 1] - slopes.here[left + i]);
      steepest = step > steepest ? step : steepest;
    }
  }
  if (!colors.empty()) {
    const glm::u8vec4* from =
        colors.data() + static_cast<std::size_t>(z) * static_cast<std::size_t>(field.width) + left;
    std::copy(from, from + part.width, mesh.color.data() + first);
  }
  return steepest * slopes.per_cell;
}

/// Triangles of the rows [begin, end) of squares of one band of columns.
void fill_band(const Field& field, const Window& part, std::int32_t first, std::int32_t last,
               std::int32_t begin, std::int32_t end, std::uint32_t* out) {
  const auto wide = static_cast<std::uint32_t>(part.width);
  const auto left = static_cast<std::int32_t>(part.x), top = static_cast<std::int32_t>(part.z);
  for (std::int32_t j = begin; j < end; ++j) {
    const float* north = field.row(top + j) + left;
    const float* south = field.row(top + j + 1) + left;
    for (std::int32_t i = first; i < last; ++i, out += 6) {
      const std::uint32_t nw = static_cast<std::uint32_t>(j) * wide + static_cast<std::uint32_t>(i);
      const std::uint32_t ne = nw + 1, sw = nw + wide, se = sw + 1;
      const bool falls = std::abs(north[i] - south[i + 1]) <= std::abs(north[i + 1] - south[i]);
      out[0] = nw;
      out[1] = sw;
      out[2] = falls ? se : ne;
      out[3] = falls ? nw : ne;
      out[4] = falls ? se : sw;
      out[5] = falls ? ne : se;
    }
  }
}

void lean_back_rows(const Field& field, const Window& part, Mesh& mesh, const Job& job) {
  const auto wide = static_cast<std::size_t>(part.width);
  parallel_for(job, static_cast<std::size_t>(part.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (std::size_t i = begin * wide; i < end * wide; ++i) {
                   const auto x = static_cast<std::int32_t>(part.x) + static_cast<std::int32_t>(i % wide);
                   const auto z = static_cast<std::int32_t>(part.z) + static_cast<std::int32_t>(i / wide);
                   const glm::vec2 slope = slope_of(mesh.normal[i]);
                   mesh.normal[i] = leaning_back(slope, least_around(field, x, z, slope));
                 }
               });
}

}  // namespace

Mesh grid_mesh(const Field& field, const Window& part, const Array<glm::u8vec4>& colors, Shading shading,
               Job& job) {
  const auto wide = static_cast<std::size_t>(part.width), deep = static_cast<std::size_t>(part.depth);
  job.spend(Resource::triangles, 2 * (wide - 1) * (deep - 1));
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, wide * deep);
  mesh.uv[0] = Array<glm::vec2>(job, wide * deep);
  if (shading == Shading::smooth) mesh.normal = Array<glm::vec3>(job, wide * deep);
  if (!colors.empty()) mesh.color = Array<glm::u8vec4>(job, wide * deep);
  mesh.index.wide = Array<std::uint32_t>(job, 6 * (wide - 1) * (deep - 1));

  const Ground ground(field);
  std::vector<float> steepest(chunk_count(deep, rows_a_chunk), 0.0F);
  parallel_for(job, deep, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    job.check();
    for (std::size_t j = begin; j < end; ++j)
      steepest[chunk] =
          std::max(steepest[chunk], fill_row(ground, part, static_cast<std::int32_t>(j), colors, mesh));
  });
  const std::size_t bands = chunk_count(wide - 1, static_cast<std::size_t>(band));
  parallel_for(job, bands, 1, [&](std::size_t begin, std::size_t, std::size_t) {
    job.check();
    const std::int32_t first = static_cast<std::int32_t>(begin) * band,
                       last = std::min(first + band, part.width - 1);
    fill_band(field, part, first, last, 0, part.depth - 1,
              mesh.index.wide.data() + 6 * static_cast<std::size_t>(first) * (deep - 1));
  });
  mesh.cache_ordered = true;
  if (shading == Shading::upright) {
    make_upright(mesh, job);
  } else if (field.margin > 0 || *std::max_element(steepest.begin(), steepest.end()) > gentle) {
    lean_back_rows(field, part, mesh, job);
  }
  return mesh;
}

Mesh reduced_mesh(const Field& field, Triangulation plan, const Array<glm::u8vec4>& colors,
                  const Coarse& coarse, Job& job) {
  order_for_cache(plan, job);
  const std::size_t count = plan.samples.size();
  const Ground ground(field);
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, count);
  mesh.normal = Array<glm::vec3>(job, count);
  mesh.uv[0] = Array<glm::vec2>(job, count);
  if (!colors.empty()) mesh.color = Array<glm::u8vec4>(job, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const Place at = place_of(plan.samples[i], field.width);
    mesh.position[i] = {ground.x(at.x), field.at(at.x, at.z), ground.z(at.z)};
    mesh.normal[i] = normal_of(coarse.reach > 1 && !on_border(coarse.part, at)
                                   ? wide_slope(field, at, coarse.reach)
                                   : slopes_of(field, at.z).at(at.x));
    mesh.uv[0][i] = {ground.u(at.x), ground.v(at.z)};
    if (!colors.empty()) mesh.color[i] = colors[plan.samples[i]];
  }
  mesh.index.wide = std::move(plan.index);
  mesh.cache_ordered = true;
  if (coarse.shading == Shading::upright) {
    make_upright(mesh, job);
  } else {
    lean_back(mesh, job);
  }
  return mesh;
}

Array<std::uint32_t> border_samples(const Field& field, const Job& job) {
  Array<std::uint32_t> all(job);
  const auto wide = static_cast<std::uint32_t>(field.width), deep = static_cast<std::uint32_t>(field.depth);
  all.reserve(std::size_t{2} * (wide + deep));
  for (std::uint32_t z = 0; z < deep; ++z) {
    for (std::uint32_t x = 0; x < wide; x += z == 0 || z == deep - 1 ? 1 : wide - 1)
      all.push_back(z * wide + x);
  }
  return all;
}

Mesh walls(const Field& field, const Array<std::uint32_t>& samples, const WallPlan& plan, Job& job) {
  const std::int32_t east = field.width - 1, south = field.depth - 1;
  struct Side {
    glm::vec3 outward;
    bool along_x, forward;  ///< how the border runs with the ground on its left, seen from above
    std::int32_t line;
  };
  // Counter-clockwise from above: south-west to south-east, up the east, back along the north, down the west.
  const std::array<Side, 4> sides{{{{0, 0, 1}, true, true, south},
                                   {{1, 0, 0}, false, false, east},
                                   {{0, 0, -1}, true, false, 0},
                                   {{-1, 0, 0}, false, true, 0}}};
  const Ground ground(field);
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t i : {a, b, c}) mesh.index.wide.push_back(i);
  };
  std::vector<glm::vec3> foot;
  for (const Side& side : sides) {
    std::vector<Place> line;
    for (const std::uint32_t sample : samples) {
      const Place at = place_of(sample, field.width);
      if ((side.along_x ? at.z : at.x) == side.line) line.push_back(at);
    }
    std::sort(line.begin(), line.end(), [&](Place a, Place b) {
      const std::int32_t difference = side.along_x ? a.x - b.x : a.z - b.z;
      return side.forward ? difference < 0 : difference > 0;
    });
    job.spend(Resource::triangles, 2 * (line.size() - 1) + (plan.closed ? line.size() - 1 : 0));
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (const Place at : line) {
      const glm::vec3 top(ground.x(at.x), field.at(at.x, at.z), ground.z(at.z));
      const float down = plan.closed ? plan.floor : top.y - static_cast<float>(plan.depth);
      mesh.position.push_back(top);
      mesh.position.push_back({top.x, down, top.z});
      mesh.normal.push_back(side.outward);
      mesh.normal.push_back(side.outward);
      if (!(at == line.back())) foot.push_back({top.x, down, top.z});
    }
    for (std::uint32_t i = 0; i + 1 < line.size(); ++i) {
      const std::uint32_t a = first + 2 * i;
      quad(a, a + 1, a + 2);
      quad(a + 2, a + 1, a + 3);
    }
  }
  if (plan.closed) {
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    const auto count = static_cast<std::uint32_t>(foot.size());
    for (const glm::vec3& at : foot) mesh.position.push_back(at);
    mesh.position.push_back({0, plan.floor, 0});
    for (std::uint32_t i = 0; i <= count; ++i) mesh.normal.push_back({0, -1, 0});
    for (std::uint32_t i = 0; i < count; ++i) quad(first + i, first + count, first + (i + 1) % count);
  }
  return mesh;
}

Mesh sheet(const Field& field, float level, Job& job) {
  job.spend(Resource::triangles, 2);
  const Ground ground(field);
  const std::int32_t east = field.width - 1, south = field.depth - 1;
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job, 4, glm::vec3(0, 1, 0));
  mesh.index.wide = Array<std::uint32_t>(job);
  for (const Place at : {Place{0, 0}, Place{0, south}, Place{east, south}, Place{east, 0}})
    mesh.position.push_back({ground.x(at.x), level, ground.z(at.z)});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(i);
  return mesh;
}

}  // namespace seedmesh::terrain
