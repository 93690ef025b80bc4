#include "core/geom/mesh/finish.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <numeric>
#include <set>
#include <span>
#include <string_view>

#include "core/base/parallel.h"
#include "core/geom/mesh/negative_zero.h"
#include "core/geom/mesh/repeated_pieces.h"

namespace seedmesh {
namespace {

// The size of the smallest vertex caches in use.
constexpr unsigned cache_entries = 16;
constexpr std::size_t many_meshes = 16;
constexpr std::size_t most_narrow = 65'535;  ///< vertices with 16-bit indices: 65,535 restarts a strip
// Size of the parts of an array that threads process.
constexpr std::size_t bytes_a_strip = std::size_t{64} << 10U;

// Godot gives a meaning to nodes whose names have these endings after '-', '_' or '$': it makes them
// collision bodies or rigid bodies, or removes them.
constexpr std::array<std::string_view, 13> meaningful_endings{
    "col", "convcol", "colonly", "convcolonly", "noimp",   "loop", "vcol",
    "occ", "occonly", "navmesh", "rigid",       "vehicle", "wheel"};

bool is_empty(const Mesh& mesh) { return mesh.vertices() == 0 || mesh.elements() == 0; }

/// Removes meshes without primitives, and updates all indices of meshes.
void drop_empty_meshes(Model& model) {
  std::vector<int> new_index(model.meshes.size(), -1);
  std::vector<MeshGroup> kept;
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    std::erase_if(model.meshes[i].primitives,
                  [](const Primitive& primitive) { return is_empty(primitive.mesh); });
    if (model.meshes[i].primitives.empty()) continue;
    new_index[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(model.meshes[i]));
  }
  model.meshes = std::move(kept);
  for (Node& node : model.nodes) {
    const auto is_empty_now = [&](int lod) {
      return lod >= 0 && new_index[static_cast<std::size_t>(lod)] < 0;
    };
    std::erase_if(node.lods, is_empty_now);
    for (int& lod : node.lods) lod = lod < 0 ? lod : new_index[static_cast<std::size_t>(lod)];
    if (node.mesh >= 0) node.mesh = new_index[static_cast<std::size_t>(node.mesh)];
    if (node.mesh < 0 && !node.lods.empty()) {
      node.mesh = node.lods.front();
      node.lods.erase(node.lods.begin());
    }
  }
}

/// Moves element i of every repeated piece to new_index[i] of that piece. Elements whose index is not below
/// `used` are removed.
template <class T>
void reorder(Array<T>& values, const Array<std::uint32_t>& new_index, std::size_t used, const Job& job) {
  const std::size_t piece = new_index.size();
  if (values.empty()) return;
  if (piece < values.size()) {
    std::vector<T> own(piece);
    for (std::size_t first = 0; first < values.size(); first += piece) {
      T* at = values.data() + first;
      std::copy_n(at, piece, own.data());
      for (std::size_t i = 0; i < piece; ++i) at[new_index[i]] = own[i];
    }
    return;
  }
  Array<T> moved(job, used);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (new_index[i] < used) moved[new_index[i]] = values[i];
  }
  values = std::move(moved);
}

/// Replaces -0, computes bounds and narrows indices, in strips of arrays that threads share.
class LastLook {
 public:
  /// Adds all strips of a mesh. Those of its positions come first.
  void add(Mesh& mesh, const Job& job) {
    const bool is_clean = mesh.no_minus_zero;
    boxes_.push_back({&mesh, strips_.size()});
    cut(mesh.position, [this, is_clean](std::span<glm::vec3> points, std::size_t strip) {
      if (!is_clean) clear_minus_zeros(&points.front().x, 3 * points.size());
      box_[strip] = bounds_of(points);
    });
    boxes_.back().end = strips_.size();
    if (!is_clean) {
      add_floats(mesh.normal);
      add_floats(mesh.uv[0]);
      add_floats(mesh.tangent);
    }
    for (std::size_t set = 1; set < mesh.uv.size(); ++set) add_floats(mesh.uv[set]);
    add_floats(mesh.weights);
    if (mesh.index.wide.empty() || mesh.position.size() > most_narrow) return;
    mesh.index.small = Array<std::uint16_t>(job, mesh.index.wide.size());
    narrowed_.push_back(&mesh);
    cut(mesh.index.wide, [&mesh](std::span<const std::uint32_t> wide, std::size_t) {
      std::uint16_t* to = mesh.index.small.data() + (wide.data() - mesh.index.wide.data());
      for (const std::uint32_t index : wide) *to++ = static_cast<std::uint16_t>(index);
    });
  }

  void look(const Job& job) {
    box_.resize(strips_.size());
    // Strips at about the same share of all arrays are neighbours: one thread may have them in its cache.
    std::vector<std::size_t> order(strips_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strips_[a].where < strips_[b].where; });
    parallel_for(job, order.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
      job.check();
      strips_[order[i]].look(order[i]);
    });
    for (const Boxes& boxes : boxes_) {
      Box box = box_[boxes.begin];
      for (std::size_t i = boxes.begin; i < boxes.end; ++i)
        box = {glm::min(box.min, box_[i].min), glm::max(box.max, box_[i].max)};
      boxes.mesh->bounds = box;
    }
    for (Mesh* mesh : narrowed_) mesh->index.wide = Array<std::uint32_t>(job);
  }

 private:
  struct Strip {
    float where;  ///< its middle, as a share of the array
    std::function<void(std::size_t)> look;
  };
  struct Boxes {
    Mesh* mesh;
    std::size_t begin, end = 0;
  };

  /// Adds strips that call visit(elements, number of the strip).
  template <class T, class Look>
  void cut(Array<T>& values, const Look& look) {
    constexpr std::size_t length = bytes_a_strip / sizeof(T);
    for (std::size_t first = 0; first < values.size(); first += length) {
      const std::span<T> part = values.span().subspan(first, std::min(length, values.size() - first));
      const float middle = static_cast<float>(first) + 0.5F * static_cast<float>(part.size());
      strips_.push_back({middle / static_cast<float>(values.size()),
                         [look, part](std::size_t strip) { look(part, strip); }});
    }
  }

  template <class T>
  void add_floats(Array<T>& values) {
    static_assert(sizeof(T) % sizeof(float) == 0);
    cut(values, [](std::span<T> part, std::size_t) {
      clear_minus_zeros(reinterpret_cast<float*>(part.data()), part.size_bytes() / sizeof(float));
    });
  }

  std::vector<Strip> strips_;
  std::vector<Box> box_;  ///< of each strip
  std::vector<Boxes> boxes_;
  std::vector<Mesh*> narrowed_;
};

bool ends_with_meaning(const std::string& name) {
  const std::size_t mark = name.find_last_of("-_$");
  if (mark == std::string::npos) return false;
  std::string ending = name.substr(mark + 1);
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(meaningful_endings.begin(), meaningful_endings.end(), ending) != meaningful_endings.end();
}

/// Makes names unique: "leaf", "leaf_2", "leaf_3", ...
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
    // The name of a collision shape follows the convention of an engine, which includes the ending.
    if (node.collision == CollisionShape::none || node.name.empty())
      node.name = nodes.unique(node.name, "node");
  }
  for (MeshGroup& group : model.meshes) group.name = meshes.unique(group.name, "mesh");
  for (Material& material : model.materials) material.name = materials.unique(material.name, "material");
}

}  // namespace

void order_for_cache(Mesh& mesh, const Job& job) {
  if (mesh.cache_ordered || mesh.topology != Topology::triangles || mesh.index.wide.empty()) return;
  job.check();
  Array<std::uint32_t>& index = mesh.index.wide;
  // Where the mesh repeats one piece, that piece is ordered and repeated.
  Repeats piece = repeats_of(index, mesh.position.size());
  if (piece.corners == 0) piece = {mesh.position.size(), index.size()};
  Array<std::uint32_t> ordered(job, piece.corners);
  meshopt_optimizeVertexCacheFifo(ordered.data(), index.data(), piece.corners, piece.vertices, cache_entries);
  Array<std::uint32_t> new_index(job, piece.vertices);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_index.data(), ordered.data(), piece.corners, piece.vertices);
  bool is_ordered = true;
  for (std::size_t i = 0; i < piece.corners; ++i) {
    ordered[i] = new_index[ordered[i]];
    is_ordered = is_ordered && ordered[i] == index[i];
  }
  mesh.cache_ordered = true;
  if (is_ordered && used == piece.vertices) return;
  std::uint32_t shift = 0;
  for (std::size_t first = 0; first < index.size(); first += piece.corners) {
    for (std::size_t i = 0; i < piece.corners; ++i) index[first + i] = ordered[i] + shift;
    shift += static_cast<std::uint32_t>(piece.vertices);
  }
  reorder(mesh.position, new_index, used, job);
  reorder(mesh.normal, new_index, used, job);
  for (auto& uv : mesh.uv) reorder(uv, new_index, used, job);
  reorder(mesh.color, new_index, used, job);
  reorder(mesh.tangent, new_index, used, job);
  reorder(mesh.joints, new_index, used, job);
  reorder(mesh.weights, new_index, used, job);
  reorder(mesh.bone, new_index, used, job);
}

void finish_meshes(Model& model, const Job& job) {
  std::vector<Mesh*> meshes;
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) meshes.push_back(&primitive.mesh);
  }
  std::erase_if(meshes, [](const Mesh* mesh) { return mesh->packed || is_empty(*mesh); });
  // Many meshes are shared among the threads as wholes, few meshes as strips of their arrays.
  const auto finish_from = [&](std::size_t begin, std::size_t end) {
    parallel_for(job, end - begin, 1,
                 [&](std::size_t i, std::size_t, std::size_t) { order_for_cache(*meshes[begin + i], job); });
    LastLook last;
    for (std::size_t i = begin; i < end; ++i) last.add(*meshes[i], job);
    last.look(job);
  };
  if (meshes.size() < many_meshes) return finish_from(0, meshes.size());
  parallel_for(job, meshes.size(), 1,
               [&](std::size_t begin, std::size_t end, std::size_t) { finish_from(begin, end); });
}

void finish(Model& model, Job& job) {
  drop_empty_meshes(model);
  finish_meshes(model, job);
  name_everything(model);
}

}  // namespace seedmesh
