#include "core/geom/mesh/weld.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
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
constexpr std::uint64_t golden_ratio = 0x9E3779B97F4A7C15U;  // 2^64 divided by it

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

/// The hash of each vertex: of the words of all its attributes.
Array<std::uint32_t> hashes_of(const std::vector<meshopt_Stream>& streams, std::size_t vertices,
                               const Job& job) {
  constexpr std::size_t word = sizeof(std::uint32_t);
  Array<std::uint32_t> hashes(job, vertices, 0);
  for (const meshopt_Stream& stream : streams) {
    const auto* bytes = static_cast<const std::byte*>(stream.data);
    for (std::size_t i = 0; i < vertices; ++i, bytes += stream.stride) {
      std::uint64_t hash = hashes[i];
      for (std::size_t k = 0; k < stream.size; k += word) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes + k, word);
        hash = (hash + value) * golden_ratio;
        hash ^= hash >> 32U;
      }
      hashes[i] = static_cast<std::uint32_t>(hash);
    }
  }
  return hashes;
}

/// The same as number_pairwise, with a hash table of open addressing.
std::size_t number_by_hash(const std::vector<meshopt_Stream>& streams, Array<std::uint32_t>& place,
                           const Job& job) {
  constexpr std::uint32_t empty = 0xFFFFFFFFU;
  const std::size_t vertices = place.size();
  const Array<std::uint32_t> hashes = hashes_of(streams, vertices, job);
  Array<std::uint32_t> first(job, std::bit_ceil(vertices + vertices / 2), empty);  // of equal vertices
  const std::size_t mask = first.size() - 1;
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    std::size_t slot = hashes[i] & mask;
    while (first[slot] != empty && (hashes[first[slot]] != hashes[i] || !are_equal(streams, first[slot], i)))
      slot = (slot + 1) & mask;
    const bool is_new = first[slot] == empty;
    if (is_new) first[slot] = i;
    place[i] = is_new ? count++ : place[first[slot]];
  }
  return count;
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
