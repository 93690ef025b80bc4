#include "core/generators/terrain/model_parts.h"

#include "core/generators/material_members.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {

Material ground_material(const TerrainParams& params) {
  Material material;
  material.name = "ground";
  material.roughness = 0.95F;
  set_specular(material, params.specular);
  set_emission(material, params.emission);
  return material;
}

Material water_material() {
  Material material;
  material.name = "water";
  material.base_color = {linear_of_srgb(38), linear_of_srgb(66), linear_of_srgb(80), 0.78F};
  material.roughness = 0.08F;
  material.alpha_mode = AlphaMode::blend;
  return material;
}

int add_child(Model& model, std::string name, int mesh) {
  add_node(model, std::move(name), 0, mesh);
  return static_cast<int>(model.nodes.size()) - 1;
}

}  // namespace seedmesh::terrain
