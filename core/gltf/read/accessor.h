#pragma once
/// Accessors of an imported glTF file. All bounds are checked once, before the elements are read.
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/base/array.h"
#include "core/base/job.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace seedmesh::gltf {

constexpr double farthest = 1e6;  ///< metres; positions beyond are refused

/// `count` elements that all lie inside their buffer. Does not own the bytes.
struct Accessor {
  const unsigned char* data = nullptr;
  std::size_t count = 0;  ///< 0: the attribute does not exist
  std::size_t stride = 0;
  int component = 0;  ///< component type by its OpenGL number
  int lanes = 0;      ///< number of components of an element, 1 to 4
  bool normalized = false;

  /// Returns one component as a number; normalized integers become -1 to 1.
  double lane(std::size_t i, int lane) const;
  /// Returns an element. Missing components are 0, except w, which is 1. Throws Unreadable for a number that is not
  /// finite or is beyond 1e9.
  glm::vec4 at(std::size_t i) const;
};

/// Reads an accessor. Throws Unreadable if it is missing, sparse, empty, of an unsupported type, or not inside its
/// buffer.
Accessor accessor_of(const tinygltf::Model& file, int number);

/// Clamps a colour to the range from 0 to 1 and returns it as bytes, or white if the attribute has fewer than
/// three components.
glm::u8vec4 color_at(const Accessor& color, std::size_t i);

/// Returns the corners of triangles, three for each, all below `vertices`. Strips and fans become triangles.
Array<std::uint32_t> triangles_of(const tinygltf::Model& file, const tinygltf::Primitive& primitive,
                                  std::size_t vertices, Job& job);

}  // namespace seedmesh::gltf
