#include "core/generators/world/plant_builder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/math.h"

namespace seedmesh::world {
namespace {

Rgba shaded(const Rgba& color, double by) {
  Rgba out = color;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(math::to_int32(std::min(255.0, color[k] * by)));
  return out;
}

glm::dvec2 normal_of(const PlantRing& low, const PlantRing& high) {
  const double rise = high.height - low.height, narrowing = low.radius - high.radius;
  const double length = std::sqrt(rise * rise + narrowing * narrowing);
  return length > 0 ? glm::dvec2(rise, narrowing) / length : glm::dvec2(0, 1);
}

glm::dvec2 in_cell(const TextureCell& cell, double u, double v) {
  return {cell.left + u * (cell.right - cell.left), cell.top + v * (cell.bottom - cell.top)};
}

/// Goes up and down again around a closed surface, so that its first and its last side meet.
double around(int side, int sides) { return 1 - std::abs(2.0 * side / sides - 1); }

/// A normal, turned to the front of a face where it is not.
glm::dvec3 before_face(const glm::dvec3& normal, const glm::dvec3& face) {
  constexpr double least = 0.2;
  const double cosine = glm::dot(normal, face);
  return cosine >= least ? normal : math::unit(normal + (least - cosine) * face, face);
}

bool is_inside(const CrownPart& part, const glm::dvec3& p) {
  constexpr double share = 0.8;  // of the radius
  const glm::dvec3 d = (p - part.middle) / part.radius;
  return glm::dot(d, d) < share;
}

}  // namespace

void PlantBuilder::revolve(const std::vector<PlantRing>& rings, int sides, const Rgba& color,
                           const TextureCell& cell, double uneven, const glm::dvec2& at) {
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const PlantRing& low = rings[k == 0 ? 0 : k - 1];
    const PlantRing& high = rings[k + 1 == rings.size() ? k : k + 1];
    const glm::dvec2 out = normal_of(low, high);
    const double share = static_cast<double>(k) / static_cast<double>(rings.size());
    for (int side = 0; side < sides; ++side) {
      const math::SinCos turn =
          math::sincos_degrees(360.0 * (side + 0.5 * static_cast<double>(k % 2)) / sides);
      const double radius = rings[k].radius * (1 + uneven * (rng_.unit() - 0.5));
      add({at.x + radius * turn.cos, rings[k].height * (1 + 0.3 * uneven * (rng_.unit() - 0.5)),
           at.y + radius * turn.sin},
          {out.x * turn.cos, out.y, out.x * turn.sin}, shaded(color, 0.72 + 0.28 * share),
          in_cell(cell, around(side, sides), share));
    }
  }
  add_bands(first, static_cast<int>(rings.size()), sides);
}

void PlantBuilder::lobe(const CrownPart& part, double heart, int rings, int sides, const Rgba& color) {
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (int k = 0; k < rings; ++k) {
    const double t = (k + 0.06) / (rings - 0.88);
    const math::SinCos rise = math::sincos_degrees(180 * t - 90);
    for (int side = 0; side < sides; ++side) {
      const math::SinCos turn = math::sincos_degrees(360.0 * (side + 0.5 * (k % 2)) / sides);
      const glm::dvec3 way(rise.cos * turn.cos, rise.sin, rise.cos * turn.sin);
      const glm::dvec3 p = part.middle + way * part.radius * rng_.uniform(0.82, 1.1);
      const glm::dvec3 out = math::unit(p - glm::dvec3(0, heart, 0), {0, 1, 0});
      const double shade = (0.42 + 0.36 * t) * rng_.uniform(0.86, 1.08);
      add(p, math::unit(way + out * 0.8, {0, 1, 0}), shaded(color, shade),
          in_cell(dense_leaves, around(side, sides), t));
    }
  }
  add_bands(first, rings, sides);
}

void PlantBuilder::leaves(const std::vector<CrownPart>& crown, double heart, int count, double half,
                          const Rgba& color) {
  constexpr double golden_angle = 137.50776405003785;  // degrees; spreads directions evenly
  constexpr double tilt = 0.45;                        // of cards against the surface
  const CrownPart& own = crown.back();
  for (int k = 0; k < count; ++k) {
    const double height = 1 - 2 * (k + 0.5) / count, level = std::sqrt(1 - height * height);
    const math::SinCos turn = math::sincos_degrees(golden_angle * k);
    const glm::dvec3 way(level * turn.cos, height, level * turn.sin);
    const glm::dvec3 middle = own.middle + way * own.radius * rng_.uniform(0.86, 1.0);
    glm::dvec3 aside(0);
    for (const int axis : {2, 1, 0}) aside[axis] = rng_.uniform(-tilt, tilt);
    const double size = half * rng_.uniform(0.8, 1.15), roll = 360 * rng_.unit();
    const double light = rng_.uniform(0.86, 1.1);
    const bool is_hidden = std::any_of(crown.begin(), crown.end() - 1,
                                       [&](const CrownPart& part) { return is_inside(part, middle); });
    if (is_hidden) continue;
    // cards hang below a crown, because their lower sides are dark
    const glm::dvec3 hung(way.x, std::max(way.y, -0.3), way.z);
    const glm::dvec3 face = math::unit(hung / own.radius * own.radius.y + aside, hung);
    const glm::dvec3 level_side = math::unit(glm::cross(glm::dvec3(0, 1, 0), face), glm::dvec3(1, 0, 0));
    const glm::dvec3 up_side = glm::cross(face, level_side);
    const math::SinCos rolled = math::sincos_degrees(roll);
    const glm::dvec3 right = (level_side * rolled.cos + up_side * rolled.sin) * size,
                     up = glm::cross(face, right);
    std::array<glm::dvec3, 4> corners{middle - right - up, middle + right - up, middle + right + up,
                                      middle - right + up};
    double lowest = 0;
    for (const glm::dvec3& corner : corners) lowest = std::min(lowest, corner.y);
    for (glm::dvec3& corner : corners) corner.y -= lowest;  // onto the ground
    std::array<glm::dvec3, 4> normals;
    std::array<double, 4> shades{};
    const double low = own.middle.y - own.radius.y;
    for (std::size_t c = 0; c < 4; ++c) {
      const glm::dvec3 out = math::unit(corners[c] - glm::dvec3(0, heart, 0), face);
      normals[c] = before_face(math::unit(out + 0.5 * hung + glm::dvec3(0, 0.25, 0), face), face);
      const double t = std::clamp((corners[c].y - low) / (2 * own.radius.y), 0.0, 1.0);
      shades[c] = (0.58 + 0.42 * t) * light;
    }
    add_quad(corners, normals, shades, color, leaf_cluster);
  }
}

void PlantBuilder::branch(double base, double turn, double reach, double drop, const Rgba& color) {
  const math::SinCos way = math::sincos_degrees(turn);
  const glm::dvec3 out(way.cos, 0, way.sin), side(-way.sin, 0, way.cos);
  const double half = 0.42 * reach, roll = rng_.uniform(-0.25, 0.25) * half, light = rng_.uniform(0.85, 1.1);
  const glm::dvec3 from(0, base, 0), to = out * reach + glm::dvec3(0, base - drop, 0);
  const glm::dvec3 aside = side * half + glm::dvec3(0, roll, 0);
  const glm::dvec3 face = math::unit(glm::cross(aside, to - from), {0, 1, 0});
  const glm::dvec3 normal = before_face(math::unit(out * 0.75 + glm::dvec3(0, 0.65, 0), face), face);
  add_quad({from + aside, to + aside, to - aside, from - aside}, {normal, normal, normal, normal},
           {0.6 * light, light, light, 0.6 * light}, color, conifer_branch);
}

void PlantBuilder::blade(double base, double turn, double reach, double drop, double width,
                         const Rgba& color) {
  const math::SinCos way = math::sincos_degrees(turn);
  const glm::dvec3 out(way.cos, 0, way.sin), side(-way.sin, 0, way.cos);
  const auto first = static_cast<std::uint32_t>(positions_.size());
  for (int k = 0; k < 4; ++k) {
    const double t = k / 3.0, half = width * (k == 0 ? 0.4 : 1) / 2;
    const glm::dvec3 middle = out * (reach * t) + glm::dvec3(0, base + drop * (0.6 * t - 1.6 * t * t), 0);
    const glm::dvec3 up = glm::dvec3(0, 1, 0) + out * (t * 0.8);
    for (const double s : {-1.0, 1.0})
      add(middle + side * (s * half), up, shaded(color, 0.8 + 0.2 * t), in_cell(palm_leaf, t, (1 + s) / 2));
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t a = first + 2 * k;
    for (const std::uint32_t corner : {a, a + 1, a + 2, a + 1, a + 3, a + 2}) indices_.push_back(corner);
    for (const std::uint32_t corner : {a, a + 2, a + 1, a + 1, a + 2, a + 3}) indices_.push_back(corner);
  }
}

void PlantBuilder::tuft(int blades, const Group& group, const Rgba& color) {
  for (int k = 0; k < blades; ++k) {
    const double away = group.radius * 0.7 * std::sqrt(rng_.unit()), turn = 360 * rng_.unit();
    const double lean = rng_.uniform(0.2, 0.9), high = group.height * rng_.uniform(0.45, 1.0),
                 light = rng_.uniform(0.8, 1.15), facing = 360 * rng_.unit();
    const math::SinCos way = math::sincos_degrees(turn), across = math::sincos_degrees(facing);
    const glm::dvec3 out(way.cos, 0, way.sin), foot = out * away, side(across.cos, 0, across.sin);
    const double half = 0.035 + 0.05 * high, reach = std::min(lean * high, group.radius - away);
    const glm::dvec3 normal = math::unit(glm::dvec3(0, 1, 0) + out * 0.25, {0, 1, 0});
    const auto first = static_cast<std::uint32_t>(positions_.size());
    add(foot - side * half, normal, shaded(color, 0.62 * light), in_cell(plain_surface, 0, 1));
    add(foot + side * half, normal, shaded(color, 0.62 * light), in_cell(plain_surface, 1, 1));
    add(foot + out * reach + glm::dvec3(0, high, 0), normal, shaded(color, 1.2 * light),
        in_cell(plain_surface, 0.5, 0));
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 1U}) indices_.push_back(first + corner);
  }
}

void PlantBuilder::heads(int count, const Group& group, const Rgba& color) {
  constexpr double half = 0.032;
  for (int k = 0; k < count; ++k) {
    const double away = group.radius * 0.8 * std::sqrt(rng_.unit()), turn = 360 * rng_.unit();
    const double high = group.height * rng_.uniform(0.6, 1.0), light = rng_.uniform(0.85, 1.0);
    const math::SinCos way = math::sincos_degrees(turn);
    const glm::dvec3 middle(away * way.cos, high, away * way.sin), up(0, 1, 0);
    const glm::dvec3 x(half * way.cos, 0.3 * half, half * way.sin),
        z(-half * way.sin, -0.2 * half, half * way.cos);
    add_quad({middle - x + z, middle + x + z, middle + x - z, middle - x - z}, {up, up, up, up},
             {light, light, light, light}, color, plain_surface);
  }
}

PlantFile PlantBuilder::file() const {
  PlantFile file;
  file.vertices = static_cast<std::uint32_t>(positions_.size());
  file.indices = static_cast<std::uint32_t>(indices_.size());
  for (int k = 0; k < 3; ++k) {
    file.low[k] = file.high[k] = positions_[0][k];
    for (const glm::vec3& p : positions_) {
      file.low[k] = std::min(file.low[k], p[k]);
      file.high[k] = std::max(file.high[k], p[k]);
    }
  }
  const auto append_word = [&](int word) {
    file.bytes += static_cast<char>(word & 255);
    file.bytes += static_cast<char>(word >> 8);
  };
  for (std::size_t k = 0; k < positions_.size(); ++k) {
    char vertex[plant_vertex_bytes - 4];
    std::memcpy(vertex, &positions_[k], 12);
    for (int axis = 0; axis < 3; ++axis)
      vertex[12 + axis] = static_cast<char>(math::to_int32(std::floor(normals_[k][axis] * 127 + 0.5)));
    vertex[15] = 0;
    std::memcpy(vertex + 16, colors_[k].data(), 4);
    file.bytes.append(vertex, sizeof vertex);
    for (const double coordinate : {coordinates_[k].x, coordinates_[k].y})
      append_word(math::to_int32(std::floor(coordinate * 65535 + 0.5)));
  }
  for (const std::uint32_t index : indices_) append_word(static_cast<int>(index));
  file.bytes.resize((file.bytes.size() + 3) & ~std::size_t{3});
  return file;
}

/// Adds triangles between rings of vertices from low to high.
void PlantBuilder::add_bands(std::uint32_t first, int rings, int sides) {
  const auto count = static_cast<std::uint32_t>(sides);
  for (std::uint32_t k = 0; k + 1 < static_cast<std::uint32_t>(rings); ++k) {
    for (std::uint32_t side = 0; side < count; ++side) {
      const std::uint32_t next = (side + 1) % count, a = first + k * count + side,
                          b = first + k * count + next;
      for (const std::uint32_t corner : {a, a + count, b, b, a + count, b + count})
        indices_.push_back(corner);
    }
  }
}

/// Corners are counter-clockwise from the front; the first has the lower left corner of the cell.
void PlantBuilder::add_quad(const std::array<glm::dvec3, 4>& corners,
                            const std::array<glm::dvec3, 4>& normals, const std::array<double, 4>& shades,
                            const Rgba& color, const TextureCell& cell) {
  const auto a = static_cast<std::uint32_t>(positions_.size());
  for (std::size_t k = 0; k < 4; ++k) {
    add(corners[k], normals[k], shaded(color, shades[k]),
        in_cell(cell, k == 1 || k == 2 ? 1 : 0, k < 2 ? 1 : 0));
  }
  for (const std::uint32_t corner : {a, a + 1, a + 2, a, a + 2, a + 3}) indices_.push_back(corner);
}

void PlantBuilder::add(const glm::dvec3& position, const glm::dvec3& normal, const Rgba& color,
                       const glm::dvec2& coordinates) {
  // + 0 turns -0 into 0
  positions_.push_back(glm::vec3(position) + 0.0F);
  normals_.push_back(math::unit(glm::dvec3(normal), {0, 1, 0}));
  colors_.push_back(color);
  coordinates_.push_back(coordinates);
}

}  // namespace seedmesh::world
