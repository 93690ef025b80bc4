#include "core/geom/finish.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <set>
#include <string_view>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/geom/repeats.h"

namespace seedmesh {
namespace {

// Entries of the smallest vertex caches in use.
constexpr unsigned cache_entries = 16;
constexpr std::size_t many_meshes = 16;
// Floats that are looked through at once for -0; a small mesh has fewer positions than so many times that.
constexpr std::size_t float_chunk = std::size_t{1} << 16U, small_mesh = 4;

// What Godot makes of a node whose name ends so after '-', '_' or '$': a collision body, a rigid body,
// nothing at all.
constexpr std::array<std::string_view, 13> meaningful_endings{
    "col", "convcol", "colonly", "convcolonly", "noimp",   "loop", "vcol",
    "occ", "occonly", "navmesh", "rigid",       "vehicle", "wheel"};

bool is_empty(const Mesh& mesh) { return mesh.vertices() == 0 || mesh.elements() == 0; }

/// Meshes without primitives go, and every number that names a mesh follows.
void drop_empty_meshes(Model& model) {
  std::vector<int> new_place(model.meshes.size(), -1);
  std::vector<MeshGroup> kept;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    std::erase_if(model.meshes[i].primitives,
                  [](const Primitive& primitive) { return is_empty(primitive.mesh); });
    if (model.meshes[i].primitives.empty()) continue;
    new_place[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(model.meshes[i]));
  }
  model.meshes = std::move(kept);
  for (Node& node : model.nodes) {
    const auto is_empty_now = [&](int lod) {
      return lod >= 0 && new_place[static_cast<std::size_t>(lod)] < 0;
    };
    std::erase_if(node.lods, is_empty_now);
    for (int& lod : node.lods) lod = lod < 0 ? lod : new_place[static_cast<std::size_t>(lod)];
    if (node.mesh >= 0) node.mesh = new_place[static_cast<std::size_t>(node.mesh)];
    if (node.mesh < 0 && !node.lods.empty()) {
      node.mesh = node.lods.front();
      node.lods.erase(node.lods.begin());
    }
  }
}

/// Vertex i of each `piece` goes to new_place[i] of it; those that have no place go.
template <class T>
void reorder(Array<T>& values, const Array<std::uint32_t>& new_place, std::size_t used, const Job& job) {
  const std::size_t piece = new_place.size();
  if (values.empty()) return;
  if (piece < values.size()) {
    std::vector<T> own(piece);
    for (std::size_t first = 0; first < values.size(); first += piece) {
      T* at = values.data() + first;
      std::copy_n(at, piece, own.data());
      for (std::size_t i = 0; i < piece; ++i) at[new_place[i]] = own[i];
    }
    return;
  }
  Array<T> moved(job, used);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (new_place[i] < used) moved[new_place[i]] = values[i];
  }
  values = std::move(moved);
}

SEEDMESH_WIDE bool has_negative_zero(const float* values, std::size_t count) {
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < count; ++i)
    found |= std::bit_cast<std::uint32_t>(values[i]) == 0x80000000U ? 1U : 0U;
  return found != 0;
}

/// Reads everything and, in the common case, writes nothing.
template <class T>
void clear_negative_zeros(Array<T>& values, const Job& job) {
  static_assert(sizeof(T) % sizeof(float) == 0);
  auto* numbers = reinterpret_cast<float*>(values.data());
  parallel_for(job, values.bytes() / sizeof(float), float_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t) {
                 if (!has_negative_zero(numbers + begin, end - begin)) return;
                 for (std::size_t i = begin; i < end; ++i) numbers[i] += 0.0F;
               });
}

void clear_negative_zeros(Mesh& mesh, const Job& job) {
  clear_negative_zeros(mesh.position, job);
  clear_negative_zeros(mesh.normal, job);
  for (auto& uv : mesh.uv) clear_negative_zeros(uv, job);
  clear_negative_zeros(mesh.tangent, job);
  clear_negative_zeros(mesh.weights, job);
}

Box bounds_in_parallel(const Array<glm::vec3>& position, const Job& job) {
  std::vector<Box> parts(chunk_count(position.size(), float_chunk));
  parallel_for(job, position.size(), float_chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    parts[index] = bounds_of(position.span().subspan(begin, end - begin));
  });
  Box box = parts.front();
  for (const Box& part : parts) box = {glm::min(box.min, part.min), glm::max(box.max, part.max)};
  return box;
}

bool ends_with_meaning(const std::string& name) {
  const std::size_t mark = name.find_last_of("-_$");
  if (mark == std::string::npos) return false;
  std::string ending = name.substr(mark + 1);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(meaningful_endings.begin(), meaningful_endings.end(), ending) != meaningful_endings.end();
}

/// Gives out each name once: "leaf", "leaf_2", "leaf_3", ...
class Names {
 public:
  std::string unique(const std::string& wanted, std::string_view otherwise) {
    std::string name = wanted.empty() ? std::string(otherwise) : wanted;
    if (ends_with_meaning(name)) name += "_part";
    const std::string stem = name;
    for (int number = 2; !taken_.insert(name).second; ++number) name = stem + "_" + std::to_string(number);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

void name_everything(Model& model) {
  Names nodes, meshes, materials;
  for (Node& node : model.nodes) {
    // A collision shape is called by the convention of the engine it is for, which an ending belongs to.
    if (node.collision == CollisionShape::none || node.name.empty())
      node.name = nodes.unique(node.name, "node");
  }
  for (MeshGroup& group : model.meshes) group.name = meshes.unique(group.name, "mesh");
  for (Material& material : model.materials) material.name = materials.unique(material.name, "material");
}

void finish(Mesh& mesh, const Job& job) {
  if (mesh.packed || is_empty(mesh)) return;
  order_for_cache(mesh, job);
  narrow(mesh, job);
  clear_negative_zeros(mesh, job);
  mesh.bounds = bounds_in_parallel(mesh.position, job);
  job.check();
}

}  // namespace

void order_for_cache(Mesh& mesh, const Job& job) {
  if (mesh.cache_ordered || mesh.topology != Topology::triangles || mesh.index.wide.empty()) return;
  job.check();
  Array<std::uint32_t>& index = mesh.index.wide;
  // The order of the whole is that of one piece, repeated.
  Repeats piece = repeats_of(index, mesh.position.size());
  if (piece.corners == 0) piece = {mesh.position.size(), index.size()};
  Array<std::uint32_t> ordered(job, piece.corners);
  meshopt_optimizeVertexCacheFifo(ordered.data(), index.data(), piece.corners, piece.vertices, cache_entries);
  Array<std::uint32_t> new_place(job, piece.vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_place.data(), ordered.data(), piece.corners, piece.vertices);
  bool is_ordered = true;
  for (std::size_t i = 0; i < piece.corners; ++i) {
    ordered[i] = new_place[ordered[i]];
    is_ordered = is_ordered && ordered[i] == index[i];
  }
  mesh.cache_ordered = true;
  if (is_ordered && used == piece.vertices) return;
  std::uint32_t shift = 0;
  for (std::size_t first = 0; first < index.size(); first += piece.corners) {
    for (std::size_t i = 0; i < piece.corners; ++i) index[first + i] = ordered[i] + shift;
    shift += static_cast<std::uint32_t>(piece.vertices);
  }
  reorder(mesh.position, new_place, used, job);
  reorder(mesh.normal, new_place, used, job);
  for (auto& uv : mesh.uv) reorder(uv, new_place, used, job);
  reorder(mesh.color, new_place, used, job);
  reorder(mesh.tangent, new_place, used, job);
  reorder(mesh.joints, new_place, used, job);
  reorder(mesh.weights, new_place, used, job);
  reorder(mesh.bone, new_place, used, job);
}

void finish_meshes(Model& model, const Job& job) {
  std::vector<Mesh*> meshes;
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) meshes.push_back(&primitive.mesh);
  }
  // Many meshes side by side, and small ones; of a few great ones, each by all threads.
  const bool is_small = std::all_of(meshes.begin(), meshes.end(), [](const Mesh* mesh) {
    return 3 * mesh->position.size() < small_mesh * float_chunk;
  });
  const std::size_t together =
      is_small || meshes.size() >= many_meshes ? 1 : std::max<std::size_t>(1, meshes.size());
  parallel_for(job, meshes.size(), together, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) finish(*meshes[i], job);
  });
}

void finish(Model& model, Job& job) {
  drop_empty_meshes(model);
  finish_meshes(model, job);
  name_everything(model);
}

}  // namespace seedmesh
