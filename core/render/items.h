#pragma once
/// What a model shows, as a flat list of meshes with their positions.
#include <glm/glm.hpp>
#include <vector>

#include "core/base/array.h"
#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::render {

/// A mesh of the model at a position.
struct Item {
  std::uint32_t group = 0;  ///< index into Model::meshes
  glm::mat4 at{1};
};

struct Items {
  Array<Item> list;
  Box box;                 ///< of all of it
  std::vector<Box> boxes;  ///< of Model::meshes, each in its own frame
};

/// Returns all that is drawn at the finest level, copies one by one. Collision shapes are left out.
Items items_of(const Model& model, const Job& job);

/// Returns the bounding box of a mesh group, in its own frame.
Box box_of(const MeshGroup& group);

/// Returns the corners of a box.
inline glm::vec3 corner_of(const Box& box, int corner) {
  return {(corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
          (corner & 4) != 0 ? box.max.z : box.min.z};
}

}  // namespace seedmesh::render
