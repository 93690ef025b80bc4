#include "core/generators/scene/assemble.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/base/math.h"
#include "core/geom/flatten.h"
#include "core/geom/weld.h"
#include "core/model/append.h"
#include "core/schema/json.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

bool is_same(const TextureUse& a, const TextureUse& b) {
  return a.texture == b.texture && a.uv_set == b.uv_set && a.repeat == b.repeat;
}

enum class Seeds { must_agree, may_differ };

/// Names aside, but for the seeds of recipes where these may differ.
bool is_same(const Material& a, const Material& b, Seeds seeds) {
  const bool same_recipe = a.recipe.kind == b.recipe.kind && a.recipe.color == b.recipe.color &&
                           (seeds == Seeds::may_differ || a.recipe.seed == b.recipe.seed);
  return same_recipe && a.base_color == b.base_color && a.metallic == b.metallic &&
         a.roughness == b.roughness && a.emissive == b.emissive && a.alpha_mode == b.alpha_mode &&
         a.alpha_cutoff == b.alpha_cutoff && a.double_sided == b.double_sided && a.unlit == b.unlit &&
         is_same(a.base_color_texture, b.base_color_texture) && is_same(a.normal_texture, b.normal_texture) &&
         is_same(a.metallic_roughness_texture, b.metallic_roughness_texture) &&
         is_same(a.occlusion_texture, b.occlusion_texture) && is_same(a.emissive_texture, b.emissive_texture);
}

bool is_plain(const Transform& t) {
  return t.translation == glm::vec3(0) && t.rotation == glm::quat(1, 0, 0, 0) && t.scale == glm::vec3(1);
}

/// Do all nodes show their meshes where they are?
bool is_plain(const Model& model) {
  return std::all_of(model.nodes.begin(), model.nodes.end(), [](const Node& node) {
    return is_plain(node.transform) && node.instances.transforms.empty() && node.skin < 0;
  });
}

std::size_t levels_of(const Model& model) {
  std::size_t levels = 0;
  for (const Node& node : model.nodes) levels = std::max(levels, node.lods.size());
  return levels + 1;
}

/// What a node shows at a level: a mesh that has fewer levels shows its coarsest.
int mesh_at(const Node& node, std::size_t level) {
  if (level == 0 || node.lods.empty()) return node.mesh;
  return node.lods[std::min(level, node.lods.size()) - 1];
}

/// Does a level after this one show a mesh that this one shows?
bool is_shown_again(const Model& model, std::size_t level, std::size_t levels) {
  std::set<int> here;
  for (const Node& node : model.nodes) here.insert(mesh_at(node, level));
  here.erase(-1);
  for (std::size_t later = level + 1; later < levels; ++later) {
    for (const Node& node : model.nodes) {
      if (here.contains(mesh_at(node, later))) return true;
    }
  }
  return false;
}

/// What the nodes show at a level, taken out of the model; a mesh that two of them show in one place once.
std::vector<Primitive> taken(Model& model, std::size_t level) {
  std::vector<Primitive> primitives;
  std::set<int> seen;
  for (const Node& node : model.nodes) {
    const int mesh = mesh_at(node, level);
    if (mesh < 0 || !seen.insert(mesh).second) continue;
    for (Primitive& each : model.meshes[static_cast<std::size_t>(mesh)].primitives)
      primitives.push_back(std::move(each));
  }
  return primitives;
}

/// One mesh for each level of a model, with that model's own materials.
std::vector<std::vector<Primitive>> levels_made(Model& model, Job& job) {
  const std::size_t levels = levels_of(model);
  const bool plain = is_plain(model);
  std::vector<int> finest;
  for (const Node& node : model.nodes) finest.push_back(node.mesh);
  std::vector<std::vector<Primitive>> made;
  for (std::size_t level = 0; level < levels; ++level) {
    if (plain && !is_shown_again(model, level, levels)) {
      made.push_back(taken(model, level));
      continue;
    }
    for (Node& node : model.nodes) node.mesh = mesh_at(node, level);
    made.push_back(flatten(model, job));
    for (Primitive& each : made.back()) weld(each.mesh, job);  // parts that touch have corners in common
    for (std::size_t i = 0; i < model.nodes.size(); ++i) model.nodes[i].mesh = finest[i];
  }
  return made;
}

/// Copies of one model in one square of the ground.
struct Batch {
  std::uint32_t cast;
  std::uint32_t chunk;
  Transform transform;
};

class Assembly {
 public:
  Assembly(const SceneParams& params, const Plan& plan, Job& job)
      : params_(params), ground_(plan.ground), planting_(plan.planting), casting_(plan.casting), job_(job) {
    model_.name = "scene";
    Node root;
    root.name = "scene";
    model_.nodes.push_back(std::move(root));
  }

  Model assemble(Pieces pieces) {
    for (Model& made : pieces.models) cast_warnings(made);
    append(model_, std::move(pieces.ground), 0, {});
    groups_.resize(pieces.models.size());
    std::size_t layer = 0;
    for (std::size_t i = 0; i < pieces.models.size(); ++i) {
      while (layer + 1 < casting_.layers.size() && casting_.layers[layer + 1].first <= i) ++layer;
      add_cast(i, layer, pieces.models[i]);
      pieces.models[i] = Model{};
    }
    Json told = Json::array();
    for (std::size_t i = 0; i < params_.layers.size(); ++i) told.push_back(add_layer(i));
    model_.extras.push_back({"layers", canonical_text(told)});
    for (const Warning& each : planting_.warnings) model_.warnings.push_back(each);
    return std::move(model_);
  }

 private:
  struct Group {
    std::vector<int> meshes;  ///< finest first
    std::uint64_t triangles = 0;
  };

  /// Variants of a model warn alike.
  void cast_warnings(Model& made) {
    for (Warning& each : made.warnings) {
      if (seen_.insert({each.pointer, each.message, each.line, each.column}).second)
        model_.warnings.push_back(std::move(each));
    }
  }

  void add_cast(std::size_t number, std::size_t layer, Model& made) {
    if (made.nodes.empty()) return;
    std::vector<int> materials;
    for (Material& material : made.materials)
      materials.push_back(add_material(std::move(material), made, layer));
    std::vector<std::vector<Primitive>> levels = levels_made(made, job_);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      MeshGroup group;
      group.name = casting_.casts[number].name + (level > 0 ? "_LOD" + std::to_string(level) : "");
      for (Primitive& each : levels[level]) {
        if (each.mesh.elements() == 0) continue;
        if (each.material >= 0) each.material = materials[static_cast<std::size_t>(each.material)];
        each.variant_materials.clear();
        if (level == 0 && each.mesh.topology == Topology::triangles)
          groups_[number].triangles += each.mesh.elements();
        group.primitives.push_back(std::move(each));
      }
      if (group.primitives.empty()) continue;
      groups_[number].meshes.push_back(static_cast<int>(model_.meshes.size()));
      model_.meshes.push_back(std::move(group));
    }
  }

  int add_material(Material material, const Model& made, std::size_t layer) {
    for (TextureUse* use :
         {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      if (use->texture >= 0)
        use->texture = add_texture(made.textures[static_cast<std::size_t>(use->texture)]);
    }
    for (const auto& [index, owner] : owned_) {
      const Seeds seeds = owner == layer ? Seeds::may_differ : Seeds::must_agree;
      if (is_same(model_.materials[static_cast<std::size_t>(index)], material, seeds)) return index;
    }
    const auto index = static_cast<int>(model_.materials.size());
    owned_.emplace_back(index, layer);
    model_.materials.push_back(std::move(material));
    return index;
  }

  int add_texture(const std::shared_ptr<const Image>& image) {
    for (std::size_t i = 0; i < model_.textures.size(); ++i) {
      const Image& other = *model_.textures[i];
      if (model_.textures[i] == image || (other.mime == image->mime && other.bytes == image->bytes))
        return static_cast<int>(i);
    }
    model_.textures.push_back(image);
    return static_cast<int>(model_.textures.size()) - 1;
  }

  /// The nodes of a layer; what is told of it.
  Json add_layer(std::size_t number) {
    const SceneLayer& layer = params_.layers[number];
    const Array<Stand>& stands = planting_.layers[number];
    const std::string name = layer.name.value_or("layer_" + std::to_string(number));
    const auto parent = static_cast<int>(model_.nodes.size());
    Node node;
    node.name = name;
    node.parent = 0;
    model_.nodes.push_back(std::move(node));
    std::vector<Batch> batches;
    batches.reserve(stands.size());
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < stands.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const std::uint32_t cast = casting_.cast_of(number, stands[i]);
      triangles += groups_[cast].triangles;
      batches.push_back({cast, chunk_of(stands[i].at), transform_of(stands[i], layer, ground_)});
    }
    std::stable_sort(batches.begin(), batches.end(), [](const Batch& a, const Batch& b) {
      return std::tie(a.cast, a.chunk) < std::tie(b.cast, b.chunk);
    });
    std::size_t models = 0;
    std::uint32_t last = 0xFFFFFFFFU;
    for (std::size_t begin = 0; begin < batches.size();) {
      std::size_t end = begin;
      while (end < batches.size() && batches[end].cast == batches[begin].cast &&
             batches[end].chunk == batches[begin].chunk)
        ++end;
      add_batch({batches.data() + begin, end - begin}, parent);
      models += batches[begin].cast != last ? 1U : 0U;
      last = batches[begin].cast;
      begin = end;
    }
    return {{"name", name}, {"placed", stands.size()}, {"models", models}, {"triangles", triangles}};
  }

  std::uint32_t chunk_of(const glm::dvec2& p) const {
    const glm::dvec2 share = (p - ground_.extent().min) / ground_.extent().size();
    const auto part = [&](double value) {
      return math::to_uint32(std::clamp(value * params_.chunks, 0.0, params_.chunks - 1.0));
    };
    return part(share.y) * static_cast<std::uint32_t>(params_.chunks) + part(share.x);
  }

  void add_batch(std::span<const Batch> batch, int parent) {
    const Group& group = groups_[batch.front().cast];
    if (group.meshes.empty()) return;
    const auto across = static_cast<std::uint32_t>(params_.chunks);
    Node node;
    node.name = casting_.casts[batch.front().cast].name;
    if (across > 1) {
      node.name += "_" + std::to_string(batch.front().chunk % across) + "_" +
                   std::to_string(batch.front().chunk / across);
    }
    node.parent = parent;
    node.mesh = group.meshes.front();
    node.lods.assign(group.meshes.begin() + 1, group.meshes.end());
    if (batch.size() == 1) {
      node.transform = batch.front().transform;
    } else {
      node.instances.transforms.reserve(batch.size());
      for (const Batch& each : batch) node.instances.transforms.push_back(each.transform);
    }
    model_.nodes.push_back(std::move(node));
  }

  const SceneParams& params_;
  const Ground& ground_;
  const Planting& planting_;
  const Casting& casting_;
  Job& job_;
  Model model_;
  std::vector<Group> groups_;
  std::vector<std::pair<int, std::size_t>> owned_;  ///< materials and the layer that brought them
  std::set<std::tuple<std::string, std::string, int, int>> seen_;
};

}  // namespace

Model assembled(const SceneParams& params, const Plan& plan, Pieces pieces, Job& job) {
  return Assembly(params, plan, job).assemble(std::move(pieces));
}

}  // namespace seedmesh::scene
