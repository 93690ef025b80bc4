#include "core/generators/terrain/surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/generators/terrain/cache_order.h"
#include "core/generators/terrain/ground.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/square.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 32;
// Squares of a band. Two rows of their samples fit into a cache of 16 vertices.
constexpr std::int32_t band = 6;
// If no step s between neighbours is steeper, no smooth normal faces away from a triangle: 2 s s < 1.
constexpr float gentle = 0.7F;
// The greatest slope product of a normal and a triangle, negated; at 1 they would be at right angles.
constexpr float clear = 0.95F;
// Most vertices for 16-bit indices; the last value restarts a strip.
constexpr std::size_t most_narrow = 65'535;

/// Slopes along a row of the part, from both neighbours where both exist.
struct Slopes {
  const float *here, *north, *south;
  float per_rows, per_cell;
  std::int32_t first, last;  ///< existing columns, margin included
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

/// Returns the normal of a slope v, turned upward until it faces away from no triangle around it: slopes t of
/// triangles satisfy 1 + t.v > 0. `least` is the smallest t.v.
glm::vec3 leaning_back(const glm::vec2& slope, float least) {
  return normal_of(least <= -clear ? slope * (clear / -least) : slope);
}

/// Returns the smallest product of `own` and the slope of a triangle around a sample, for any diagonals of its
/// squares. Squares of the margin count, so that both sides of a border between tiles agree.
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

bool on_border(const Window& part, GridPoint at) {
  return at.x == part.x || at.z == part.z || at.x == part.x + part.width - 1 ||
         at.z == part.z + part.depth - 1;
}

/// Returns the slope between samples at the distance `reach` to each side, as far as they exist.
glm::vec2 wide_slope(const Field& field, GridPoint at, std::int32_t reach) {
  const std::int32_t m = field.margin;
  const std::int32_t west = std::max(at.x - reach, -m), east = std::min(at.x + reach, field.width - 1 + m);
  const std::int32_t north = std::max(at.z - reach, -m), south = std::min(at.z + reach, field.depth - 1 + m);
  const auto per_cell = static_cast<float>(1 / field.cell);
  return {(field.at(east, at.z) - field.at(west, at.z)) * per_cell / static_cast<float>(east - west),
          (field.at(at.x, south) - field.at(at.x, north)) * per_cell / static_cast<float>(south - north)};
}

void make_upright(Mesh& mesh, const Job& job) {
  mesh.normal = Array<glm::vec3>(job, mesh.position.size(), glm::vec3(0, 1, 0));
  mesh.tangent = Array<glm::vec4>(job, mesh.position.size(), glm::vec4(1, 0, 0, 1));
}

/// Writes positions, normals, texture coordinates and colours of one row of a part. Returns the steepest step
/// to a neighbour in the east or south.
SEEDMESH_WIDE float fill_row(const Ground& ground, const Window& part, std::int32_t j,
                             const Array<glm::u8vec4>& colors, Mesh& mesh) {
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
    // The ends are handled separately, so that the loop between them has no branches.
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

/// Writes the triangles of all rows of squares of one band of columns.
template <class Index>
void fill_band(const Field& field, const Window& part, std::int32_t first, std::int32_t last, Index* out) {
  const auto wide = static_cast<std::uint32_t>(part.width);
  const auto left = static_cast<std::int32_t>(part.x), top = static_cast<std::int32_t>(part.z);
  for (std::int32_t j = 0; j < part.depth - 1; ++j) {
    const float* north = field.row(top + j) + left;
    const float* south = field.row(top + j + 1) + left;
    for (std::int32_t i = first; i < last; ++i, out += 6) {
      const std::uint32_t corner = static_cast<std::uint32_t>(j) * wide + static_cast<std::uint32_t>(i);
      const auto nw = static_cast<Index>(corner), ne = static_cast<Index>(corner + 1),
                 sw = static_cast<Index>(corner + wide), se = static_cast<Index>(corner + wide + 1);
      // Without branches, which the processor could not predict.
      const bool falls = falls_to_south_east(north[i], north[i + 1], south[i], south[i + 1]);
      const auto mask = static_cast<Index>(-static_cast<std::int32_t>(falls));
      const auto either = [mask](Index falling, Index rising) {
        return static_cast<Index>(rising ^ ((rising ^ falling) & mask));
      };
      out[0] = nw;
      out[1] = sw;
      out[2] = either(se, ne);
      out[3] = either(nw, ne);
      out[4] = either(se, sw);
      out[5] = either(ne, se);
    }
  }
}

template <class Index>
void fill_triangles(const Field& field, const Window& part, Array<Index>& out, const Job& job) {
  const auto wide = static_cast<std::size_t>(part.width), deep = static_cast<std::size_t>(part.depth);
  out = Array<Index>(job, 6 * (wide - 1) * (deep - 1));
  parallel_for(job, chunk_count(wide - 1, static_cast<std::size_t>(band)), 1,
               [&](std::size_t number, std::size_t, std::size_t) {
                 job.check();
                 const std::int32_t first = static_cast<std::int32_t>(number) * band;
                 fill_band(field, part, first, std::min(first + band, part.width - 1),
                           out.data() + 6 * static_cast<std::size_t>(first) * (deep - 1));
               });
}

/// Applies leaning_back() to normals[i] at columns x + i of row z, with the result of least_around(), except for
/// several columns at once. Slopes of a square in both directions are independent, so the smallest product is
/// the sum of the smallest ones of each direction.
SEEDMESH_WIDE void lean_back_run(const Field& field, std::int32_t x, std::int32_t z, std::size_t count,
                                 glm::vec3* normals) {
  constexpr std::size_t run = 64;
  float own_x[run], own_z[run], length[run];
  const auto per_cell = static_cast<float>(1 / field.cell);
  const auto smaller = [](float a, float b) { return b < a ? b : a; };
  for (std::size_t first = 0; first < count; first += run) {
    const std::size_t many = std::min(run, count - first);
    const std::ptrdiff_t start = x + static_cast<std::ptrdiff_t>(first);
    const float* north = field.row(z - 1) + start;
    const float* here = field.row(z) + start;
    const float* south = field.row(z + 1) + start;
    for (std::size_t i = 0; i < many; ++i) {
      const glm::vec3& normal = normals[first + i];
      own_x[i] = -normal.x / normal.y;
      own_z[i] = -normal.z / normal.y;
    }
    for (std::size_t k = 0; k < many; ++k) {
      const auto i = static_cast<std::ptrdiff_t>(k);
      const auto east = [&](const float* row, std::ptrdiff_t at) {
        return (row[at + 1] - row[at]) * per_cell * own_x[k];
      };
      const auto down = [&](const float* upper, const float* lower, std::ptrdiff_t at) {
        return (lower[at] - upper[at]) * per_cell * own_z[k];
      };
      const float north_west = east(north, i - 1), north_east = east(north, i);
      const float west = east(here, i - 1), towards_east = east(here, i);
      const float south_west = east(south, i - 1), south_east = east(south, i);
      const float up_west = down(north, here, i - 1), up = down(north, here, i),
                  up_east = down(north, here, i + 1);
      const float down_west = down(here, south, i - 1), below = down(here, south, i),
                  down_east = down(here, south, i + 1);
      const float nw = smaller(north_west, west) + smaller(up_west, up);
      const float ne = smaller(north_east, towards_east) + smaller(up, up_east);
      const float sw = smaller(west, south_west) + smaller(down_west, below);
      const float se = smaller(towards_east, south_east) + smaller(below, down_east);
      const float least = smaller(smaller(smaller(nw, ne), smaller(sw, se)), 0.0F);
      const float shorter = clear / -least;
      const float factor = least <= -clear ? shorter : 1.0F;
      own_x[k] *= factor;
      own_z[k] *= factor;
      length[k] = std::sqrt(1 + (own_x[k] * own_x[k] + own_z[k] * own_z[k]));
    }
    for (std::size_t i = 0; i < many; ++i)
      normals[first + i] = {-own_x[i] / length[i], 1 / length[i], -own_z[i] / length[i]};
  }
}

void lean_back_rows(const Field& field, const Window& part, Mesh& mesh, const Job& job) {
  const std::int32_t m = field.margin, left = static_cast<std::int32_t>(part.x);
  const std::int32_t west = left > -m ? 0 : 1, east = left + part.width < field.width + m ? 0 : 1;
  const auto wide = static_cast<std::size_t>(part.width);
  parallel_for(job, static_cast<std::size_t>(part.depth), rows_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 job.check();
                 for (std::size_t j = begin; j < end; ++j) {
                   const std::int32_t z = static_cast<std::int32_t>(part.z) + static_cast<std::int32_t>(j);
                   glm::vec3* normals = mesh.normal.data() + j * wide;
                   const auto by_itself = [&](std::int32_t i) {
                     const glm::vec2 slope = slope_of(normals[i]);
                     normals[i] = leaning_back(slope, least_around(field, left + i, z, slope));
                   };
                   if (z - 1 < -m || z + 1 > field.depth - 1 + m || part.width < 3) {
                     for (std::int32_t i = 0; i < part.width; ++i) by_itself(i);
                     continue;
                   }
                   if (west > 0) by_itself(0);
                   if (east > 0) by_itself(part.width - 1);
                   lean_back_run(field, left + west, z, wide - static_cast<std::size_t>(west + east),
                                 normals + west);
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

  const Ground ground(field);
  std::vector<float> steepest(chunk_count(deep, rows_a_chunk), 0.0F);
  parallel_for(job, deep, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    job.check();
    for (std::size_t j = begin; j < end; ++j) {
      steepest[chunk] =
          std::max(steepest[chunk], fill_row(ground, part, static_cast<std::int32_t>(j), colors, mesh));
    }
  });
  if (wide * deep <= most_narrow) {
    fill_triangles(field, part, mesh.index.small, job);
  } else {
    fill_triangles(field, part, mesh.index.wide, job);
  }
  mesh.cache_ordered = true;
  if (shading == Shading::upright) {
    make_upright(mesh, job);
  } else if (field.margin > 0 || *std::max_element(steepest.begin(), steepest.end()) > gentle) {
    lean_back_rows(field, part, mesh, job);
  }
  return mesh;
}

void turn_normals_up(Mesh& mesh, const Job& job) {
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

Mesh reduced_mesh(const Field& field, Triangulation plan, ColorOf color_of, const CoarseShading& coarse,
                  Job& job) {
  if (!coarse.ordered) order_for_cache(plan, field, job);
  const std::size_t count = plan.samples.size();
  const Ground ground(field);
  Mesh mesh;
  if (color_of) {
    mesh.color = Array<glm::u8vec4>(job, count);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 4096 == 0) job.check();
      mesh.color[i] = color_of(plan.samples[i]);
    }
    color_of = {};
  }
  mesh.position = Array<glm::vec3>(job, count);
  mesh.normal = Array<glm::vec3>(job, count);
  mesh.uv[0] = Array<glm::vec2>(job, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const GridPoint at = grid_point_of(plan.samples[i], field.width);
    mesh.position[i] = {ground.x(at.x), field.at(at.x, at.z), ground.z(at.z)};
    mesh.normal[i] =
        normal_of(coarse.reach > 1 && !on_border(coarse.part, at) ? wide_slope(field, at, coarse.reach)
                                                                  : slopes_of(field, at.z).at(at.x));
    mesh.uv[0][i] = {ground.u(at.x), ground.v(at.z)};
  }
  plan.samples = {};
  mesh.index.wide = std::move(plan.index);
  mesh.cache_ordered = true;
  if (coarse.shading == Shading::upright) {
    make_upright(mesh, job);
  } else {
    turn_normals_up(mesh, job);
  }
  return mesh;
}

}  // namespace seedmesh::terrain
