#include "tests/support/mesh_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <unordered_map>
#include <utility>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

using Face = std::array<std::uint32_t, 3>;

template <class T>
void count_floats(const Array<T>& values, MeshMeasures& m) {
  const auto* numbers = reinterpret_cast<const float*>(values.data());
  for (std::size_t i = 0; i < values.bytes() / sizeof(float); ++i) {
    if (!std::isfinite(numbers[i])) ++m.not_finite;
    if (numbers[i] == 0 && std::signbit(numbers[i])) ++m.negative_zeros;
  }
}

template <class T>
void hash_bytes(std::uint64_t& hash, const Array<T>& values, std::size_t i) {
  if (values.empty()) return;
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data() + i);
  for (std::size_t k = 0; k < sizeof(T); k += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes + k, std::min<std::size_t>(4, sizeof(T) - k));
    hash = key_at(hash, word);
  }
}

/// Compares 64-bit hashes. Two different vertices collide with a probability of about 5e-20 per pair.
std::uint64_t duplicates_of(const Mesh& mesh) {
  std::vector<std::uint64_t> rows(mesh.position.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    hash_bytes(rows[i], mesh.position, i);
    hash_bytes(rows[i], mesh.normal, i);
    for (const auto& uv : mesh.uv) hash_bytes(rows[i], uv, i);
    hash_bytes(rows[i], mesh.color, i);
    hash_bytes(rows[i], mesh.tangent, i);
    hash_bytes(rows[i], mesh.joints, i);
    hash_bytes(rows[i], mesh.weights, i);
    hash_bytes(rows[i], mesh.bone, i);
  }
  std::sort(rows.begin(), rows.end());
  return static_cast<std::uint64_t>(rows.end() - std::unique(rows.begin(), rows.end()));
}

void simulate_cache(const Mesh& mesh, std::uint64_t& misses, std::uint64_t& used) {
  constexpr std::int64_t entries = 16, never = -1;
  std::vector<std::int64_t> loaded_at(mesh.position.size(), never);
  std::int64_t loads = 0;
  for (std::size_t i = 0; i < mesh.index.size(); ++i) {
    std::int64_t& at = loaded_at[mesh.index.at(i)];
    if (at == never) ++used;
    if (at == never || loads - at > entries) at = loads++;
  }
  misses += static_cast<std::uint64_t>(loads);
}

double diagonal(const Box& box) { return glm::length(glm::dvec3(box.max) - glm::dvec3(box.min)); }

void measure_triangles(const Mesh& mesh, MeshMeasures& m) {
  const double size = diagonal(bounds_of(mesh.position.span()));
  for (std::size_t t = 0; t < mesh.index.size() / 3; ++t) {
    const Face f{mesh.index.at(3 * t), mesh.index.at(3 * t + 1), mesh.index.at(3 * t + 2)};
    const glm::dvec3 a = mesh.position[f[0]], b = mesh.position[f[1]], c = mesh.position[f[2]];
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (!(0.5 * glm::length(normal) > 1e-12 * size * size)) {
      ++m.zero_area;
      continue;
    }
    m.area += 0.5 * glm::length(normal);
    m.volume += glm::dot(a, glm::cross(b, c)) / 6;
    for (std::uint32_t corner : f) {
      if (!mesh.normal.empty() && glm::dot(normal, glm::dvec3(mesh.normal[corner])) < 0) ++m.flipped_corners;
    }
  }
}

void measure_one(const Mesh& mesh, MeshMeasures& m, std::uint64_t& misses, std::uint64_t& used) {
  m.vertices += mesh.position.size();
  count_floats(mesh.position, m);
  count_floats(mesh.normal, m);
  for (const auto& uv : mesh.uv) count_floats(uv, m);
  count_floats(mesh.tangent, m);
  count_floats(mesh.weights, m);
  for (const glm::vec3& n : mesh.normal) {
    if (!(std::abs(glm::length(glm::dvec3(n)) - 1) <= 0.001)) ++m.not_unit;
  }
  m.duplicates += duplicates_of(mesh);
  if (!mesh.index.wide.empty() && mesh.position.size() <= 65'535) ++m.wide_indices;

  std::vector<bool> is_used(mesh.position.size(), mesh.index.size() == 0);
  std::uint64_t bad = 0;
  for (std::size_t i = 0; i < mesh.index.size(); ++i) {
    if (mesh.index.at(i) < is_used.size()) {
      is_used[mesh.index.at(i)] = true;
    } else {
      ++bad;
    }
  }
  m.bad_indices += bad;
  m.unused += static_cast<std::uint64_t>(std::count(is_used.begin(), is_used.end(), false));
  if (bad || mesh.topology != Topology::triangles) return;
  m.triangles += mesh.elements();
  simulate_cache(mesh, misses, used);
  measure_triangles(mesh, m);
}

/// Assigns the same number to points within `reach` of an earlier point.
class Welder {
 public:
  explicit Welder(double reach) : reach_(reach) {}
  std::uint32_t number(const glm::vec3& point) {
    const glm::dvec3 in_cells = glm::dvec3(point) / (8 * reach_);
    const glm::dvec3 cell = glm::floor(in_cells);
    const glm::dvec3 low = glm::floor(in_cells - 0.125), high = glm::floor(in_cells + 0.125);
    for (double z = low.z; z <= high.z; ++z) {
      for (double y = low.y; y <= high.y; ++y) {
        for (double x = low.x; x <= high.x; ++x) {
          const auto found = cells_.find(key({x, y, z}));
          for (std::uint32_t id = found == cells_.end() ? none : found->second; id != none; id = next_[id]) {
            if (glm::length(glm::dvec3(points_[id]) - glm::dvec3(point)) <= reach_) return id;
          }
        }
      }
    }
    const auto id = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    const auto [first, is_new] = cells_.try_emplace(key(cell), id);
    next_.push_back(is_new ? none : std::exchange(first->second, id));
    return id;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  static std::uint64_t key(const glm::dvec3& cell) {
    std::uint64_t k = 0;
    for (int axis = 0; axis < 3; ++axis)
      k = key_at(k, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis])));
    return k;
  }
  double reach_;
  std::vector<glm::vec3> points_;
  std::vector<std::uint32_t> next_;
  std::unordered_map<std::uint64_t, std::uint32_t> cells_;
};

void measure_topology(const std::vector<const Mesh*>& primitives, MeshMeasures& m) {
  Box box{glm::vec3(1e30F), glm::vec3(-1e30F)};
  for (const Mesh* mesh : primitives) {
    if (mesh->topology != Topology::triangles || mesh->position.empty()) continue;
    const Box part = bounds_of(mesh->position.span());
    box = {glm::min(box.min, part.min), glm::max(box.max, part.max)};
  }
  if (box.min.x > box.max.x) return;
  Welder weld(std::max(1e-6 * diagonal(box), 1e-30));
  std::vector<std::uint64_t> edges;  // the lower index, the higher index, and the direction in the last bit
  std::vector<Face> faces;
  for (const Mesh* mesh : primitives) {
    if (mesh->topology != Topology::triangles) continue;
    std::vector<std::uint32_t> ids;
    for (const glm::vec3& p : mesh->position) ids.push_back(weld.number(p));
    for (std::size_t t = 0; t < mesh->index.size() / 3; ++t) {
      Face f{ids[mesh->index.at(3 * t)], ids[mesh->index.at(3 * t + 1)], ids[mesh->index.at(3 * t + 2)]};
      if (f[0] == f[1] || f[1] == f[2] || f[0] == f[2]) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint64_t p = f[k], q = f[(k + 1) % 3];
        edges.push_back(std::min(p, q) << 33U | std::max(p, q) << 1U | (p < q ? 1U : 0U));
      }
      std::sort(f.begin(), f.end());
      faces.push_back(f);
    }
  }
  std::sort(faces.begin(), faces.end());
  m.duplicate_faces += static_cast<std::uint64_t>(faces.end() - std::unique(faces.begin(), faces.end()));
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t times = 0, upward = 0;
    for (const std::uint64_t edge = edges[i] >> 1U; i < edges.size() && edges[i] >> 1U == edge; ++i, ++times)
      upward += edges[i] & 1U;
    if (times == 1) ++m.open_edges;
    if (times > 2) ++m.over_used_edges;
    if (times == 2 && upward != 1) ++m.inconsistent_edges;
  }
}

void say(std::vector<std::string>& out, std::uint64_t count, const char* what) {
  if (count) out.push_back(std::to_string(count) + " " + what);
}

std::vector<std::string> defects_of(const MeshMeasures& m) {
  std::vector<std::string> out;
  say(out, m.bad_indices, "indices beyond the vertices");
  say(out, m.not_finite, "numbers that are not finite");
  say(out, m.negative_zeros, "negative zeros");
  say(out, m.zero_area, "triangles without area");
  say(out, m.flipped_corners, "corners turned against their triangle");
  say(out, m.not_unit, "normals that are not of unit length");
  say(out, m.unused, "unused vertices");
  say(out, m.duplicates * 1000 > m.vertices ? m.duplicates : 0, "duplicate vertices");
  say(out, m.duplicate_faces, "duplicate faces");
  say(out, m.over_used_edges, "edges in more than two triangles");
  say(out, m.inconsistent_edges, "edges whose two triangles disagree on the outside");
  if (m.triangles > 500 && m.cache_misses_a_vertex > 1.35) {
    out.push_back(std::to_string(m.cache_misses_a_vertex) + " cache misses a vertex");
  }
  return out;
}

template <class T>
bool holds(const std::vector<T>& list, int index) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}

void check_nodes(const Model& model, std::vector<std::string>& out) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.name.empty()) {
      out.push_back("node " + std::to_string(i) + " has no name");
    } else if (!names.insert(node.name).second) {
      out.push_back("two nodes are called " + node.name);
    }
    if (node.parent >= static_cast<int>(i)) out.push_back("node " + node.name + " stands before its parent");
    if (node.mesh != -1 && !holds(model.meshes, node.mesh))
      out.push_back("node " + node.name + " names a mesh that is not there");
    if (node.skin != -1 && !holds(model.skins, node.skin))
      out.push_back("node " + node.name + " names a skin that is not there");
    for (int lod : node.lods) {
      if (!holds(model.meshes, lod)) out.push_back("node " + node.name + " names a mesh that is not there");
    }
  }
}

}  // namespace

MeshMeasures measure(const std::vector<const Mesh*>& primitives) {
  MeshMeasures m;
  std::uint64_t misses = 0, used = 0;
  for (const Mesh* mesh : primitives) measure_one(*mesh, m, misses, used);
  if (used) m.cache_misses_a_vertex = static_cast<double>(misses) / static_cast<double>(used);
  if (!m.bad_indices) measure_topology(primitives, m);
  return m;
}

std::vector<std::string> faults(const Mesh& mesh) { return defects_of(measure({&mesh})); }

std::vector<std::string> faults(const Model& model) {
  std::vector<std::string> out;
  check_nodes(model, out);
  for (const MeshGroup& group : model.meshes) {
    std::vector<const Mesh*> primitives;
    std::vector<const Mesh*> double_sided;  ///< flipped corners are not defined for these
    std::uint64_t wide = 0;
    for (const Primitive& primitive : group.primitives) {
      primitives.push_back(&primitive.mesh);
      if (primitive.material != -1 && !holds(model.materials, primitive.material)) {
        out.push_back(group.name + ": a primitive names a material that is not there");
      }
      if (holds(model.materials, primitive.material) &&
          model.materials[static_cast<std::size_t>(primitive.material)].double_sided)
        double_sided.push_back(&primitive.mesh);
      if (primitive.mesh.position.empty()) out.push_back(group.name + ": an empty primitive");
      if (!primitive.mesh.index.wide.empty() && primitive.mesh.position.size() <= 65'535) ++wide;
    }
    say(out, wide, "primitives with indices wider than need be");
    MeshMeasures measures = measure(primitives);
    MeshMeasures forgiven;
    for (const Mesh* mesh : double_sided) {
      if (measures.bad_indices == 0 && mesh->topology == Topology::triangles)
        measure_triangles(*mesh, forgiven);
    }
    measures.flipped_corners -= std::min(measures.flipped_corners, forgiven.flipped_corners);
    for (const std::string& fault : defects_of(measures)) out.push_back(group.name + ": " + fault);
  }
  return out;
}

}  // namespace seedmesh
