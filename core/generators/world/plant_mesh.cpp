#include "core/generators/world/plant_mesh.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "core/base/math.h"
#include "core/generators/world/asset.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/plant_builder.h"

namespace seedmesh::world {
namespace {

constexpr double greatest_size = 1.3;

/// The colour of leaves, which a texture darkens.
Rgba leaf_color(const WorldClass& plant, double light = 1) {
  Rgba color = linear_color(plant.color);
  for (std::size_t k = 0; k < 3; ++k) {
    const double brighter = std::min(255.0, light * color[k] / leaf_texture_mean);
    color[k] = static_cast<std::uint8_t>(math::to_int32(brighter));
  }
  return color;
}

/// A crown of several parts: dark bodies of leaves, and clusters of leaves around them.
struct Crown {
  std::vector<CrownPart> parts;
  double heart = 0;  ///< height of its middle
  double half = 0;   ///< half of the side of a cluster
};

void add_crown(PlantBuilder& builder, const Crown& crown, const std::vector<int>& clusters,
               const Rgba& color) {
  constexpr double body = 0.86;  // of the radius
  for (std::size_t k = 0; k < crown.parts.size(); ++k) {
    const CrownPart& part = crown.parts[k];
    const bool is_large = k == 0 && crown.parts.size() > 1;
    builder.lobe({part.middle, body * part.radius}, crown.heart, is_large ? 4 : 3, is_large ? 7 : 6, color);
  }
  for (std::size_t k = 0; k < crown.parts.size(); ++k) {
    std::vector<CrownPart> parts = crown.parts;  // the own one last
    std::swap(parts[k], parts.back());
    builder.leaves(parts, crown.heart, clusters[k], crown.half, color);
  }
}

void add_conifer(PlantBuilder& builder, double h, const Rgba& leaf, const Rgba& stem) {
  constexpr int tiers = 11, branches = 6;
  builder.revolve({{0.022 * h, -0.02 * h}, {0.016 * h, 0.3 * h}}, 5, stem, plain_surface);
  builder.revolve({{0.02 * h, 0.12 * h}, {0.09 * h, 0.16 * h}, {0.055 * h, 0.5 * h}, {0.004 * h, 0.99 * h}},
                  5, leaf, dense_leaves, 0.1);
  for (int tier = 0; tier < tiers; ++tier) {
    const double t = static_cast<double>(tier) / tiers;
    const double reach = (0.045 + 0.19 * (1 - t)) * h;
    for (int k = 0; k < branches; ++k) {
      const double longer = (k + tier) % 2 == 0 ? 1.0 : 0.86;
      builder.branch((0.17 + 0.78 * t + 0.012 * (k % 3)) * h,
                     360.0 * (k + 0.5 * (tier % 2) + 0.13 * tier) / branches, longer * reach,
                     (0.75 - 0.35 * t) * reach, leaf);
    }
  }
}

void add_form(PlantBuilder& builder, const WorldClass& plant) {
  const double h = plant.height;
  const Rgba leaf = leaf_color(plant), stem = linear_color(plant.stem);
  switch (plant.form) {
    case WorldForm::conifer:
      add_conifer(builder, h, leaf, stem);
      return;
    case WorldForm::broadleaf: {
      builder.revolve({{0.03 * h, -0.02 * h}, {0.02 * h, 0.25 * h}, {0.018 * h, 0.45 * h}}, 6, stem,
                      plain_surface);
      Crown crown{{{{0, 0.69 * h, 0}, {0.28 * h, 0.27 * h, 0.28 * h}}}, 0.5 * h, 0.09 * h};
      for (int k = 0; k < 3; ++k) {
        const math::SinCos turn = math::sincos_degrees(120.0 * k + 20);
        crown.parts.push_back({{0.2 * h * turn.cos, (0.49 + 0.05 * k) * h, 0.2 * h * turn.sin},
                               {0.21 * h, 0.18 * h, 0.21 * h}});
      }
      add_crown(builder, crown, {40, 26, 26, 26}, leaf);
      return;
    }
    case WorldForm::palm:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.018 * h, 0.5 * h}, {0.016 * h, 0.88 * h}}, 6, stem,
                      plain_surface);
      for (int k = 0; k < 15; ++k) {
        builder.blade(0.87 * h, 360.0 * k / 15, (0.3 + 0.06 * (k % 3)) * h, (0.22 - 0.1 * (k % 3)) * h,
                      0.15 * h, leaf);
      }
      return;
    case WorldForm::shrub: {
      const Crown crown{{{{0, 0.43 * h, 0}, {0.36 * h, 0.42 * h, 0.36 * h}},
                         {{0.24 * h, 0.26 * h, -0.06 * h}, {0.24 * h, 0.28 * h, 0.24 * h}},
                         {{-0.22 * h, 0.26 * h, 0.06 * h}, {0.24 * h, 0.28 * h, 0.24 * h}}},
                        0.2 * h,
                        0.13 * h};
      add_crown(builder, crown, {26, 14, 14}, leaf);
      return;
    }
    case WorldForm::cactus:
      builder.revolve({{0.07 * h, -0.02 * h}, {0.085 * h, 0.5 * h}, {0.06 * h, 0.93 * h}, {0.005 * h, h}}, 8,
                      linear_color(plant.color), plain_surface, 0.06);
      for (int k = 0; k < 2; ++k) {
        const double low = (0.3 + 0.15 * k) * h;
        builder.revolve({{0.02 * h, low},
                         {0.05 * h, low + 0.06 * h},
                         {0.045 * h, low + 0.3 * h},
                         {0.004 * h, low + 0.36 * h}},
                        6, linear_color(plant.color), plain_surface, 0.06,
                        {(k == 0 ? 0.14 : -0.13) * h, 0.03 * h});
      }
      return;
    case WorldForm::fungus:
      builder.revolve({{0.09 * h, -0.02 * h}, {0.06 * h, 0.5 * h}, {0.05 * h, 0.8 * h}}, 7, stem,
                      plain_surface, 0.08);
      builder.revolve({{0.04 * h, 0.74 * h},
                       {0.4 * h, 0.66 * h},
                       {0.36 * h, 0.8 * h},
                       {0.2 * h, 0.94 * h},
                       {0.005 * h, h}},
                      12, linear_color(plant.color), plain_surface, 0.08);
      return;
  }
}

/// The outline of a plant in few triangles.
void add_simple_form(PlantBuilder& builder, const WorldClass& plant) {
  const double h = plant.height;
  constexpr double light = 1.08;  // crowns of few clusters of leaves are darker
  const Rgba leaf = leaf_color(plant, light), stem = linear_color(plant.stem);
  switch (plant.form) {
    case WorldForm::conifer:
      builder.revolve({{0.02 * h, -0.02 * h}, {0.018 * h, 0.2 * h}}, 3, stem, plain_surface);
      builder.revolve({{0.03 * h, 0.1 * h}, {0.12 * h, 0.16 * h}, {0.005 * h, h}}, 4, leaf, dense_leaves,
                      0.2);
      for (int k = 0; k < 10; ++k) {
        const double t = k / 10.0, reach = (0.06 + 0.17 * (1 - t)) * h;
        builder.branch((0.22 + 0.72 * t) * h, 137.5 * k, reach, 0.6 * reach, leaf);
      }
      return;
    case WorldForm::broadleaf:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.02 * h, 0.4 * h}}, 3, stem, plain_surface);
      add_crown(builder, {{{{0, 0.63 * h, 0}, {0.34 * h, 0.33 * h, 0.34 * h}}}, 0.45 * h, 0.17 * h}, {13},
                leaf);
      return;
    case WorldForm::palm:
      builder.revolve({{0.03 * h, -0.02 * h}, {0.016 * h, 0.88 * h}}, 3, stem, plain_surface);
      builder.revolve({{0.3 * h, 0.8 * h}, {0.2 * h, 0.93 * h}, {0.01 * h, h}}, 5, leaf, dense_leaves, 0.4);
      return;
    case WorldForm::shrub:
      add_crown(builder, {{{{0, 0.43 * h, 0}, {0.36 * h, 0.4 * h, 0.36 * h}}}, 0.2 * h, 0.2 * h}, {8}, leaf);
      return;
    case WorldForm::cactus:
      builder.revolve({{0.07 * h, -0.02 * h}, {0.08 * h, 0.6 * h}, {0.005 * h, h}}, 4,
                      linear_color(plant.color), plain_surface);
      return;
    case WorldForm::fungus:
      builder.revolve({{0.09 * h, -0.02 * h}, {0.05 * h, 0.8 * h}}, 4, stem, plain_surface);
      builder.revolve({{0.05 * h, 0.7 * h}, {0.4 * h, 0.68 * h}, {0.2 * h, 0.94 * h}, {0.005 * h, h}}, 6,
                      linear_color(plant.color), plain_surface);
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
  PlantBuilder builder(key_at(key_at(0x464F524DU, static_cast<std::uint64_t>(plant.form)),
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
