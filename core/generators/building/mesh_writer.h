#pragma once
/// Writes bodies and parts into meshes, with texture coordinates if the material has textures.
#include "core/generators/building/body_surface.h"
#include "core/generators/building/shapes.h"
#include "core/model/mesh.h"

namespace seedmesh::building {

/// The source of texture coordinates: the size of a tile in metres (null: none are written) and the
/// projection of the shape (null: u is the horizontal distance along the wall and v the height, continuous
/// over neighbours).
struct TextureMapping {
  const glm::dvec2* tile = nullptr;
  const Projection* projection = nullptr;
};

/// Returns a mesh without vertices, whose memory is charged to the request.
Mesh empty_mesh(bool has_uv, const Job& job);

/// Appends a body. Its positions are in the frame of its scope, whose axes and origin are `axes` and
/// `origin`.
void append(const BodySurface& surface, Mesh& mesh, const glm::dmat3& axes, const glm::dvec3& origin,
            const TextureMapping& texturing);

/// Appends the mesh of a part. Texture coordinates of `from` are in metres; those of `to` are in tiles of `tile` metres.
void append_part(const Mesh& from, Mesh& to, const glm::dmat3& axes, const glm::dvec3& at,
                 const glm::dvec2* tile);

}  // namespace seedmesh::building
