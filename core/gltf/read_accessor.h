#pragma once
/// Numbers of a glTF file that somebody gave, looked up with every bound checked once, before the loop.
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

/// A view of `count` elements that all lie inside their buffer. Does not own the bytes.
struct Accessor {
  const unsigned char* data = nullptr;
  std::size_t count = 0;  ///< 0: the attribute is not there
  std::size_t stride = 0;
  int component = 0;  ///< as OpenGL numbers its types
  int lanes = 0;
  bool normalized = false;

  double lane(std::size_t i, int lane) const;
  glm::vec4 at(std::size_t i) const;  ///< lanes that are not there are 0, but w is 1
};

/// Throws Unreadable where the accessor is sparse, has no view, or leaves its buffer.
Accessor accessor_of(const tinygltf::Model& file, int number);

glm::u8vec4 color_at(const Accessor& color, std::size_t i);

/// Corners of triangles, three each, every one below `vertices`; strips and fans unrolled.
Array<std::uint32_t> triangles_of(const tinygltf::Model& file, const tinygltf::Primitive& primitive,
                                  std::size_t vertices, Job& job);

}  // namespace seedmesh::gltf
