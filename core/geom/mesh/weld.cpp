#include "core/geom/mesh/weld.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace seedmesh {
namespace {

template <class T>
void add_stream(std::vector<meshopt_Stream>& streams, Array<T>& values) {
  if (!values.empty()) streams.push_back({values.data(), sizeof(T), sizeof(T)});
}

/// Meshes of at most this many vertices compare all pairs, which is faster than a hash table.
constexpr std::size_t few_vertices = 48;

bool are_equal(const std::vector<meshopt_Stream>& streams, std::size_t a, std::size_t b) {
  return std::all_of(streams.begin(), streams.end(), [a, b](const meshopt_Stream& stream) {
    const auto* const bytes = static_cast<const std::byte*>(stream.data);
    return std::memcmp(bytes + a * stream.stride, bytes + b * stream.stride, stream.size) == 0;
  });
}

/// Sets the new number of each vertex. Returns how many vertices are different.
std::size_t number_pairwise(const std::vector<meshopt_Stream>& streams, std::span<std::uint32_t> place) {
  std::array<std::uint32_t, few_vertices> first{};  // of equal vertices, by new number
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    std::uint32_t same = 0;
    while (same < count && !are_equal(streams, first[same], i)) ++same;
    place[i] = same;
    if (same == count) first[count++] = i;
  }
  return count;
}

std::size_t number_by_hash(const std::vector<meshopt_Stream>& streams, Array<std::uint32_t>& place,
                           Job& job) {
  const std::size_t vertices = place.size();
  // All vertices in order, padded to whole triangles, which the library requires.
  Array<std::uint32_t> order(job, (vertices + 2) / 3 * 3);
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = static_cast<std::uint32_t>(std::min(i, vertices - 1));
  return meshopt_generateVertexRemapMulti(place.data(), order.data(), order.size(), vertices, streams.data(),
                                          streams.size());
}

template <class T>
void clear_negative_zeros(Array<T>& values) {
  for (T& value : values) value += T(0.0F);
}

template <class T>
void gather(Array<T>& values, const Array<std::uint32_t>& place, std::size_t count) {
  if (values.empty()) return;
  // A vertex never moves to a higher index, so this works in new_index.
  for (std::size_t i = 0; i < place.size(); ++i) values[place[i]] = values[i];
  values.resize(count);
  values.shrink_to_fit();
}

}  // namespace

void weld(Mesh& mesh, Job& job) {
  const std::size_t vertices = mesh.position.size();
  if (vertices == 0 || mesh.index.wide.empty()) return;
  job.check();
  clear_negative_zeros(mesh.position);
  clear_negative_zeros(mesh.normal);
  for (auto& uv : mesh.uv) clear_negative_zeros(uv);
  std::vector<meshopt_Stream> streams;
  add_stream(streams, mesh.position);
  add_stream(streams, mesh.normal);
  for (auto& uv : mesh.uv) add_stream(streams, uv);
  add_stream(streams, mesh.color);
  add_stream(streams, mesh.tangent);
  add_stream(streams, mesh.joints);
  add_stream(streams, mesh.weights);
  Array<std::uint32_t> place(job, vertices);
  const std::size_t count =
      vertices <= few_vertices ? number_pairwise(streams, place.span()) : number_by_hash(streams, place, job);
  if (count == vertices) return;
  gather(mesh.position, place, count);
  gather(mesh.normal, place, count);
  for (auto& uv : mesh.uv) gather(uv, place, count);
  gather(mesh.color, place, count);
  gather(mesh.tangent, place, count);
  gather(mesh.joints, place, count);
  gather(mesh.weights, place, count);
  for (std::uint32_t& corner : mesh.index.wide) corner = place[corner];
}

}  // namespace seedmesh
