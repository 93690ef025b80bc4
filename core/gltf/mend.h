#pragma once
/// Normals of faces that are hardly larger than the steps of a grid: these turn when their corners are moved
/// onto it.
#include <array>
#include <cstring>
#include <vector>

#include "core/base/array.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {

template <class T>
T load(const Slice& slice, std::size_t i) {
  T value;
  std::memcpy(&value, slice.bytes.data() + i * sizeof(T), sizeof(T));
  return value;
}

/// Elements of a column by number.
Slice picked(const Column& column, const Array<std::uint32_t>& vertices, Job& job);

/// As quantize() writes them: two coordinates, what stands for 1, and a sign that normals do not have.
using OctahedralNormal = std::array<std::int16_t, 4>;
OctahedralNormal octahedral(const glm::dvec3& direction);

/// Corners (three a triangle, rising) whose normal looks away from their face, of a part before it is
/// quantized; there are none in what this program makes, but there may be in a GLB that it was given.
std::vector<std::size_t> corners_looking_inward(const Part& part, Job& job);

/// Gives every other corner whose quantized normal looks away from its quantized face a vertex of its own
/// with the face's normal. A tenth of the time of quantizing.
void mend_normals(Part& part, const std::vector<std::size_t>& inward, Job& job);

}  // namespace seedmesh::gltf
