#include <algorithm>
#include <string>

#include "core/generators/terrain/box_mapping.h"
#include "core/generators/terrain/build_model.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/plan.h"
#include "core/texture/wall.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

class PlanetModelBuilder {
 public:
  PlanetModelBuilder(const TerrainParams& params, const GenerateContext& context)
      : params_(params), job_(context.job), demand_(context.demand) {}

  Model build() {
    Planet planet = planet_of(params_, 0, job_);
    job_.progress("mesh", 0);
    const Range range = colored_range(planet);
    const auto level = static_cast<float>(params_.water_level.value_or(static_cast<double>(range.low)));
    const GroundColors ground_colors(palette_of(params_), range, level);
    Model model;
    model.name = "terrain";
    add_node(model, "terrain", -1);
    add_ground(model, std::move(planet), ground_colors);
    if (params_.water_level && level > range.low) {
      add_sea(model, level);
    } else if (params_.water_level) {
      model.warnings.push_back(
          {"/water_level", "there is no water, because all ground is above it; the lowest height is " +
                               std::to_string(range.low) + " m"});
    }
    return model;
  }

 private:
  bool is_rock() const { return params_.algorithm == TerrainAlgorithm::fracture; }
  bool has_detail() const { return params_.detail && demand_.textures > 0; }

  /// The range of heights that colours refer to: that of the positions of a rock.
  Range colored_range(const Planet& planet) const {
    if (!is_rock()) return range_of(planet);
    const auto half = static_cast<float>(planet.radius);
    return {-half, half};
  }

  Material material() const {
    Material made = ground_material(params_);
    if (has_detail()) made.recipe.kind = made.name = rock_kind;
    return made;
  }

  /// The mesh of a planet, with texture coordinates if it has detail.
  Mesh mesh_of(const Planet& planet, const GroundColors* colors) {
    const UpDirection upward = is_rock() ? UpDirection::along_y : UpDirection::outward;
    Mesh mesh = planet_mesh(planet, colors, upward, job_.rng().at("terrain"), job_);
    if (!has_detail()) return mesh;
    BoxMappedMesh mapped(mesh, {}, 1 / texture::grey_of(rock_kind), job_);
    mapped.reserve(mesh.index.size() / 3);
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
      if (i % 12'288 == 0) job_.check();
      mapped.add({mesh.index.at(i), mesh.index.at(i + 1), mesh.index.at(i + 2)});
    }
    return mapped.take();
  }

  void add_ground(Model& model, Planet planet, const GroundColors& ground_colors) {
    const int ground = add_material(model, material());
    const GroundColors* colors = params_.palette == TerrainPalette::none ? nullptr : &ground_colors;
    for (int level = 0; level < demand_.lods; ++level) {
      if (level > 0) {
        if (planet_side(params_, level) == planet.side) break;
        planet = planet_of(params_, level, job_);
      }
      Mesh mesh = mesh_of(planet, colors);
      mesh.cache_ordered = level == 0;  // the order of the faces fits the vertex cache
      const int number = add_mesh(model, level_name("planet", level), std::move(mesh), ground);
      if (level == 0) {
        model.nodes[0].mesh = number;
      } else {
        model.nodes[0].lods.push_back(number);
      }
    }
  }

  void add_sea(Model& model, float level_of_water) {
    const int water = add_material(model, water_material());
    std::int32_t before = 0;
    int node = -1;
    for (int level = 0; level < demand_.lods; ++level) {
      const std::int32_t own = sea_side(params_, level);
      if (own == before) break;
      before = own;
      Planet sea = sphere_of(own, params_.size / 2, job_);
      for (float& height : sea.height) height = level_of_water;
      Mesh mesh = planet_mesh(sea, nullptr, UpDirection::outward, job_.rng(), job_);
      mesh.cache_ordered = level == 0;
      const int number = add_mesh(model, level_name("water", level), std::move(mesh), water);
      if (node < 0) {
        node = add_child(model, "water", number);
      } else {
        model.nodes[static_cast<std::size_t>(node)].lods.push_back(number);
      }
    }
  }

  const TerrainParams& params_;
  Job& job_;
  const Demand& demand_;
};

}  // namespace

std::int32_t sea_side(const TerrainParams& params, int level) {
  constexpr std::int32_t most = 65;
  return std::min(planet_side(params, level), ((most - 1) >> level) + 1);
}

Model build_planet_model(const TerrainParams& params, const GenerateContext& context) {
  return PlanetModelBuilder(params, context).build();
}

}  // namespace seedmesh::terrain
