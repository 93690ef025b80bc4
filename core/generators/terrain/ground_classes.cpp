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
#include "core/generators/terrain/ground.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/smooth_step.h"
#include "core/texture/wall.h"

namespace seedmesh::terrain {
namespace {

// In the order of GroundShares::Kind.
constexpr std::array<const char*, 7> names{"grass", "soil", "rock", "scree", "sand", "snow", "litter"};
// Classes of a smaller share of the field are left to the others, since each has textures of its own.
constexpr float least_share = 0.01F;
constexpr std::int32_t most_rows = 256;
// Vertices whose noise is evaluated together, so that its lattices are set up once for all of them.
constexpr std::size_t vertices_a_chunk = 2048;
// Low shrubs and heather cover patches of meadows. The noise is the same in all tiles of a world.
constexpr int shrub_octaves = 3;
constexpr double shrub_cells = 6, shrub_gain = 0.7;
constexpr std::uint64_t shrub_key = 0x5348'5255;
// Tussocks and boulders that are smaller than the squares of the mesh tilt its normals, in cells and by class.
constexpr double bump_cells = 2.3;
constexpr std::uint64_t bump_keys[] = {0x4255'4D58, 0x4255'4D5A};
constexpr float bumps[] = {0.28F, 0.24F, 0.38F, 0.3F, 0.06F, 0.08F, 0.2F};
constexpr glm::vec3 shrub_color{0.55F, 0.53F, 0.5F};

/// The factor of a vertex colour by shrubs, for a noise value and the share of grass.
glm::vec3 shrubs(double noise, float grass) {
  const float share = grass * smooth_step(-0.05F, 0.25F, static_cast<float>(noise));
  return glm::vec3(1) + (shrub_color - 1.0F) * share;
}

std::array<std::uint32_t, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  const std::size_t i = 3 * triangle;
  return {mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
}

/// Gives vertices the normals of the mesh again where others are behind one of their faces.
void restore_turned_off(const Mesh& mesh, Array<glm::vec3>& normals, const Job& job) {
  for (std::size_t t = 0; t < mesh.index.size() / 3; ++t) {
    if (t % 4096 == 0) job.check();
    const std::array<std::uint32_t, 3> at = corners_of(mesh, t);
    const glm::vec3& a = mesh.position[at[0]];
    const glm::vec3 across = glm::cross(mesh.position[at[1]] - a, mesh.position[at[2]] - a);
    for (const std::uint32_t v : at) {
      if (glm::dot(across, normals[v]) <= 0) normals[v] = mesh.normal[v];
    }
  }
}

/// The factor of a vertex colour: plants are yellow on dry ground and dark on wet ground, by noise of low frequency
/// and a random number of the vertex. Distant land, whose textures are too small to be seen, thus has detail.
glm::vec3 varied(const Site& site, float number) {
  constexpr glm::vec3 dry{1.18F, 1.04F, 0.88F}, wet{0.8F, 0.9F, 0.86F};
  const float share = std::clamp(0.5F + 0.6F * site.patch, 0.0F, 1.0F);
  const float own = 0.91F + 0.18F * number;
  return (wet + (dry - wet) * share) * own;
}

}  // namespace

GroundClasses::GroundClasses(const Field& field, const Window& world, const Sites& sites,
                             const GroundColors& colors, const Material& plain, Model& model)
    : field_(field), world_(world), colors_(colors) {
  GroundShares all;
  float count = 0;
  const std::int32_t step_x = 1 + (field.width - 1) / most_rows, step_z = 1 + (field.depth - 1) / most_rows;
  for (std::int32_t z = 0; z < field.depth; z += step_z) {
    for (std::int32_t x = 0; x < field.width; x += step_x) {
      const GroundShares own = shares(sites.at(x, z));
      ++all.of[std::max_element(std::begin(own.of), std::end(own.of)) - std::begin(own.of)];
      ++count;
    }
  }
  for (int i = 0; i < GroundShares::kind_count; ++i) {
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

std::size_t GroundClasses::use_of(const GroundShares& shares) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < used_.size(); ++i) {
    if (shares.of[used_[i].kind] > shares.of[used_[best].kind]) best = i;
  }
  return best;
}

float GroundClasses::own_number(std::int32_t x, std::int32_t z) const {
  const std::uint64_t key =
      key_at(static_cast<std::uint64_t>(world_.x + x), static_cast<std::uint64_t>(world_.z + z));
  return static_cast<float>(key >> 40U) * 0x1p-24F;
}

/// The spot of a vertex that is a sample of the field.
GroundClasses::Spot GroundClasses::spot_of_sample(const Sites& sites, const glm::vec3& position) const {
  const Ground ground(field_);
  const glm::dvec3 p = position;
  const std::int32_t x = std::clamp(math::to_int32((p.x - ground.west) / field_.cell + 0.5), 0,
                                    field_.width - 1),
                     z = std::clamp(math::to_int32((p.z - ground.north) / field_.cell + 0.5), 0,
                                    field_.depth - 1);
  return {sites.at(x, z),
          {static_cast<double>(world_.x + x) * field_.cell, static_cast<double>(world_.z + z) * field_.cell},
          own_number(x, z),
          1};
}

/// The spot of any vertex of refined ground. Its number changes evenly from sample to sample.
GroundClasses::Spot GroundClasses::spot_between(const VertexSite& site, const glm::vec3& position) const {
  const Ground ground(field_);
  const double x = (static_cast<double>(position.x) - ground.west) / field_.cell,
               z = (static_cast<double>(position.z) - ground.north) / field_.cell;
  const std::int32_t i = math::to_int32(std::floor(x)), j = math::to_int32(std::floor(z));
  const auto u = static_cast<float>(x - i), v = static_cast<float>(z - j);
  const auto along = [&](std::int32_t row) {
    const float west = own_number(i, row);
    return west + u * (own_number(i + 1, row) - west);
  };
  const float north = along(j);
  return {
      site.site,
      {(static_cast<double>(world_.x) + x) * field_.cell, (static_cast<double>(world_.z) + z) * field_.cell},
      north + v * (along(j + 1) - north),
      1 - site.weight};
}

template <class SpotOf>
std::vector<Primitive> GroundClasses::divided(const Mesh& mesh, const SpotOf& spot_of, const Job& job) const {
  Array<GroundShares> own(job, mesh.position.size());
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
    std::vector<Spot> spots;
    std::vector<double> east, south;
    for (std::size_t v = begin; v < end; ++v) {
      spots.push_back(spot_of(v));
      east.push_back(spots.back().at.x);
      south.push_back(spots.back().at.y);
    }
    const auto noise = [&](const NoisePlan& plan, std::uint64_t name) {
      std::vector<double> values(spots.size());
      noise_in_plane(plan, east, south, Rng(name), values.data());
      return values;
    };
    const std::vector<double> shrub = noise(patches, shrub_key), tilt_x = noise(bump, bump_keys[0]),
                              tilt_z = noise(bump, bump_keys[1]);
    for (std::size_t i = 0; i < spots.size(); ++i) {
      const std::size_t v = begin + i;
      const Spot& spot = spots[i];
      own[v] = shares(spot.site);
      factors[v] = varied(spot.site, spot.own) * shrubs(shrub[i], own[v].of[GroundShares::grass]);
      float rough = 0;
      for (int k = 0; k < GroundShares::kind_count; ++k) rough += bumps[k] * own[v].of[k];
      const glm::vec3 tilt{static_cast<float>(tilt_x[i]), 0, static_cast<float>(tilt_z[i])};
      normals[v] = math::quick_unit(mesh.normal[v] + spot.bumps * rough * tilt, mesh.normal[v]);
    }
  });
  restore_turned_off(mesh, normals, job);
  const std::vector<std::uint8_t> uses = uses_of(mesh, own, job);
  std::vector<Primitive> primitives;
  for (std::size_t k = 0; k < used_.size(); ++k) {
    const auto triangles = static_cast<std::size_t>(std::ranges::count(uses, k));
    if (triangles == 0) continue;
    BoxMappedMesh part(mesh, VertexOverrides{factors.span(), normals.span()}, used_[k].lighter, job);
    part.reserve(triangles);
    for (std::size_t t = 0; t < uses.size(); ++t) {
      if (t % 4096 == 0) job.check();
      if (uses[t] == k) part.add(corners_of(mesh, t));
    }
    primitives.push_back({part.take(), used_[k].material, {}});
    primitives.back().mesh.cache_ordered = mesh.cache_ordered;
  }
  return primitives;
}

/// The number of the class of each triangle.
std::vector<std::uint8_t> GroundClasses::uses_of(const Mesh& mesh, const Array<GroundShares>& own,
                                                 const Job& job) const {
  std::vector<std::uint8_t> uses;
  uses.reserve(mesh.index.size() / 3);
  for (std::size_t t = 0; t < mesh.index.size() / 3; ++t) {
    if (t % 4096 == 0) job.check();
    const auto [a, b, c] = corners_of(mesh, t);
    GroundShares sum;
    for (int k = 0; k < GroundShares::kind_count; ++k) sum.of[k] = own[a].of[k] + own[b].of[k] + own[c].of[k];
    uses.push_back(static_cast<std::uint8_t>(use_of(sum)));
  }
  return uses;
}

std::vector<Primitive> GroundClasses::divide(const Mesh& mesh, const Sites& sites, const Job& job) const {
  return divided(
      mesh, [&](std::size_t v) { return spot_of_sample(sites, mesh.position[v]); }, job);
}

std::vector<Primitive> GroundClasses::divide(const RefinedMesh& refined, const Sites& sites,
                                             const Job& job) const {
  const std::size_t samples = static_cast<std::size_t>(field_.width) * static_cast<std::size_t>(field_.depth);
  const auto spot_of = [&](std::size_t v) {
    const bool is_refined = v >= samples || refined.sites[v].weight > 0;
    const glm::vec3& position = refined.mesh.position[v];
    return is_refined ? spot_between(refined.sites[v], position) : spot_of_sample(sites, position);
  };
  return divided(refined.mesh, spot_of, job);
}

}  // namespace seedmesh::terrain
