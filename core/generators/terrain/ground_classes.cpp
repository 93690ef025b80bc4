#include "core/generators/terrain/ground_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/base/math.h"
#include "core/base/quick_math.h"
#include "core/base/rng.h"
#include "core/generators/terrain/model_parts.h"
#include "core/texture/ground.h"
#include "core/texture/wall.h"

namespace seedmesh::terrain {
namespace {

// In the order of GroundClasses::Kind.
constexpr std::array<const char*, 6> names{"grass", "soil", "rock", "scree", "sand", "snow"};
// Classes of a smaller share of the field are left to the others, since each has textures of its own.
constexpr float least_share = 0.01F;
constexpr std::int32_t most_rows = 256;
// Bare rock is steeper than loose stones lie (35 degrees), by this much at the borders between both.
constexpr float scree_slope = 0.7F, rock_slope = 0.95F;
constexpr auto by_tile = static_cast<float>(1 / texture::ground_tile);
// The vertical part of a normal at 50 degrees.
constexpr float least_upright = 0.64278761F;

float ease(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

/// The side from which a face is mapped.
enum Side : std::uint32_t { above, along_x, along_z, side_count };

Side side_of(const glm::vec3& across) {
  const float length = std::sqrt(glm::dot(across, across));
  if (across.y >= least_upright * length) return above;
  return std::abs(across.x) >= std::abs(across.z) ? along_x : along_z;
}

glm::vec2 mapped(const glm::vec3& p, Side side) {
  if (side == above) return {p.x * by_tile, p.z * by_tile};
  return {(side == along_x ? p.z : p.x) * by_tile, -p.y * by_tile};
}

/// The direction in which u grows, at right angles to the normal.
glm::vec4 tangent_of(const glm::vec3& normal, Side side) {
  const glm::vec3 u = side == along_x ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const float turned = side == above ? 1.0F : side == along_x ? -normal.x : normal.z;
  return {math::quick_unit(u - normal * glm::dot(u, normal), glm::vec3(1, 0, 0)), turned < 0 ? -1.0F : 1.0F};
}

/// The factor of a vertex colour: plants are yellow on dry ground and dark on wet ground, by slow noise and from
/// vertex to vertex, so that the land has detail where its textures are too small to be seen.
glm::vec3 varied(const Site& site, std::uint64_t key) {
  constexpr glm::vec3 dry{1.16F, 1.03F, 0.86F}, wet{0.84F, 0.92F, 0.9F};
  const float share = std::clamp(0.5F + 0.6F * site.patch, 0.0F, 1.0F);
  const float own = 0.93F + 0.14F * static_cast<float>(key >> 40U) * 0x1p-24F;
  return (wet + (dry - wet) * share) * own;
}

/// Collects the triangles of one class.
class Part {
 public:
  /// `factors`: of the vertex colours.
  Part(const Mesh& from, const Array<glm::vec3>& factors, float lighter, const Job& job)
      : from_(from),
        factors_(factors),
        lighter_(lighter),
        place_(job, side_count * from.position.size(), unplaced) {}

  void add(const std::array<std::uint32_t, 3>& corners, Side side) {
    for (const std::uint32_t corner : corners) {
      std::uint32_t& place = place_[side_count * corner + side];
      if (place == unplaced) {
        place = static_cast<std::uint32_t>(mesh.position.size());
        add_vertex(corner, side);
      }
      mesh.index.wide.push_back(place);
    }
  }

  Mesh mesh;

 private:
  static constexpr std::uint32_t unplaced = 0xFFFFFFFFU;

  void add_vertex(std::uint32_t v, Side side) {
    mesh.position.push_back(from_.position[v]);
    mesh.normal.push_back(from_.normal[v]);
    mesh.tangent.push_back(tangent_of(from_.normal[v], side));
    mesh.uv[0].push_back(from_.uv[0][v]);
    mesh.uv[1].push_back(mapped(from_.position[v], side) + 0.0F);
    if (from_.color.empty()) return;
    glm::u8vec4 color = from_.color[v];
    for (int i = 0; i < 3; ++i) {
      const float lit = static_cast<float>(color[i]) * factors_[v][i] * lighter_ + 0.5F;
      color[i] = static_cast<std::uint8_t>(std::min(lit, 255.0F));
    }
    mesh.color.push_back(color);
  }

  const Mesh& from_;
  const Array<glm::vec3>& factors_;
  float lighter_;
  Array<std::uint32_t> place_;
};

Mesh empty_like(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.tangent = Array<glm::vec4>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.uv[1] = Array<glm::vec2>(job);
  mesh.color = Array<glm::u8vec4>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
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
      lay(soil, cover.sand + cover.grass);
      lay_stone(cover.rock + cover.snow);
      break;
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
  Array<glm::vec3> factors(job, own.size());
  for (std::size_t v = 0; v < own.size(); ++v) {
    if (v % 4096 == 0) job.check();
    const glm::dvec3 p = mesh.position[v];
    const std::int32_t x = std::clamp(math::to_int32((p.x - west) / field_.cell + 0.5), 0, field_.width - 1),
                       z = std::clamp(math::to_int32((p.z - north) / field_.cell + 0.5), 0, field_.depth - 1);
    const Site site = sites.at(x, z);
    own[v] = shares(site);
    factors[v] = varied(
        site, key_at(static_cast<std::uint64_t>(world_.x + x), static_cast<std::uint64_t>(world_.z + z)));
  }
  std::vector<Part> parts;
  for (const Used& used : used_) {
    parts.emplace_back(mesh, factors, used.lighter, job);
    parts.back().mesh = empty_like(job);
  }
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    if (i % 12'288 == 0) job.check();
    const std::array<std::uint32_t, 3> at{mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)};
    Shares sum;
    for (int k = 0; k < kind_count; ++k) sum.of[k] = own[at[0]].of[k] + own[at[1]].of[k] + own[at[2]].of[k];
    const glm::vec3& a = mesh.position[at[0]];
    const glm::vec3 across = glm::cross(mesh.position[at[1]] - a, mesh.position[at[2]] - a);
    parts[use_of(sum)].add(at, side_of(across));
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
