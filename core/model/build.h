#pragma once
/// Steps of building a model that generators share, and queries on transforms of nodes.
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/model/demand.h"
#include "core/model/model.h"

namespace seedmesh {

/// Adds an entry and returns its index.
int add_material(Model& model, Material material);
int add_mesh(Model& model, MeshGroup group);
int add_mesh(Model& model, std::string name, Mesh mesh, int material);

/// True where the materials differ at most in their names, impostors and the seeds of their textures.
bool are_alike(const Material& a, const Material& b);

/// Moves materials, textures and warnings of `other` into the model, and returns the index of its first material.
int move_materials(Model& model, Model& other);

/// Adds a node with this parent and mesh (-1: none). The reference is valid until the next node is added.
Node& add_node(Model& model, std::string name, int parent, int mesh = -1);

/// Adds a mesh to a node as its next coarser level, or as its finest level if the node shows no mesh yet.
void add_level(Node& node, int mesh);

/// Adds each of `shapes`, which are convex meshes, as a collision node below node 0. The nodes are named by
/// collision_name(names, of, number from 1). All meshes get one new material.
void add_collision_shapes(Model& model, CollisionNames names, const std::string& of,
                          std::vector<Mesh> shapes);

/// True where the transform changes no bit of any point.
bool is_identity(const Transform& transform);

template <class Number = double>
glm::mat<4, 4, Number> matrix_of(const Transform& transform) {
  glm::mat<4, 4, Number> matrix = glm::mat4_cast(glm::qua<Number>(transform.rotation));
  for (int axis = 0; axis < 3; ++axis) matrix[axis] *= Number{transform.scale[axis]};
  matrix[3] = glm::vec<4, Number>(glm::vec<3, Number>(transform.translation), 1);
  return matrix;
}

/// Returns for each node the transform from its frame to that of the model, without its instances.
template <class Number = double>
std::vector<glm::mat<4, 4, Number>> world_matrices(const Model& model) {
  std::vector<glm::mat<4, 4, Number>> world;
  world.reserve(model.nodes.size());
  for (const Node& node : model.nodes) {
    const glm::mat<4, 4, Number> own = matrix_of<Number>(node.transform);
    world.push_back(node.parent < 0 ? own : world[static_cast<std::size_t>(node.parent)] * own);
  }
  return world;
}

}  // namespace seedmesh
