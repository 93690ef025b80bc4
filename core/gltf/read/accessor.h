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
  int lanes = 0;
  bool normalized = false;

  double lane(std::size_t i, int lane) const;
  glm::vec4 at(std::size_t i) const;  ///< missing components are 0, but w is 1
};

/// Throws Unreadable where the accessor is sparse, has no view, or leaves its buffer.
Accessor accessor_of(const tinygltf::Model& file, int number);

glm::u8vec4 color_at(const Accessor& color, std::size_t i);

/// Corners of triangles, three for each, all below `vertices`. Strips and fans become triangles.
Array<std::uint32_t> triangles_of(const tinygltf::Model& file, const tinygltf::Primitive& primitive,
                                  std::size_t vertices, Job& job);

}  // namespace seedmesh::gltf
