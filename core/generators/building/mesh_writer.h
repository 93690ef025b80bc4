#pragma once
/// Bodies and parts written into meshes, with texture coordinates where the material has images.
#include "core/generators/building/patch.h"
#include "core/generators/building/shapes.h"
#include "core/model/mesh.h"

namespace seedmesh::building {

/// Where texture coordinates come from: metres of a tile (null: there are none), and the projection of the
/// shape (null: level distance along the wall and height, so that neighbours go on).
struct Texturing {
  const glm::dvec2* tile = nullptr;
  const Projection* projection = nullptr;
};

/// Without vertices; what it grows to is charged to the request.
Mesh empty_mesh(bool has_uv, const Job& job);

/// A body in the frame of its scope, moved by axes and origin.
void append(const Patch& patch, Mesh& mesh, const glm::dmat3& axes, const glm::dvec3& origin,
            const Texturing& texturing);

/// A piece of a part; its own texture coordinates are in metres, those of materials in tiles.
void append_part(const Mesh& from, Mesh& to, const glm::dmat3& axes, const glm::dvec3& at,
                 const glm::dvec2* tile);

}  // namespace seedmesh::building
