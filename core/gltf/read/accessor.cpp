#include "core/gltf/read/accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>

#include "core/gltf/read/bytes.h"

namespace seedmesh::gltf {
namespace {

template <class T>
T load(const unsigned char* data) {
  T value;
  std::memcpy(&value, data, sizeof(value));
  return value;
}

std::size_t size_of(int component) {
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      throw Unreadable{"an accessor has the unknown component type " + std::to_string(component)};
  }
}

int lanes_of(int type) {
  if (type == TINYGLTF_TYPE_SCALAR) return 1;
  if (type >= TINYGLTF_TYPE_VEC2 && type <= TINYGLTF_TYPE_VEC4) return type;
  throw Unreadable{"an accessor has a type that mesh attributes do not have"};
}

std::uint32_t corner_at(const Accessor& index, std::size_t i) {
  const unsigned char* at = index.data + i * index.stride;
  switch (index.component) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *at;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

/// The corners in the order of the file.
Array<std::uint32_t> corners_of(const tinygltf::Model& file, const tinygltf::Primitive& primitive,
                                std::size_t vertices, Job& job) {
  if (primitive.indices < 0) {
    Array<std::uint32_t> corners(job, vertices);
    for (std::size_t i = 0; i < vertices; ++i) corners[i] = static_cast<std::uint32_t>(i);
    return corners;
  }
  const Accessor index = accessor_of(file, primitive.indices);
  const bool whole = index.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                     index.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                     index.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (index.lanes != 1 || !whole) throw Unreadable{"the indices are not unsigned integers"};
  Array<std::uint32_t> corners(job, index.count);
  for (std::size_t i = 0; i < index.count; ++i) {
    if (i % 4096 == 0) job.check();
    corners[i] = corner_at(index, i);
    if (corners[i] >= vertices) {
      throw Unreadable{"it refers to vertex " + std::to_string(corners[i]) + " of " +
                       std::to_string(vertices)};
    }
  }
  return corners;
}

}  // namespace

double Accessor::lane(std::size_t i, int lane) const {
  const unsigned char* at = data + i * stride + static_cast<std::size_t>(lane) * size_of(component);
  switch (component) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? std::max(load<std::int8_t>(at) / 127.0, -1.0) : load<std::int8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return normalized ? *at / 255.0 : *at;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? std::max(load<std::int16_t>(at) / 32767.0, -1.0) : load<std::int16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return normalized ? load<std::uint16_t>(at) / 65535.0 : load<std::uint16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(at);
    default:
      return static_cast<double>(load<float>(at));
  }
}

glm::vec4 Accessor::at(std::size_t i) const {
  glm::vec4 value(0, 0, 0, 1);
  for (int each = 0; each < lanes; ++each) {
    const double number = lane(i, each);
    if (!(number >= -1e9 && number <= 1e9))
      throw Unreadable{"an attribute has a number that is not finite or is above 1e9"};
    value[each] = static_cast<float>(number);
  }
  return value;
}

Accessor accessor_of(const tinygltf::Model& file, int number) {
  if (number < 0 || static_cast<std::size_t>(number) >= file.accessors.size())
    throw Unreadable{"it refers to accessor " + std::to_string(number) + ", which does not exist"};
  const tinygltf::Accessor& given = file.accessors[static_cast<std::size_t>(number)];
  const std::string name = "accessor " + std::to_string(number);
  if (given.sparse.isSparse) throw Unreadable{name + " is sparse, which is not supported"};
  if (given.bufferView < 0 || static_cast<std::size_t>(given.bufferView) >= file.bufferViews.size())
    throw Unreadable{name + " has no buffer view"};
  const tinygltf::BufferView& view = file.bufferViews[static_cast<std::size_t>(given.bufferView)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= file.buffers.size())
    throw Unreadable{name + " has no buffer"};
  const std::vector<unsigned char>& bytes = file.buffers[static_cast<std::size_t>(view.buffer)].data;

  Accessor accessor{.data = nullptr,
                    .count = given.count,
                    .stride = view.byteStride,
                    .component = given.componentType,
                    .lanes = lanes_of(given.type),
                    .normalized = given.normalized};
  const std::size_t element = size_of(accessor.component) * static_cast<std::size_t>(accessor.lanes);
  if (accessor.stride == 0) accessor.stride = element;
  const bool view_fits = view.byteOffset <= bytes.size() && view.byteLength <= bytes.size() - view.byteOffset;
  const bool begins = view_fits && given.byteOffset <= view.byteLength && accessor.stride >= element &&
                      accessor.stride <= 252;
  const std::size_t room = begins ? view.byteLength - given.byteOffset : 0;
  if (accessor.count == 0 || room < element || (accessor.count - 1) > (room - element) / accessor.stride)
    throw Unreadable{name + " does not fit inside its buffer"};
  accessor.data = bytes.data() + view.byteOffset + given.byteOffset;
  return accessor;
}

glm::u8vec4 color_at(const Accessor& color, std::size_t i) {
  glm::vec4 value = color.at(i);
  if (color.lanes < 3) value = glm::vec4(1);
  glm::u8vec4 bytes;
  for (int lane = 0; lane < 4; ++lane)
    bytes[lane] = static_cast<std::uint8_t>(std::clamp(value[lane], 0.0F, 1.0F) * 255.0F + 0.5F);
  return bytes;
}

Array<std::uint32_t> triangles_of(const tinygltf::Model& file, const tinygltf::Primitive& primitive,
                                  std::size_t vertices, Job& job) {
  Array<std::uint32_t> corners = corners_of(file, primitive, vertices, job);
  const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
  if (!strip && primitive.mode != TINYGLTF_MODE_TRIANGLE_FAN) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  const std::size_t count = corners.size() < 3 ? 0 : corners.size() - 2;
  Array<std::uint32_t> triangles(job, count * 3);
  for (std::size_t i = 0; i < count; ++i) {
    triangles[3 * i] = strip ? corners[i] : corners[0];
    triangles[3 * i + 1] = strip ? corners[i + 1 + i % 2] : corners[i + 1];
    triangles[3 * i + 2] = strip ? corners[i + 2 - i % 2] : corners[i + 2];
  }
  return triangles;
}

}  // namespace seedmesh::gltf
