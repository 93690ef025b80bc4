#include "core/generators/terrain/ground_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/base/quick_math.h"
#include "core/base/rng.h"
#include "core/generators/terrain/box_mapping.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/noise.h"
#include "core/texture/wall.h"

namespace seedmesh::terrain {
namespace {

// In the order of GroundClasses::Kind.
constexpr std::array<const char*, 6> names{"grass", "soil", "rock", "scree", "sand", "snow"};
// Classes of a smaller share of the field are left to the others, since each has textures of its own.
constexpr float least_share = 0.01F;
constexpr std::int32_t most_rows = 256;
// Vertices whose noise is evaluated together, so that its lattices are set up once for all of them.
constexpr std::size_t vertices_a_chunk = 2048;
// Bare rock is steeper than loose stones lie (35 degrees), by this much at the borders between both.
constexpr float scree_slope = 0.7F, rock_slope = 0.95F;

float ease(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

// Low shrubs and heather cover patches of meadows. The noise is the same in all tiles of a world.
constexpr int shrub_octaves = 3;
constexpr double shrub_cells = 6, shrub_gain = 0.7;
constexpr std::uint64_t shrub_key = 0x5348'5255;
// Tussocks and boulders that are smaller than the squares of the mesh tilt its normals, in cells and by class.
constexpr double bump_cells = 2.3;
constexpr std::uint64_t bump_keys[] = {0x4255'4D58, 0x4255'4D5A};
constexpr float bumps[] = {0.28F, 0.24F, 0.38F, 0.3F, 0.06F, 0.08F};
constexpr glm::vec3 shrub_color{0.55F, 0.53F, 0.5F};

/// The factor of a vertex colour by shrubs, for a noise value and the share of grass.
glm::vec3 shrubs(double noise, float grass) {
  const float share = grass * ease(-0.05F, 0.25F, static_cast<float>(noise));
  return glm::vec3(1) + (shrub_color - 1.0F) * share;
}

/// Gives vertices the normals of the mesh again where others are behind one of their faces.
void restore_turned_off(const Mesh& mesh, Array<glm::vec3>& normals, const Job& job) {
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    if (i % 12'288 == 0) job.check();
    const std::array<std::uint32_t, 3> at{mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
    const glm::vec3& a = mesh.position[at[0]];
    const glm::vec3 across = glm::cross(mesh.position[at[1]] - a, mesh.position[at[2]] - a);
    for (const std::uint32_t v : at) {
      if (glm::dot(across, normals[v]) <= 0) normals[v] = mesh.normal[v];
    }
  }
}

/// The factor of a vertex colour: plants are yellow on dry ground and dark on wet ground, by slow noise and from
/// vertex to vertex, so that the land has detail where its textures are too small to be seen.
glm::vec3 varied(const Site& site, std::uint64_t key) {
  constexpr glm::vec3 dry{1.18F, 1.04F, 0.88F}, wet{0.8F, 0.9F, 0.86F};
  const float share = std::clamp(0.5F + 0.6F * site.patch, 0.0F, 1.0F);
  const float own = 0.91F + 0.18F * static_cast<float>(key >> 40U) * 0x1p-24F;
  return (wet + (dry - wet) * share) * own;
}

}  // namespace

GroundClasses::GroundClasses(PaletteName palette, const Field& field, const Window& world, const Sites& sites,
                             const GroundColors& colors, const Material& plain, Model& model)
    : palette_(palette), field_(field), world_(world), colors_(colors) {
  Shares all;
  float count = 0;
  const std::int32_t step_x = 1 + (field.width - 1) / most_rows, step_z = 1 + (field.depth - 1) / most_rows;
  for (std::int32_t z = 0; z < field.depth; z += step_z) {
    for (std::int32_t x = 0; x < field.width; x += step_x) {
      const Shares own = shares(sites.at(x, z));
      ++all.of[std::max_element(std::begin(own.of), std::end(own.of)) - std::begin(own.of)];
      ++count;
    }
  }
  for (int i = 0; i < kind_count; ++i) {
    if (all.of[i] < least_share * count) continue;
    Material material = plain;
    const std::string kind = std::string(names[static_cast<std::size_t>(i)]) + "_ground";
    material.name = kind;
    material.recipe.kind = kind;
    for (TextureUse* use : {&material.base_color_texture, &material.normal_texture,
                            &material.metallic_roughness_texture, &material.occlusion_texture})
      use->uv_set = 1;
    used_.push_back(
        {static_cast<Kind>(i), add_material(model, std::move(material)), 1 / texture::grey_of(kind)});
  }
}

GroundClasses::Shares GroundClasses::shares(const Site& site) const {
  const Cover cover = colors_.cover(site);
  const float steep = ease(scree_slope, rock_slope, site.slope + 0.12F * site.patch);
  Shares all;
  const auto lay = [&all](Kind kind, float share) { all.of[kind] += share; };
  const auto lay_stone = [&](float share) {
    lay(rock, share * steep);
    lay(scree, share * (1 - steep));
  };
  switch (palette_) {
    case PaletteName::desert:
      lay(sand, cover.grass + cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::arctic:
      lay(snow, cover.grass + cover.snow + cover.sand);
      lay_stone(cover.rock);
      break;
    case PaletteName::volcanic:
    case PaletteName::moon:
    case PaletteName::stone:
      lay(soil, cover.sand + cover.grass);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::mossy: {
      // Between moss and herbs, the floor of a forest is litter.
      const float litter = ease(-0.3F, 0.3F, site.patch);
      lay(grass, cover.grass * (1 - litter));
      lay(soil, cover.grass * litter + cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    }
    case PaletteName::tropical:
      lay(grass, cover.grass);
      lay(sand, cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::alpine:
      lay(grass, cover.grass);
      lay(snow, cover.snow);
      lay(scree, cover.sand);
      lay_stone(cover.rock);
      break;
    case PaletteName::grey:
    case PaletteName::none:
      lay(soil, cover.sand + cover.grass + cover.snow);
      lay_stone(cover.rock);
  }
  return all;
}

std::size_t GroundClasses::use_of(const Shares& shares) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < used_.size(); ++i) {
    if (shares.of[used_[i].kind] > shares.of[used_[best].kind]) best = i;
  }
  return best;
}

std::vector<Primitive> GroundClasses::divide(const Mesh& mesh, const Sites& sites, const Job& job) const {
  const double west = -(field_.width - 1) / 2.0 * field_.cell,
               north = -(field_.depth - 1) / 2.0 * field_.cell;
  Array<Shares> own(job, mesh.position.size());
  Array<glm::vec3> factors(job, own.size()), normals(job, own.size());
  NoisePlan patches;
  patches.octaves = shrub_octaves;
  patches.amplitude = 1;
  patches.gain = shrub_gain;
  patches.wavelength = shrub_cells * field_.cell;
  NoisePlan bump;
  bump.octaves = 1;
  bump.amplitude = 1;
  bump.wavelength = bump_cells * field_.cell;
  parallel_for(job, own.size(), vertices_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    std::vector<Site> at;
    std::vector<std::uint64_t> keys;
    std::vector<double> east, south;
    for (std::size_t v = begin; v < end; ++v) {
      const glm::dvec3 p = mesh.position[v];
      const std::int32_t x = std::clamp(math::to_int32((p.x - west) / field_.cell + 0.5), 0,
                                        field_.width - 1),
                         z = std::clamp(math::to_int32((p.z - north) / field_.cell + 0.5), 0,
                                        field_.depth - 1);
      at.push_back(sites.at(x, z));
      keys.push_back(
          key_at(static_cast<std::uint64_t>(world_.x + x), static_cast<std::uint64_t>(world_.z + z)));
      east.push_back(static_cast<double>(world_.x + x) * field_.cell);
      south.push_back(static_cast<double>(world_.z + z) * field_.cell);
    }
    const auto noise = [&](const NoisePlan& plan, std::uint64_t name) {
      std::vector<double> values(at.size());
      noise_in_plane(plan, east, south, Rng(name), values.data());
      return values;
    };
    const std::vector<double> shrub = noise(patches, shrub_key), tilt_x = noise(bump, bump_keys[0]),
                              tilt_z = noise(bump, bump_keys[1]);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::size_t v = begin + i;
      own[v] = shares(at[i]);
      factors[v] = varied(at[i], keys[i]) * shrubs(shrub[i], own[v].of[grass]);
      float rough = 0;
      for (int k = 0; k < kind_count; ++k) rough += bumps[k] * own[v].of[k];
      const glm::vec3 tilt{static_cast<float>(tilt_x[i]), 0, static_cast<float>(tilt_z[i])};
      normals[v] = math::quick_unit(mesh.normal[v] + rough * tilt, mesh.normal[v]);
    }
  });
  restore_turned_off(mesh, normals, job);
  std::vector<BoxMapped> parts;
  for (const Used& used : used_)
    parts.emplace_back(mesh, VertexLooks{factors.span(), normals.span()}, used.lighter, job);
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    if (i % 12'288 == 0) job.check();
    const std::array<std::uint32_t, 3> at{mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
    Shares sum;
    for (int k = 0; k < kind_count; ++k) sum.of[k] = own[at[0]].of[k] + own[at[1]].of[k] + own[at[2]].of[k];
    parts[use_of(sum)].add(at);
  }
  std::vector<Primitive> primitives;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (parts[k].mesh.position.empty()) continue;
    parts[k].mesh.cache_ordered = true;
    primitives.push_back({std::move(parts[k].mesh), used_[k].material, {}});
  }
  return primitives;
}

}  // namespace seedmesh::terrain
