#include "core/generators/building/solid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh::building {

void add_loop(Solid& solid, std::span<const std::uint32_t> corners) {
  solid.loops.push_back(
      {static_cast<std::uint32_t>(solid.corners.size()), static_cast<std::uint32_t>(corners.size())});
  solid.corners.insert(solid.corners.end(), corners.begin(), corners.end());
}

void append(Solid& to, const Solid& from) {
  const auto base = static_cast<std::uint32_t>(to.points.size());
  to.points.insert(to.points.end(), from.points.begin(), from.points.end());
  for (const Face& face : from.faces) {
    Face copy = face;
    copy.first_loop = static_cast<std::uint32_t>(to.loops.size());
    for (const Loop& loop : loops_of(from, face)) {
      std::vector<std::uint32_t> corners;
      for (const std::uint32_t point : points_of(from, loop)) corners.push_back(point + base);
      add_loop(to, corners);
    }
    to.faces.push_back(copy);
  }
}

void add_face(Solid& solid, std::span<const std::uint32_t> corners, bool is_round) {
  solid.faces.push_back({static_cast<std::uint32_t>(solid.loops.size()), 1, is_round});
  add_loop(solid, corners);
}

glm::dvec3 area_vector(const Solid& solid, const Face& face, const glm::dvec3& size) {
  glm::dvec3 sum(0);
  const glm::dvec3 base = solid.points[solid.corners[solid.loops[face.first_loop].first]];
  for (const Loop& loop : loops_of(solid, face)) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const glm::dvec3 a = (solid.points[solid.corners[loop.first + i]] - base) * size;
      const glm::dvec3 b = (solid.points[solid.corners[loop.first + (i + 1) % loop.count]] - base) * size;
      sum += glm::cross(a, b);
    }
  }
  return sum;
}

bool is_inside(const Solid& solid, std::span<const Loop> loops, const glm::dvec3& normal,
               const glm::dvec3& p) {
  int drop = 0;  // the axis nearest to the normal
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[drop])) drop = k;
  }
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  bool inside = false;
  for (const Loop& loop : loops) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const glm::dvec3 &a = solid.points[solid.corners[loop.first + i]],
                       &b = solid.points[solid.corners[loop.first + (i + 1) % loop.count]];
      if ((a[v] > p[v]) == (b[v] > p[v])) continue;
      if (p[u] < a[u] + (b[u] - a[u]) * (p[v] - a[v]) / (b[v] - a[v])) inside = !inside;
    }
  }
  return inside;
}

double area_of(const Solid& solid, const glm::dvec3& size) {
  double sum = 0;
  for (const Face& face : solid.faces) sum += 0.5 * glm::length(area_vector(solid, face, size));
  return sum;
}

double volume_of(const Solid& solid, const glm::dvec3& size) {
  if (!solid.is_closed) return 0;
  double sum = 0;
  for (const Face& face : solid.faces) {
    const glm::dvec3 point = solid.points[solid.corners[solid.loops[face.first_loop].first]] * size;
    sum += glm::dot(point, area_vector(solid, face, size)) / 6;
  }
  return sum;
}

void fit(Solid& solid, glm::dvec3& low, glm::dvec3& extent) {
  low = glm::dvec3(1e300);
  glm::dvec3 high(-1e300);
  for (const glm::dvec3& p : solid.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  if (solid.points.empty()) low = high = glm::dvec3(0);
  extent = high - low;
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] < 1e-12) extent[axis] = 0;
  }
  for (glm::dvec3& p : solid.points) {
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = extent[axis] > 0 ? (p[axis] - low[axis]) / extent[axis] : 0;
  }
}

namespace {

/// Copies a face of `from`, whose points begin at `base` in the solid; `is_reversed` turns it over.
void add_end(Solid& solid, const Solid& from, const Face& face, std::uint32_t base, bool is_reversed) {
  solid.faces.push_back({static_cast<std::uint32_t>(solid.loops.size()), face.loop_count, false});
  for (const Loop& loop : loops_of(from, face)) {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t point : points_of(from, loop)) corners.push_back(point + base);
    if (is_reversed) std::ranges::reverse(corners);
    add_loop(solid, corners);
  }
}

}  // namespace

Solid extruded(const Solid& face, int axis) {
  Solid solid;
  solid.is_closed = true;
  const auto count = static_cast<std::uint32_t>(face.points.size());
  for (const double height : {0.0, 1.0}) {
    for (glm::dvec3 p : face.points) {
      p[axis] = height;
      solid.points.push_back(p);
    }
  }
  for (const Face& each : face.faces) {
    for (const bool is_top : {false, true}) add_end(solid, face, each, is_top ? count : 0, !is_top);
  }
  for (const Loop& loop : face.loops) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      const std::uint32_t a = face.corners[loop.first + i],
                          b = face.corners[loop.first + (i + 1) % loop.count];
      add_face(solid, std::array{a, b, b + count, a + count});
    }
  }
  return solid;
}

Solid tapered(const Solid& face, int axis) {
  Solid solid = face;
  solid.faces.clear();
  solid.loops.clear();
  solid.corners.clear();
  solid.is_closed = true;
  glm::dvec3 middle(0);
  double weight = 0;
  for (const Face& each : face.faces) {  // the centre of gravity, by triangles from one corner
    const glm::dvec3 base = face.points[face.corners[face.loops[each.first_loop].first]];
    for (std::uint32_t l = each.first_loop; l < each.first_loop + each.loop_count; ++l) {
      const Loop& loop = face.loops[l];
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const glm::dvec3 a = face.points[face.corners[loop.first + i]],
                         b = face.points[face.corners[loop.first + (i + 1) % loop.count]];
        const double part = glm::cross(a - base, b - base)[axis];
        middle += part * (a + b + base) / 3.0;
        weight += part;
      }
    }
  }
  if (weight != 0) middle /= weight;
  middle[axis] = 1;
  const auto tip = static_cast<std::uint32_t>(solid.points.size());
  solid.points.push_back(middle);
  for (const Face& each : face.faces) add_end(solid, face, each, 0, true);
  for (const Loop& loop : face.loops) {
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      add_face(solid, std::array{face.corners[loop.first + i],
                                 face.corners[loop.first + (i + 1) % loop.count], tip});
    }
  }
  return solid;
}

Solid square(int axis) {
  Solid solid;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    glm::dvec3 p(0);
    p[u] = a;
    p[v] = b;
    solid.points.push_back(p);
  }
  add_face(solid, std::array{0U, 1U, 2U, 3U});
  return solid;
}

Solid unit_box() { return extruded(square(1), 1); }

namespace {

constexpr std::uint32_t round_sides = 24;

/// A regular polygon on the ground that fills the unit square.
Solid disc() {
  Solid solid;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < round_sides; ++i) {
    const math::SinCos angle = math::sincos_degrees(-360.0 * i / round_sides);
    solid.points.emplace_back(0.5 + 0.5 * angle.cos, 0, 0.5 + 0.5 * angle.sin);
    corners.push_back(i);
  }
  add_face(solid, corners);
  return solid;
}

}  // namespace

Solid cylinder() {
  Solid solid = extruded(disc(), 1);
  for (std::size_t i = 2; i < solid.faces.size(); ++i) solid.faces[i].is_round = true;
  return solid;
}

Solid cone() {
  Solid solid = tapered(disc(), 1);
  for (std::size_t i = 1; i < solid.faces.size(); ++i) solid.faces[i].is_round = true;
  return solid;
}

Solid pyramid() { return tapered(square(1), 1); }

Solid frustum() {
  Solid solid = unit_box();
  for (glm::dvec3& p : solid.points) {
    if (p.y > 0.5) p = {0.25 + 0.5 * p.x, 1, 0.25 + 0.5 * p.z};
  }
  return solid;
}

Solid triangular_prism() {
  Solid face;
  face.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  add_face(face, std::array{0U, 1U, 2U});
  return extruded(face, 2);
}

Solid sphere() {
  constexpr std::uint32_t rings = 12, sides = 24;
  Solid solid;
  solid.is_closed = true;
  for (std::uint32_t r = 1; r < rings; ++r) {
    const math::SinCos polar = math::sincos_degrees(180.0 * r / rings);
    for (std::uint32_t s = 0; s < sides; ++s) {
      const math::SinCos around = math::sincos_degrees(-360.0 * s / sides);
      solid.points.emplace_back(0.5 + 0.5 * polar.sin * around.cos, 0.5 - 0.5 * polar.cos,
                                0.5 + 0.5 * polar.sin * around.sin);
    }
  }
  const auto low = static_cast<std::uint32_t>(solid.points.size());
  solid.points.emplace_back(0.5, 0, 0.5);
  solid.points.emplace_back(0.5, 1, 0.5);
  const auto at = [&](std::uint32_t r, std::uint32_t s) { return r * sides + s % sides; };
  for (std::uint32_t s = 0; s < sides; ++s) {
    add_face(solid, std::array{low, at(0, s + 1), at(0, s)}, true);
    for (std::uint32_t r = 0; r + 2 < rings; ++r)
      add_face(solid, std::array{at(r, s), at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)}, true);
    add_face(solid, std::array{at(rings - 2, s), at(rings - 2, s + 1), low + 1}, true);
  }
  return solid;
}

Solid mirrored(const Solid& solid, unsigned axes) {
  Solid out = solid;
  bool turned = false;
  for (int axis = 0; axis < 3; ++axis) {
    if ((axes >> static_cast<unsigned>(axis) & 1U) == 0) continue;
    turned = !turned;
    double high = 0;
    for (const glm::dvec3& p : out.points) high = std::max(high, p[axis]);
    for (glm::dvec3& p : out.points) p[axis] = high - p[axis];
  }
  if (turned) {
    for (const Loop& loop : out.loops)
      std::reverse(out.corners.begin() + loop.first, out.corners.begin() + loop.first + loop.count);
  }
  return out;
}

}  // namespace seedmesh::building
