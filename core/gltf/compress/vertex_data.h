#pragma once
/// Access to the arrays of a part while it is quantized.
#include <array>
#include <cstring>

#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

/// Elements between two calls of Job::check().
constexpr std::size_t check_interval = 65'536;

/// Returns element `i` of an array of T.
template <class T>
T load(const Slice& slice, std::size_t i) {
  T value;
  std::memcpy(&value, slice.bytes.data() + i * sizeof(T), sizeof(T));
  return value;
}

/// Returns element `i` of an index column of 16 or 32 bits.
inline std::uint32_t corner_at(const Column& index, std::size_t i) {
  return index.component == Component::u16 ? load<std::uint16_t>(index.slice, i)
                                           : load<std::uint32_t>(index.slice, i);
}

/// Returns the elements of a column at these vertex indices.
Slice selected(const Column& column, const Array<std::uint32_t>& vertices, Job& job);

/// Replaces the index of a part. Indices have 16 bits where the number `vertices` allows it.
void set_index(Part& part, Array<std::uint32_t> corners, std::size_t vertices, Job& job);

/// A unit vector in the encoding of the octahedral filter of EXT_meshopt_compression: u, v, the integer that
/// represents 1, and the sign of a tangent.
using OctahedralNormal = std::array<std::int16_t, 4>;
OctahedralNormal octahedral(const glm::dvec3& direction);

/// Quantizes a value from -1 to 1 to a signed integer of `bits` bits.
std::int16_t signed_of(double value, int bits);

/// Whether the three points lie on a line.
inline bool is_flat(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c) {
  const glm::i64vec3 u = glm::i64vec3(b) - glm::i64vec3(a), v = glm::i64vec3(c) - glm::i64vec3(a);
  return u.y * v.z == u.z * v.y && u.z * v.x == u.x * v.z && u.x * v.y == u.y * v.x;
}

/// Returns a quantized position, 16 bits for each axis, as one number.
inline std::uint64_t word_of(const glm::ivec3& p) {
  return static_cast<std::uint64_t>(p.x) << 32U | static_cast<std::uint64_t>(p.y) << 16U |
         static_cast<std::uint64_t>(p.z);
}

}  // namespace seedmesh::gltf
