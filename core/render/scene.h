#pragma once
/// The primitives of a model at their positions, as a list that samples refer to. For core/render only.
#include "core/render/eye.h"
#include "core/render/items.h"
#include "core/render/surfaces.h"

namespace seedmesh::render {

/// A primitive of an item.
struct Drawing {
  const Mesh* mesh = nullptr;
  std::uint32_t item = 0;     ///< index into Items::list
  std::uint32_t surface = 0;  ///< index into Surfaces
  std::size_t first = 0;      ///< its first vertex in ProjectedScene::vertices
};

/// A scene refers to a model, its items and its surfaces. They must outlive the scene.
struct Scene {
  const Model& model;
  const Items& items;
  const Surfaces& surfaces;
  Array<Drawing> drawings;
  std::size_t vertices = 0;  ///< of all drawings
  bool has_blending = false;
};

Scene scene_of(const Model& model, const Items& items, const Surfaces& surfaces, const Job& job);

/// A scene as seen from an eye. Vertices are projected once, unless there are too many.
struct ProjectedScene {
  const Scene& scene;
  Eye eye;
  Array<Projected> vertices;  ///< of all drawings, or empty

  Lens lens_of(const Drawing& drawing) const { return eye.lens_at(scene.items.list[drawing.item].at); }
  Projected vertex(const Drawing& drawing, const Lens& lens, std::uint32_t i) const {
    return vertices.empty() ? lens(drawing.mesh->position[i]) : vertices[drawing.first + i];
  }
};

/// Cost: about 5 ns a vertex.
ProjectedScene project(const Scene& scene, const Eye& eye, const Job& job);

/// Returns the texture coordinates of a mesh that a surface refers to; null: none.
const Array<glm::vec2>* uv_of(const Mesh& mesh, const Surface& surface);

/// Whether a transform turns left into right.
bool is_mirrored(const glm::mat4& at);

}  // namespace seedmesh::render
