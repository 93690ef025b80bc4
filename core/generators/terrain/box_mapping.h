#pragma once
/// Texture coordinates for textures of ground that repeat. Each face is mapped from the side that it faces.
/// Gentle ground is mapped from above, and ground steeper than 50 degrees from a side. No texture is
/// therefore stretched by more than 1.8.
#include <array>
#include <span>

#include "core/model/mesh.h"

namespace seedmesh::terrain {

/// The side from which a face is mapped.
enum MappedSide : std::uint32_t { above, along_x, along_z, below, mapped_side_count };

/// What differs from the mesh at each vertex; either may be empty.
struct VertexOverrides {
  std::span<const glm::vec3> factors;  ///< of the colours
  std::span<const glm::vec3> normals;  ///< instead of those of the mesh
};

/// Collects triangles of a mesh. A vertex that faces of several sides share is duplicated.
class BoxMappedMesh {
 public:
  /// `lighter`: factor of all colours. `from` and `overrides` are borrowed. If `from` has texture coordinates in
  /// set 0, these are kept, and the new ones are in set 1. Otherwise the new ones are in set 0.
  BoxMappedMesh(const Mesh& from, const VertexOverrides& overrides, float lighter, const Job& job);

  /// Reserves memory for this many triangles.
  void reserve(std::size_t triangles);
  void add(const std::array<std::uint32_t, 3>& corners);
  /// Returns the mesh of all added triangles. To be called once, at the end.
  Mesh take();

 private:
  /// A vertex of the mesh, and the side from which the faces at it are mapped.
  struct Source {
    std::uint32_t vertex;
    MappedSide side;
  };
  glm::u8vec4 color_of(std::uint32_t v) const;

  const Mesh& from_;
  VertexOverrides overrides_;
  float lighter_;
  Array<std::uint32_t> place_;  ///< number of the new vertex of each vertex and side
  Array<Source> source_;        ///< of each new vertex
  Array<std::uint32_t> index_;
  const Job& job_;
};

}  // namespace seedmesh::terrain
