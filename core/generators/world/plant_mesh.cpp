#include "core/generators/world/plant_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/math.h"
#include "core/generators/world/asset.h"
#include "core/generators/world/palette.h"

namespace seedmesh::world {
namespace {

using Rgba = std::array<std::uint8_t, 4>;
constexpr double greatest_size = 1.3;

struct Ring {
  double radius = 0, height = 0;
};

/// Surfaces of revolution and blades, with one colour for each part.
class Builder {
 public:
  explicit Builder(std::uint64_t key) : rng_(key) {}

  /// Rings from low to high about an axis; `uneven` displaces the vertices of closed crowns.
  void revolve(const std::vector<Ring>& rings, int sides, const Rgba& color, double uneven = 0,
               const glm::dvec2& at = {0, 0}) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const Ring& low = rings[k == 0 ? 0 : k - 1];
      const Ring& high = rings[k + 1 == rings.size() ? k : k + 1];
      const glm::dvec2 out = normal_of(low, high);
      const double shade = 0.72 + 0.28 * static_cast<double>(k) / static_cast<double>(rings.size());
      for (int side = 0; side < sides; ++side) {
        const math::SinCos turn =
            math::sincos_degrees(360.0 * (side + 0.5 * static_cast<double>(k % 2)) / sides);
        const double radius = rings[k].radius * (1 + uneven * (rng_.unit() - 0.5));
        add({at.x + radius * turn.cos, rings[k].height * (1 + 0.3 * uneven * (rng_.unit() - 0.5)),
             at.y + radius * turn.sin},
            {out.x * turn.cos, out.y, out.x * turn.sin}, shaded(color, shade));
      }
    }
    add_bands(first, static_cast<int>(rings.size()), sides);
  }

  /// A part of a crown: an uneven ellipsoid, darker below. Normals turn out of the crown, whose middle is at the height
  /// `heart`, so that its parts are shaded as one body.
  void lobe(const glm::dvec3& middle, const glm::dvec3& radius, double heart, int rings, int sides,
            const Rgba& color) {
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (int k = 0; k < rings; ++k) {
      const double t = (k + 0.06) / (rings - 0.88);
      const math::SinCos rise = math::sincos_degrees(180 * t - 90);
      for (int side = 0; side < sides; ++side) {
        const math::SinCos turn = math::sincos_degrees(360.0 * (side + 0.5 * (k % 2)) / sides);
        const glm::dvec3 way(rise.cos * turn.cos, rise.sin, rise.cos * turn.sin);
        const glm::dvec3 p = middle + way * radius * rng_.uniform(0.82, 1.1);
        const glm::dvec3 out = math::unit(p - glm::dvec3(0, heart, 0), {0, 1, 0});
        const double shade = (0.5 + 0.42 * t) * rng_.uniform(0.86, 1.08);
        add(p, math::unit(way + out * 0.8, {0, 1, 0}), shaded(color, shade));
      }
    }
    add_bands(first, rings, sides);
  }

  /// A bent leaf from `base`, outwards by `reach` and down by `drop`, seen from both sides.
  void blade(double base, double turn, double reach, double drop, double width, const Rgba& color) {
    const math::SinCos way = math::sincos_degrees(turn);
    const glm::dvec3 out(way.cos, 0, way.sin), side(-way.sin, 0, way.cos);
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (int k = 0; k < 4; ++k) {
      const double t = k / 3.0, half = width * (k == 0 ? 0.4 : k == 3 ? 0.1 : 1) / 2;
      const glm::dvec3 middle = out * (reach * t) + glm::dvec3(0, base + drop * (0.6 * t - 1.6 * t * t), 0);
      const glm::dvec3 up = glm::dvec3(0, 1, 0) + out * (t * 0.8);
      for (const double s : {-1.0, 1.0}) add(middle + side * (s * half), up, shaded(color, 0.8 + 0.2 * t));
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = first + 2 * k;
      for (const std::uint32_t corner : {a, a + 1, a + 2, a + 1, a + 3, a + 2}) indices_.push_back(corner);
      for (const std::uint32_t corner : {a, a + 2, a + 1, a + 1, a + 2, a + 3}) indices_.push_back(corner);
    }
  }

  PlantFile file() const {
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
    for (std::size_t k = 0; k < positions_.size(); ++k) {
      char vertex[plant_vertex_bytes];
      std::memcpy(vertex, &positions_[k], 12);
      for (int axis = 0; axis < 3; ++axis) {
        vertex[12 + axis] = static_cast<char>(math::to_int32(std::floor(normals_[k][axis] * 127 + 0.5)));
      }
      vertex[15] = 0;
      std::memcpy(vertex + 16, colors_[k].data(), 4);
      file.bytes.append(vertex, sizeof vertex);
    }
    for (const std::uint32_t index : indices_) {
      file.bytes += static_cast<char>(index & 255U);
      file.bytes += static_cast<char>(index >> 8U);
    }
    file.bytes.resize((file.bytes.size() + 3) & ~std::size_t{3});
    return file;
  }

 private:
  /// Triangles between rings of vertices from low to high.
  void add_bands(std::uint32_t first, int rings, int sides) {
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
  static glm::dvec2 normal_of(const Ring& low, const Ring& high) {
    const double rise = high.height - low.height, narrowing = low.radius - high.radius;
    const double length = std::sqrt(rise * rise + narrowing * narrowing);
    return length > 0 ? glm::dvec2(rise, narrowing) / length : glm::dvec2(0, 1);
  }
  static Rgba shaded(const Rgba& color, double by) {
    Rgba out = color;
    for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<std::uint8_t>(math::to_int32(color[k] * by));
    return out;
  }
  void add(const glm::dvec3& position, const glm::dvec3& normal, const Rgba& color) {
    // + 0 turns -0 into 0
    positions_.push_back(glm::vec3(position) + 0.0F);
    normals_.push_back(math::unit(glm::dvec3(normal), {0, 1, 0}));
    colors_.push_back(color);
  }

  Rng rng_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::dvec3> normals_;
  std::vector<Rgba> colors_;
  std::vector<std::uint32_t> indices_;
};

void add_form(Builder& builder, const WorldClass& plant) {
  const double h = plant.height;
  const Rgba leaf = linear_color(plant.color), stem = linear_color(plant.stem);
  switch (plant.form) {
    case WorldForm::conifer:
      builder.revolve({{0.022 * h, -0.02 * h}, {0.016 * h, 0.3 * h}}, 5, stem);
      for (int k = 0; k < 6; ++k) {
        const double low = (0.1 + 0.135 * k) * h, r = (0.2 - 0.029 * k) * h;
        builder.revolve({{0.25 * r, low + 0.05 * h}, {r, low}, {0.01 * h, low + (k < 5 ? 0.2 : 0.215) * h}},
                        7, leaf, 0.35);
      }
      return;
    case WorldForm::broadleaf:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.02 * h, 0.25 * h}, {0.018 * h, 0.45 * h}}, 6, stem);
      builder.lobe({0, 0.69 * h, 0}, {0.29 * h, 0.28 * h, 0.29 * h}, 0.5 * h, 5, 7, leaf);
      for (int k = 0; k < 3; ++k) {
        const math::SinCos turn = math::sincos_degrees(120.0 * k + 20);
        builder.lobe({0.2 * h * turn.cos, (0.49 + 0.05 * k) * h, 0.2 * h * turn.sin},
                     {0.22 * h, 0.19 * h, 0.22 * h}, 0.5 * h, 4, 6, leaf);
      }
      return;
    case WorldForm::palm:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.018 * h, 0.5 * h}, {0.016 * h, 0.88 * h}}, 6, stem);
      for (int k = 0; k < 11; ++k) {
        builder.blade(0.87 * h, 360.0 * k / 11, (0.3 + 0.06 * (k % 3)) * h, (0.22 - 0.1 * (k % 3)) * h,
                      0.09 * h, leaf);
      }
      return;
    case WorldForm::shrub:
      builder.lobe({0, 0.45 * h, 0}, {0.42 * h, 0.44 * h, 0.42 * h}, 0.2 * h, 4, 7, leaf);
      for (int k = 0; k < 2; ++k) {
        const double side = k == 0 ? 0.3 : -0.28;
        builder.lobe({side * h, 0.3 * h, 0.12 * h * (k - 0.5)}, {0.28 * h, 0.3 * h, 0.28 * h}, 0.2 * h, 4, 6,
                     leaf);
      }
      return;
    case WorldForm::cactus:
      builder.revolve({{0.07 * h, -0.02 * h}, {0.085 * h, 0.5 * h}, {0.06 * h, 0.93 * h}, {0.005 * h, h}}, 8,
                      leaf, 0.06);
      for (int k = 0; k < 2; ++k) {
        const double low = (0.3 + 0.15 * k) * h;
        builder.revolve({{0.02 * h, low},
                         {0.05 * h, low + 0.06 * h},
                         {0.045 * h, low + 0.3 * h},
                         {0.004 * h, low + 0.36 * h}},
                        6, leaf, 0.06, {(k == 0 ? 0.14 : -0.13) * h, 0.03 * h});
      }
      return;
    case WorldForm::fungus:
      builder.revolve({{0.09 * h, -0.02 * h}, {0.06 * h, 0.5 * h}, {0.05 * h, 0.8 * h}}, 7, stem, 0.08);
      builder.revolve({{0.04 * h, 0.74 * h},
                       {0.4 * h, 0.66 * h},
                       {0.36 * h, 0.8 * h},
                       {0.2 * h, 0.94 * h},
                       {0.005 * h, h}},
                      12, leaf, 0.08);
      return;
  }
}

/// The outline of a plant in few triangles.
void add_simple_form(Builder& builder, const WorldClass& plant) {
  const double h = plant.height;
  const Rgba leaf = linear_color(plant.color), stem = linear_color(plant.stem);
  switch (plant.form) {
    case WorldForm::conifer:
      builder.revolve({{0.02 * h, -0.02 * h}, {0.018 * h, 0.2 * h}}, 3, stem);
      builder.revolve({{0.05 * h, 0.1 * h}, {0.19 * h, 0.16 * h}, {0.01 * h, h}}, 5, leaf, 0.2);
      return;
    case WorldForm::broadleaf:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.02 * h, 0.4 * h}}, 3, stem);
      builder.lobe({0, 0.6 * h, 0}, {0.37 * h, 0.36 * h, 0.37 * h}, 0.5 * h, 4, 6, leaf);
      return;
    case WorldForm::palm:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.016 * h, 0.88 * h}}, 3, stem);
      builder.revolve({{0.3 * h, 0.8 * h}, {0.2 * h, 0.93 * h}, {0.01 * h, h}}, 5, leaf, 0.4);
      return;
    case WorldForm::shrub:
      builder.lobe({0, 0.45 * h, 0}, {0.48 * h, 0.44 * h, 0.48 * h}, 0.2 * h, 3, 6, leaf);
      return;
    case WorldForm::cactus:
      builder.revolve({{0.07 * h, -0.02 * h}, {0.08 * h, 0.6 * h}, {0.005 * h, h}}, 4, leaf);
      return;
    case WorldForm::fungus:
      builder.revolve({{0.09 * h, -0.02 * h}, {0.05 * h, 0.8 * h}}, 4, stem);
      builder.revolve({{0.05 * h, 0.7 * h}, {0.4 * h, 0.68 * h}, {0.2 * h, 0.94 * h}, {0.005 * h, h}}, 6,
                      leaf);
      return;
  }
}

}  // namespace

std::string hash_of(const std::string& bytes) {
  std::uint64_t hash = mix(bytes.size());
  for (const char c : bytes) hash = mix(hash ^ static_cast<unsigned char>(c)) + 0x9E3779B97F4A7C15U;
  std::string text(16, '0');
  for (std::size_t k = 0; k < 16; ++k) text[k] = "0123456789abcdef"[(hash >> (60 - 4 * k)) & 15U];
  return text;
}

PlantFile plant_file(const World& world, int plant_class, PlantForm form) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  Builder builder(key_at(key_at(0x464F524DU, static_cast<std::uint64_t>(plant.form)),
                         static_cast<std::uint64_t>(plant_class)));
  switch (form) {
    case PlantForm::whole:
      add_form(builder, plant);
      break;
    case PlantForm::simple:
      add_simple_form(builder, plant);
      break;
  }
  PlantFile file = builder.file();
  file.hash = hash_of(file.bytes);
  return file;
}

double crown_width(const WorldClass& plant) {
  switch (plant.form) {
    case WorldForm::conifer:
      return 0.4 * plant.height;
    case WorldForm::broadleaf:
      return 0.8 * plant.height;
    case WorldForm::palm:
      return 0.7 * plant.height;
    case WorldForm::shrub:
      return 0.9 * plant.height;
    case WorldForm::cactus:
      return 0.16 * plant.height;
    case WorldForm::fungus:
      return 0.7 * plant.height;
  }
  return 0;
}

PlantExtent plant_extent(double height) {
  const double tallest = height * greatest_size;
  return {widest_plant * tallest, plant_depth + deepest_root * tallest};
}

std::vector<double> plant_tops(const World& world) {
  std::vector<double> tops;
  for (const WorldClass& plant : world.params.plants) {
    double top = plant.height;  // a model has the height of its class
    if (!plant.model || !world.make_asset) {
      const int number = static_cast<int>(tops.size());
      for (const PlantForm form : {PlantForm::whole, PlantForm::simple})
        top = std::max(top, static_cast<double>(plant_file(world, number, form).high[1]));
    }
    tops.push_back(greatest_size * top - plant_depth);
  }
  return tops;
}

PlantExtent plant_extent(const World& world) {
  PlantExtent extent;
  if (!world.has(Layer::plants)) return extent;
  double tallest = 0;
  for (const WorldClass& plant : world.params.plants) tallest = std::max(tallest, plant.height);
  if (!world.params.plants.empty()) extent = plant_extent(tallest);
  extent.across = std::ceil(extent.across);  // whole metres, so that sums with borders are exact
  return extent;
}

}  // namespace seedmesh::world
