#pragma once
/// A mesh as one array for each attribute. Conventions of the whole project: lengths in metres, angles in
/// radians, +Y up, right-handed, triangles counter-clockwise seen from outside. Only JSON has degrees.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "core/base/array.h"

namespace seedmesh {

struct Box {
  glm::vec3 min{0}, max{0};
};

enum class Topology { triangles, lines, points };

/// Indices of a mesh: 32 bits while it is built. finish() (core/geom/mesh/finish.h) narrows them to 16 bits
/// where the number of vertices allows. At most one of the two arrays is in use. Both are empty only if the
/// mesh has points, which have no indices.
struct Indices {
  Array<std::uint32_t> wide;
  Array<std::uint16_t> small;
  std::size_t size() const { return wide.size() + small.size(); }
  std::uint32_t at(std::size_t i) const { return small.empty() ? wide[i] : small[i]; }
};

/// The summary of a mesh that was packed for a file before the rest of its model was made
/// (core/gltf/compress/pack.h). The packed data are in a derived class.
struct PackedMesh {
  std::size_t elements = 0, vertices = 0;
  std::uint64_t bytes = 0;  ///< bytes of the arrays before they were packed
  Box bounds;

  PackedMesh() = default;
  PackedMesh(const PackedMesh&) = delete;
  PackedMesh& operator=(const PackedMesh&) = delete;
  virtual ~PackedMesh() = default;
};

/// Triangles, lines or points with one material. Every attribute array is empty or as long as `position`.
struct Mesh {
  Topology topology = Topology::triangles;
  Array<glm::vec3> position;
  Array<glm::vec3> normal;             ///< unit length; none for lines and points
  std::array<Array<glm::vec2>, 4> uv;  ///< 0: texture, in metres or 0..1; 1: lightmap; 2, 3: wind
  Array<glm::u8vec4> color;            ///< linear RGBA, multiplies the base colour
  Array<glm::vec4> tangent;            ///< w = handedness; only where a normal map is
  Array<glm::u16vec4> joints;          ///< up to four joints of the node's skin, with `weights`
  Array<glm::vec4> weights;
  Array<std::uint16_t> bone;  ///< the only joint of the vertex; joints and weights are then empty
  Array<glm::vec3>
      next_position;  ///< positions on the next coarser level (core/geom/lod/next_positions.h); usually empty
  Indices index;      ///< 3 for each triangle, 2 for each line
  Box bounds;         ///< bounds of `position`; set by finish()
  bool cache_ordered = false;                ///< the triangles are in vertex cache order already
  bool no_minus_zero = false;                ///< positions, normals, uv[0] and tangents have no -0
  std::shared_ptr<const PackedMesh> packed;  ///< replaces all arrays; null where the arrays are in use

  std::size_t elements() const;  ///< triangles, lines or points
  std::size_t vertices() const { return packed ? packed->vertices : position.size(); }
  std::uint64_t bytes() const;  ///< bytes of all arrays
};

/// Returns the bounding box of `position`; {0, 0} where it is empty.
Box bounds_of(std::span<const glm::vec3> position);
Box bounds_of(const Mesh& mesh);

}  // namespace seedmesh
