/// Octahedral normals: Cigolle et al., JCGT 3(2), 2014, jcgt.org/published/0003/02/01, in the form of
/// EXT_meshopt_compression's filters.
#include "core/gltf/compress/vertex_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace seedmesh::gltf {
namespace {

constexpr int normal_bits = 10;

template <std::size_t bytes>
Slice selected_bytes(const Slice& slice, const Array<std::uint32_t>& vertices, Job& job) {
  using Element = std::array<std::byte, bytes>;
  Array<Element> out(job, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) out[i] = load<Element>(slice, vertices[i]);
  return keep(std::move(out));
}

}  // namespace

Slice selected(const Column& column, const Array<std::uint32_t>& vertices, Job& job) {
  switch (column.stride()) {
    case 4:
      return selected_bytes<4>(column.slice, vertices, job);
    case 8:
      return selected_bytes<8>(column.slice, vertices, job);
    case 12:
      return selected_bytes<12>(column.slice, vertices, job);
    default:
      return selected_bytes<16>(column.slice, vertices, job);
  }
}

void set_index(Part& part, Array<std::uint32_t> corners, std::size_t vertices, Job& job) {
  part.index->count = corners.size();
  if (vertices > 65'535) {
    part.index->slice = keep(std::move(corners));
    part.index->component = Component::u32;
    return;
  }
  Array<std::uint16_t> narrow(job, corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) narrow[i] = static_cast<std::uint16_t>(corners[i]);
  part.index->slice = keep(std::move(narrow));
  part.index->component = Component::u16;
}

std::int16_t signed_of(double value, int bits) {
  const double most = (1 << (bits - 1)) - 1;
  return static_cast<std::int16_t>(std::floor(std::clamp(value, -1.0, 1.0) * most + 0.5));
}

OctahedralNormal octahedral(const glm::dvec3& n) {
  const double length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  const double x = length > 0 ? n.x / length : 0, y = length > 0 ? n.y / length : 0;
  const bool below = n.z < 0;
  const double u = below ? (1 - std::abs(y)) * (x >= 0 ? 1 : -1) : x;
  const double v = below ? (1 - std::abs(x)) * (y >= 0 ? 1 : -1) : y;
  return {signed_of(u, normal_bits), signed_of(v, normal_bits), signed_of(1, normal_bits), 0};
}

}  // namespace seedmesh::gltf
