#include "core/model/build.h"

#include <iterator>
#include <tuple>
#include <utility>

#include "core/model/collision_name.h"

namespace seedmesh {

int add_material(Model& model, Material material) {
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

int add_mesh(Model& model, MeshGroup group) {
  model.meshes.push_back(std::move(group));
  return static_cast<int>(model.meshes.size()) - 1;
}

int add_mesh(Model& model, std::string name, Mesh mesh, int material) {
  MeshGroup group{std::move(name), {}};
  group.primitives.push_back({std::move(mesh), material, {}});
  return add_mesh(model, std::move(group));
}

bool are_alike(const Material& a, const Material& b) {
  const auto compared = [](const Material& m) {
    return std::tie(m.base_color, m.metallic, m.roughness, m.emissive, m.base_color_texture, m.normal_texture,
                    m.metallic_roughness_texture, m.occlusion_texture, m.emissive_texture, m.alpha_mode,
                    m.alpha_cutoff, m.double_sided, m.unlit, m.specular, m.specular_color, m.transmission,
                    m.transmission_color, m.recipe.kind, m.recipe.color, m.recipe.factor,
                    m.recipe.has_own_sides);
  };
  return compared(a) == compared(b);
}

int move_materials(Model& model, Model& other) {
  const auto first = static_cast<int>(model.materials.size()),
             textures = static_cast<int>(model.textures.size());
  for (Material& material : other.materials) {
    for (TextureUse* use : material.textures()) {
      if (use->texture >= 0) use->texture += textures;
    }
  }
  const auto move_all = [](auto& all, auto& others) {
    all.insert(all.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  };
  move_all(model.materials, other.materials);
  move_all(model.textures, other.textures);
  move_all(model.warnings, other.warnings);
  return first;
}

Node& add_node(Model& model, std::string name, int parent, int mesh) {
  Node& node = model.nodes.emplace_back();
  node.name = std::move(name);
  node.parent = parent;
  node.mesh = mesh;
  return node;
}

void add_level(Node& node, int mesh) {
  if (node.mesh < 0) {
    node.mesh = mesh;
  } else {
    node.lods.push_back(mesh);
  }
}

void add_collision_shapes(Model& model, CollisionNames names, const std::string& of,
                          std::vector<Mesh> shapes) {
  Material material;
  material.name = "collision";
  const int number = add_material(model, std::move(material));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const int mesh = add_mesh(model, "collision", std::move(shapes[i]), number);
    add_node(model, collision_name(names, of, i + 1), 0, mesh).collision = CollisionShape::convex;
  }
}

bool is_identity(const Transform& transform) {
  return transform.translation == glm::vec3(0) && transform.rotation == glm::quat(1, 0, 0, 0) &&
         transform.scale == glm::vec3(1);
}

}  // namespace seedmesh
