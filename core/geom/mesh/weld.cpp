#include "core/geom/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace seedmesh {
namespace {

/// The bytes of an attribute.
struct Stream {
  const std::byte* data;
  std::size_t size;  ///< of a vertex: 4, 8, 12 or 16
  const std::byte* of(std::size_t vertex) const { return data + vertex * size; }
};

template <class T>
void add_stream(std::vector<Stream>& streams, Array<T>& values) {
  static_assert(sizeof(T) % 4 == 0 && sizeof(T) <= 16);
  if (!values.empty()) streams.push_back({reinterpret_cast<const std::byte*>(values.data()), sizeof(T)});
}

template <class Word>
Word load(const std::byte* at) {
  Word word = 0;
  std::memcpy(&word, at, sizeof(word));
  return word;
}

/// Meshes of at most this many vertices compare all pairs, which is faster than a hash table.
constexpr std::size_t few_vertices = 48;

bool are_equal(const std::vector<Stream>& streams, std::size_t a, std::size_t b) {
  return std::all_of(streams.begin(), streams.end(), [a, b](const Stream& stream) {
    const std::byte *const of_a = stream.of(a), *const of_b = stream.of(b);
    if (stream.size == 4) return load<std::uint32_t>(of_a) == load<std::uint32_t>(of_b);
    const std::size_t rest = stream.size - 8;  // the two words may overlap
    return load<std::uint64_t>(of_a) == load<std::uint64_t>(of_b) &&
           load<std::uint64_t>(of_a + rest) == load<std::uint64_t>(of_b + rest);
  });
}

/// Depends on the order of bytes of the processor, and therefore serves lookups only.
std::uint64_t hash_of(const std::vector<Stream>& streams, std::size_t vertex) {
  std::uint64_t hash = 0;
  const auto add = [&hash](std::uint64_t word) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  };
  for (const Stream& stream : streams) {
    if (stream.size == 4) {
      add(load<std::uint32_t>(stream.of(vertex)));
    } else {
      add(load<std::uint64_t>(stream.of(vertex)));
      if (stream.size > 8) add(load<std::uint64_t>(stream.of(vertex) + stream.size - 8));
    }
  }
  return hash * 0x9E3779B97F4A7C15U;
}

/// Sets the new number of each vertex. Returns how many vertices are different.
std::size_t number_pairwise(const std::vector<Stream>& streams, std::span<std::uint32_t> place) {
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

std::size_t number_by_hash(const std::vector<Stream>& streams, std::span<std::uint32_t> place, Job& job) {
  struct Slot {
    std::uint32_t number, tag;  ///< new number plus 1, or 0; bits of the hash that do not select the slot
  };
  const auto bits = static_cast<int>(std::bit_width(place.size() + place.size() / 3));
  const std::size_t mask = (std::size_t{1} << bits) - 1;
  Array<Slot> slots(job, mask + 1, Slot{0, 0});
  Array<std::uint32_t> first(job);  // of equal vertices, by new number
  first.reserve(place.size());
  // The slots of some vertices are fetched together, because each alone would be waited for.
  std::array<std::uint64_t, 32> hashes{};
  for (std::uint32_t i = 0; i < place.size(); ++i) {
    if (i % hashes.size() == 0) {
      const std::size_t count = std::min(hashes.size(), place.size() - i);
      for (std::size_t k = 0; k < count; ++k) {
        hashes[k] = hash_of(streams, i + k);
        __builtin_prefetch(slots.data() + (hashes[k] >> (64 - bits)), 1);
      }
    }
    const std::uint64_t hash = hashes[i % hashes.size()];
    const auto tag = static_cast<std::uint32_t>(hash);
    std::size_t at = hash >> (64 - bits);
    while (slots[at].number != 0 &&
           (slots[at].tag != tag || !are_equal(streams, first[slots[at].number - 1], i)))
      at = (at + 1) & mask;
    if (slots[at].number == 0) {
      first.push_back(i);
      slots[at] = {static_cast<std::uint32_t>(first.size()), tag};
    }
    place[i] = slots[at].number - 1;
  }
  return first.size();
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
  std::vector<Stream> streams;
  add_stream(streams, mesh.position);
  add_stream(streams, mesh.normal);
  for (auto& uv : mesh.uv) add_stream(streams, uv);
  add_stream(streams, mesh.color);
  add_stream(streams, mesh.tangent);
  add_stream(streams, mesh.joints);
  add_stream(streams, mesh.weights);
  Array<std::uint32_t> place(job, vertices);
  const std::size_t count = vertices <= few_vertices ? number_pairwise(streams, place.span())
                                                     : number_by_hash(streams, place.span(), job);
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
