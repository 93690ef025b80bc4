#include "core/geom/plant/graft/color_split.h"

#include <meshoptimizer.h>

#include <algorithm>

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
// The entries of the smallest vertex caches in use, and the misses a vertex that are allowed.
constexpr unsigned cache_entries = 16;
constexpr float most_misses = 1.2F;

template <class T>
Array<T> selected(const Array<T>& from, std::span<const std::uint32_t> vertices, const Job& job) {
  Array<T> to(job, from.empty() ? 0 : vertices.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[vertices[i]];
  return to;
}

}  // namespace

std::vector<Bark> split_by_color(Mesh mesh, std::span<const std::int16_t> colors, const Job& job) {
  std::vector<Bark> barks;
  if (colors.empty()) return barks;
  std::vector<std::uint8_t> is_used(256);
  for (const std::int16_t color : colors) is_used[static_cast<std::size_t>(color)] = 1;
  if (std::count(is_used.begin(), is_used.end(), std::uint8_t{1}) == 1) {
    mesh.cache_ordered = mesh.cache_ordered && suits_cache(mesh);
    barks.push_back({colors[0], std::move(mesh)});
    return barks;
  }
  Array<std::uint32_t> number(job, mesh.position.size(), none);
  Array<std::uint32_t> vertices(job);
  for (std::size_t color = 0; color < is_used.size(); ++color) {
    if (!is_used[color]) continue;
    job.check();
    Bark bark;
    bark.color = static_cast<std::int16_t>(color);
    bark.mesh.index.wide = Array<std::uint32_t>(job);
    vertices.clear();
    for (std::size_t t = 0; t < colors.size(); ++t) {
      if (static_cast<std::size_t>(colors[t]) != color) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.index.wide[3 * t + k];
        if (number[vertex] == none) {
          number[vertex] = static_cast<std::uint32_t>(vertices.size());
          vertices.push_back(vertex);
        }
        bark.mesh.index.wide.push_back(number[vertex]);
      }
    }
    bark.mesh.position = selected(mesh.position, vertices.span(), job);
    bark.mesh.normal = selected(mesh.normal, vertices.span(), job);
    bark.mesh.uv[0] = selected(mesh.uv[0], vertices.span(), job);
    bark.mesh.bone = selected(mesh.bone, vertices.span(), job);
    bark.mesh.cache_ordered = mesh.cache_ordered && suits_cache(bark.mesh);  // strips have gaps now
    barks.push_back(std::move(bark));
    for (const std::uint32_t vertex : vertices) number[vertex] = none;
  }
  return barks;
}

bool suits_cache(const Mesh& mesh) {
  if (mesh.position.empty() || mesh.index.wide.empty()) return true;
  const meshopt_VertexCacheStatistics statistics = meshopt_analyzeVertexCache(
      mesh.index.wide.data(), mesh.index.wide.size(), mesh.position.size(), cache_entries, 0, 0);
  return statistics.atvr <= most_misses;
}

}  // namespace seedmesh
