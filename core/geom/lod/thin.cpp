#include "core/geom/lod/thin.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "core/base/disjoint_sets.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t fewest_pieces = 16;   ///< of a mesh that may lose some
constexpr std::uint32_t most_triangles = 64;  ///< of a leaf
constexpr float largest_growth = 2;
constexpr std::size_t check_interval = 65'536;

/// The connected pieces of a mesh. Faces are connected by a common vertex, or by an edge at the same
/// position, which includes hard edges. Leaves that only touch at one position are separate pieces.
struct Pieces {
  std::vector<std::uint32_t> of_vertex;
  std::vector<std::uint32_t> first;      ///< the least vertex of each
  std::vector<std::uint32_t> triangles;  ///< of each
};

/// For each vertex the lowest vertex at the same position.
std::vector<std::uint32_t> least_at_position(const Mesh& mesh, const Job& job) {
  std::vector<std::uint32_t> order(mesh.position.size()), least(mesh.position.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto at = [&mesh](std::uint32_t v) {
    const glm::vec3& p = mesh.position[v];
    return std::tuple(p.x + 0.0F, p.y + 0.0F, p.z + 0.0F);
  };
  std::size_t steps = 0;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (++steps % check_interval == 0) job.check();
    return at(a) != at(b) ? at(a) < at(b) : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    least[order[i]] = i > 0 && at(order[i]) == at(order[i - 1]) ? least[order[i - 1]] : order[i];
  }
  return least;
}

Pieces pieces_of(const Mesh& mesh, const Job& job) {
  DisjointSets sets(mesh.position.size());
  const std::vector<std::uint32_t> least = least_at_position(mesh, job);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges;  // two positions, a vertex at one of them
  edges.reserve(mesh.index.size());
  for (std::size_t i = 0; i < mesh.index.size(); ++i) {
    if (i % check_interval == 0) job.check();
    sets.join(mesh.index.at(i / 3 * 3), mesh.index.at(i));
    const std::uint32_t a = mesh.index.at(i), b = mesh.index.at(i % 3 == 2 ? i - 2 : i + 1);
    const std::uint64_t low = std::min(least[a], least[b]), high = std::max(least[a], least[b]);
    edges.emplace_back(low << 32U | high, a);
  }
  std::size_t steps = 0;
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
    if (++steps % check_interval == 0) job.check();
    return a < b;
  });
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (i % check_interval == 0) job.check();
    if (edges[i].first == edges[i - 1].first) sets.join(edges[i].second, edges[i - 1].second);
  }
  Pieces pieces;
  pieces.of_vertex.resize(sets.size());
  for (std::uint32_t v = 0; v < sets.size(); ++v) {
    if (v % check_interval == 0) job.check();
    if (sets.of(v) == v) {
      pieces.of_vertex[v] = static_cast<std::uint32_t>(pieces.first.size());
      pieces.first.push_back(v);
    } else {
      pieces.of_vertex[v] = pieces.of_vertex[sets.of(v)];
    }
  }
  pieces.triangles.assign(pieces.first.size(), 0);
  for (std::size_t i = 0; i < mesh.index.size(); i += 3)
    ++pieces.triangles[pieces.of_vertex[mesh.index.at(i)]];
  return pieces;
}

/// Twice the area of each piece, and the sum of its area vectors.
struct Areas {
  std::vector<double> area;
  std::vector<glm::dvec3> sum;
};

Areas areas_of(const Mesh& mesh, const Pieces& pieces, const Job& job) {
  Areas areas{std::vector<double>(pieces.first.size(), 0),
              std::vector<glm::dvec3>(pieces.first.size(), glm::dvec3(0))};
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    if (i % (3 * check_interval) == 0) job.check();
    const glm::dvec3 a(mesh.position[mesh.index.at(i)]);
    const glm::dvec3 across = glm::cross(glm::dvec3(mesh.position[mesh.index.at(i + 1)]) - a,
                                         glm::dvec3(mesh.position[mesh.index.at(i + 2)]) - a);
    const std::uint32_t piece = pieces.of_vertex[mesh.index.at(i)];
    areas.sum[piece] += across;
    areas.area[piece] += std::sqrt(glm::dot(across, across));
  }
  return areas;
}

/// The number of small open pieces. The area vectors of a closed piece have the sum 0.
std::size_t count_leaves(const Pieces& pieces, const Areas& areas) {
  std::size_t leaves = 0;
  for (std::size_t i = 0; i < areas.sum.size(); ++i) {
    const bool open = glm::dot(areas.sum[i], areas.sum[i]) > 1e-4 * areas.area[i] * areas.area[i];
    leaves += open && pieces.triangles[i] <= most_triangles ? 1 : 0;
  }
  return leaves;
}

/// Removes the triangles of all other pieces.
void keep_pieces(Mesh& mesh, const Pieces& pieces, const std::vector<bool>& stays) {
  Array<std::uint32_t>& index = mesh.index.wide;
  std::size_t end = 0;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    if (!stays[pieces.of_vertex[index[i]]]) continue;
    for (std::size_t c = 0; c < 3; ++c) index[end++] = index[i + c];
  }
  index.resize(end);
  mesh.cache_ordered = false;
}

/// True where at least `fewest_pieces` sets of triangles share no vertices. Pieces are unions of such sets, so that a
/// mesh with fewer needs no search for equal positions.
bool has_many_parts(const Mesh& mesh, const Job& job) {
  DisjointSets sets(mesh.position.size());
  for (std::size_t i = 0; i < mesh.index.size(); ++i) {
    if (i % check_interval == 0) job.check();
    sets.join(mesh.index.at(i / 3 * 3), mesh.index.at(i));
  }
  std::uint32_t parts = 0;
  std::vector<bool> is_known(mesh.position.size(), false);
  for (std::size_t i = 0; i < mesh.index.size() && parts < fewest_pieces; i += 3) {
    const std::uint32_t set = sets.of(mesh.index.at(i));
    if (!is_known[set]) ++parts;
    is_known[set] = true;
  }
  return parts >= fewest_pieces;
}

std::uint64_t place_key(const glm::vec3& p) {
  Rng rng(0);
  for (int axis = 0; axis < 3; ++axis) rng = rng.at(std::bit_cast<std::uint32_t>(p[axis] + 0.0F));
  return rng.key();
}

}  // namespace

bool is_foliage(const Mesh& mesh, const Job& job) {
  if (mesh.topology != Topology::triangles || mesh.position.empty()) return false;
  if (!has_many_parts(mesh, job)) return false;
  const Pieces pieces = pieces_of(mesh, job);
  const auto all = static_cast<std::size_t>(
      std::count_if(pieces.triangles.begin(), pieces.triangles.end(), [](std::uint32_t n) { return n > 0; }));
  return all >= fewest_pieces && count_leaves(pieces, areas_of(mesh, pieces, job)) * 10 >= all * 9;
}

void thin_sheets(Mesh& mesh, std::uint64_t target, const Job& job) {
  const Pieces pieces = pieces_of(mesh, job);
  std::vector<std::uint32_t> order(pieces.first.size());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint64_t> keys;
  for (const std::uint32_t vertex : pieces.first) keys.push_back(place_key(mesh.position[vertex]));
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  std::vector<bool> stays(order.size(), false);
  std::uint64_t kept = 0, pieces_kept = 0;
  for (const std::uint32_t piece : order) {
    if (pieces.triangles[piece] == 0) continue;  // unused vertices
    if (pieces_kept > 0 && kept + pieces.triangles[piece] > target) break;
    kept += pieces.triangles[piece];
    ++pieces_kept;
    stays[piece] = true;
  }
  const float growth = std::min(
      largest_growth,
      static_cast<float>(std::sqrt(static_cast<double>(mesh.elements()) / static_cast<double>(kept))));
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const std::uint32_t piece = pieces.of_vertex[v];
    if (!stays[piece] || v == pieces.first[piece]) continue;
    const glm::vec3 pivot = mesh.position[pieces.first[piece]];
    mesh.position[v] = pivot + growth * (mesh.position[v] - pivot);
  }
  keep_pieces(mesh, pieces, stays);
}

void drop_smallest_pieces(Mesh& mesh, std::uint64_t target, const Job& job, double most_area) {
  if (mesh.topology != Topology::triangles || mesh.elements() <= target) return;
  const Pieces pieces = pieces_of(mesh, job);
  if (pieces.first.size() < fewest_pieces) return;
  const Areas areas = areas_of(mesh, pieces, job);
  std::vector<std::uint32_t> order(pieces.first.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return areas.area[a] != areas.area[b] ? areas.area[a] < areas.area[b] : a < b;
  });
  std::vector<bool> stays(order.size(), true);
  std::uint64_t left = mesh.elements();
  for (std::size_t i = 0; i + 1 < order.size() && left > target; ++i) {
    if (areas.area[order[i]] > 2 * most_area) break;
    stays[order[i]] = false;
    left -= pieces.triangles[order[i]];
  }
  keep_pieces(mesh, pieces, stays);
}

}  // namespace seedmesh
