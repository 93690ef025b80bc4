#include "core/generators/scene/assemble.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/base/math.h"
#include "core/generators/api.h"
#include "core/generators/scene/grow.h"
#include "core/generators/scene/levels.h"
#include "core/generators/scene/model_levels.h"
#include "core/model/append.h"
#include "core/model/build.h"
#include "core/model/levels.h"
#include "core/schema/json.h"
#include "core/texture/impostor.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

/// The variant and level of a placement, and its square of the ground.
struct Copy {
  std::uint32_t variant;
  std::uint16_t level, chunk;
  std::uint32_t placement;

  bool goes_with(const Copy& other) const {
    return variant == other.variant && level == other.level && chunk == other.chunk;
  }
};

std::string georeference_text(const SceneGeoreference& georeference) {
  Json text = {{"latitude", georeference.latitude}, {"longitude", georeference.longitude}};
  if (georeference.projection) text["projection"] = *georeference.projection;
  return canonical_text(text);
}

Box box_of(const MeshGroup& group) {
  std::optional<Box> all;
  for (const Primitive& each : group.primitives) {
    const Box box = bounds_of(each.mesh);
    all = all ? Box{glm::min(all->min, box.min), glm::max(all->max, box.max)} : box;
  }
  return all.value_or(Box{});
}

class Assembly {
 public:
  Assembly(const SceneParams& params, const Plan& plan, const GenerateContext& context)
      : params_(params),
        ground_(plan.ground),
        all_placements_(plan.all_placements),
        variant_table_(plan.variant_table),
        context_(context),
        job_(context.job) {
    model_.name = "scene";
    add_node(model_, "scene", -1);
  }

  Model assemble(Pieces pieces) {
    for (Model& made : pieces.models) cast_warnings(made);
    append(model_, std::move(pieces.ground), 0, {});
    const std::uint64_t others = count(model_).triangles;
    groups_.resize(pieces.models.size());
    std::size_t layer = 0;
    for (std::size_t i = 0; i < pieces.models.size(); ++i) {
      while (layer + 1 < variant_table_.layers.size() && variant_table_.layers[layer + 1].first <= i) ++layer;
      add_cast(i, layer, pieces.models[i]);
      pieces.models[i] = Model{};
    }
    if (chooses_levels(params_, context_.demand)) {
      std::vector<LodInfo> lod_infos;
      for (const Group& group : groups_) lod_infos.push_back(group.lod_info);
      levels_ = levels_of(params_, {ground_, all_placements_, variant_table_}, lod_infos, others, context_);
    }
    Json summary = Json::array();
    for (std::size_t i = 0; i < params_.layers.size(); ++i) summary.push_back(add_layer(i));
    model_.extras.push_back({"layers", canonical_text(summary)});
    if (params_.georeference)
      model_.extras.push_back({"georeference", georeference_text(*params_.georeference)});
    for (const Warning& each : all_placements_.warnings) model_.warnings.push_back(each);
    tell_what_is_missing();
    return std::move(model_);
  }

 private:
  const Generator* generator_of(const ModelVariant& variant) const {
    return find_generator(context_.generators, variant.request.generator);
  }

  struct Group {
    std::vector<int> meshes;  ///< finest first, then the impostor if there is one
    LodInfo lod_info;
    GrowingPlant growing_plant;  ///< without joints there is no growth
  };

  /// Warns of requested features that no model could provide.
  void tell_what_is_missing() {
    const Demand& demand = context_.demand;
    const auto has_impostor = [](const Group& group) { return group.lod_info.has_impostor; };
    if (demand.impostor && std::none_of(groups_.begin(), groups_.end(), has_impostor))
      model_.warnings.push_back({"/output/impostor", "every model has fewer triangles than an impostor"});
    if (demand.growth && model_.animations.empty())
      model_.warnings.push_back({"/output/animation", "no placed model grows"});
  }

  /// Removes duplicates, because variants of a model have the same warnings.
  void cast_warnings(Model& made) {
    for (Warning& each : made.warnings) {
      if (!is_used_elsewhere(variant_table_, each) &&
          seen_.insert({each.pointer, each.message, each.line, each.column}).second)
        model_.warnings.push_back(std::move(each));
    }
  }

  void add_cast(std::size_t number, std::size_t layer, Model& made) {
    if (made.nodes.empty()) return;
    std::vector<int> materials;
    for (Material& material : made.materials)
      materials.push_back(add_material(std::move(material), made, layer));
    Group& own = groups_[number];
    const std::string& name = variant_table_.variants[number].name;
    if (ExtractedPlant growing = extract_growing_plant(made); !growing.growing_plant.joints.empty()) {
      own.growing_plant = std::move(growing.growing_plant);
      own.growing_plant.mesh = add_mesh(name + "_growing", std::move(growing.primitives), materials);
    }
    if (generator_of(variant_table_.variants[number])->repeats_parts)
      separate_bodies(made, context_.demand.packs ? Vertices::quantized : Vertices::exact);
    std::vector<std::vector<Primitive>> levels = extract_levels(made, job_);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const int mesh = add_mesh(level_name(name, level), std::move(levels[level]), materials);
      if (mesh < 0) continue;
      own.meshes.push_back(mesh);
      own.lod_info.triangles.push_back(triangles_of(model_.meshes[static_cast<std::size_t>(mesh)]));
    }
    if (!own.meshes.empty()) measure(own, variant_table_.variants[number]);
  }

  /// Adds the primitives with the materials of the scene. Returns -1 where there are none.
  int add_mesh(std::string name, std::vector<Primitive> primitives, const std::vector<int>& materials) {
    MeshGroup group{std::move(name), {}};
    for (Primitive& each : primitives) {
      if (each.mesh.elements() == 0) continue;
      if (each.material >= 0) each.material = materials[static_cast<std::size_t>(each.material)];
      each.variant_materials.clear();
      group.primitives.push_back(std::move(each));
    }
    return group.primitives.empty() ? -1 : seedmesh::add_mesh(model_, std::move(group));
  }

  /// Measures a variant and adds an impostor where it is requested and has fewer triangles than the coarsest
  /// mesh.
  void measure(Group& own, const ModelVariant& variant) {
    const Demand& demand = context_.demand;
    const bool has_impostor = wants_impostors(params_, demand) && generator_of(variant)->has_impostor &&
                              own.lod_info.triangles.back() > texture::triangles_of_impostor;
    if (!has_impostor && !chooses_levels(params_, demand)) return;
    const Box box = box_of(model_.meshes[static_cast<std::size_t>(own.meshes.front())]);
    const glm::dvec3 size(box.max - box.min);
    own.lod_info.radius = glm::length(size) / 2;
    own.lod_info.middle = static_cast<double>(box.min.y + box.max.y) / 2;
    if (!has_impostor) return;
    const int impostor = texture::add_impostor(model_, {{.mesh = own.meshes.front(), .at = glm::mat4(1)}},
                                               variant.name + "_impostor", job_);
    if (impostor < 0) return;
    own.meshes.push_back(impostor);
    own.lod_info.has_impostor = true;
  }

  int add_material(Material material, const Model& made, std::size_t layer) {
    for (TextureUse* use : material.textures()) {
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

  /// Adds the nodes of a layer and returns its summary.
  Json add_layer(std::size_t number) {
    const SceneLayer& layer = params_.layers[number];
    const Array<Placement>& placements = all_placements_.layers[number];
    const std::string name = layer.name.value_or("layer_" + std::to_string(number));
    const auto parent = static_cast<int>(model_.nodes.size());
    add_node(model_, name, 0);
    Array<Copy> copies(job_);
    copies.reserve(placements.size());
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < placements.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const std::uint32_t variant = variant_table_.variant_at(number, placements[i]);
      const std::uint16_t level = levels_.empty() ? std::uint16_t{0} : levels_[number][i];
      triangles += add_growing(variant, number, i, parent);
      if (groups_[variant].meshes.empty()) continue;
      triangles += groups_[variant].lod_info.triangles_at(level);
      copies.push_back({variant, level, chunk_of(placements[i].at), static_cast<std::uint32_t>(i)});
    }
    std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
      return std::tie(a.variant, a.level, a.chunk, a.placement) <
             std::tie(b.variant, b.level, b.chunk, b.placement);
    });
    for (std::size_t begin = 0; begin < copies.size();) {
      std::size_t end = begin;
      while (end < copies.size() && copies[end].goes_with(copies[begin])) ++end;
      add_copies(copies.span().subspan(begin, end - begin), number, parent);
      begin = end;
    }
    Json summary = {{"name", name},
                    {"placed", placements.size()},
                    {"models", models_of(number)},
                    {"triangles", triangles}};
    if (!levels_.empty()) summary["levels"] = levels_json(copies);
    all_placements_.layers[number] = Array<Placement>();  // the nodes hold all data now
    return summary;
  }

  /// Returns the number of variants of a layer with placements.
  std::size_t models_of(std::size_t layer) const {
    std::set<std::uint32_t> seen;
    for (const Placement& placement : all_placements_.layers[layer])
      seen.insert(variant_table_.variant_at(layer, placement));
    return seen.size();
  }

  /// Returns the number of placements at each level, and of impostors.
  Json levels_json(const Array<Copy>& copies) const {
    std::vector<std::size_t> meshes;
    std::size_t impostors = 0;
    for (const Copy& each : copies) {
      const LodInfo& lod_info = groups_[each.variant].lod_info;
      if (each.level >= lod_info.triangles.size()) {
        ++impostors;
        continue;
      }
      if (each.level >= meshes.size()) meshes.resize(std::size_t{each.level} + 1, 0);
      ++meshes[each.level];
    }
    return {{"meshes", meshes}, {"impostors", impostors}};
  }

  /// Adds a growing plant and returns its triangles, or 0 where the model does not grow.
  std::uint64_t add_growing(std::uint32_t variant, std::size_t layer, std::size_t placement, int parent) {
    GrowingPlant& growing_plant = groups_[variant].growing_plant;
    if (growing_plant.mesh < 0) return 0;
    add_growing_plant(
        model_, growing_plant,
        {variant_table_.variants[variant].name + "_" + std::to_string(placement), pose_of(layer, placement),
         parent, start_of(params_.layers[layer], all_placements_.layers[layer][placement])});
    return triangles_of(model_.meshes[static_cast<std::size_t>(growing_plant.mesh)]);
  }

  Transform pose_of(std::size_t layer, std::size_t placement) const {
    return transform_of(all_placements_.layers[layer][placement], params_.layers[layer], ground_);
  }

  std::uint16_t chunk_of(const glm::dvec2& p) const {
    const glm::dvec2 share = (p - ground_.extent().min) / ground_.extent().size();
    const auto part = [&](double value) {
      return math::to_uint32(std::clamp(value * params_.chunks, 0.0, params_.chunks - 1.0));
    };
    return static_cast<std::uint16_t>(part(share.y) * static_cast<std::uint32_t>(params_.chunks) +
                                      part(share.x));
  }

  void add_copies(std::span<const Copy> copies, std::size_t layer, int parent) {
    const Group& group = groups_[copies.front().variant];
    if (group.meshes.empty()) return;
    const auto across = static_cast<std::uint32_t>(params_.chunks);
    Node node;
    node.name = variant_table_.variants[copies.front().variant].name;
    if (across > 1) {
      node.name += "_" + std::to_string(copies.front().chunk % across) + "_" +
                   std::to_string(copies.front().chunk / across);
    }
    const std::size_t level = copies.front().level, meshes = group.lod_info.triangles.size();
    if (level > 0) node.name += level < meshes ? "_LOD" + std::to_string(level) : "_impostor";
    node.parent = parent;
    node.mesh = group.meshes[level];
    const auto wanted = static_cast<std::size_t>(context_.demand.lods);
    for (std::size_t i = level + 1; i < std::min(level + wanted, meshes); ++i)
      node.lods.push_back(group.meshes[i]);
    if (context_.demand.impostor && group.lod_info.has_impostor && level < meshes) {
      node.lods.push_back(group.meshes.back());
      node.has_impostor = true;
    }
    if (copies.size() == 1) {
      node.transform = pose_of(layer, copies.front().placement);
    } else {
      node.instances.transforms.reserve(copies.size());
      for (const Copy& each : copies) node.instances.transforms.push_back(pose_of(layer, each.placement));
    }
    model_.nodes.push_back(std::move(node));
  }

  const SceneParams& params_;
  const Ground& ground_;
  ScenePlacements& all_placements_;
  const VariantTable& variant_table_;
  const GenerateContext& context_;
  Job& job_;
  Model model_;
  std::vector<Group> groups_;
  Levels levels_;                                   ///< empty: all placements use the finest level
  std::vector<std::pair<int, std::size_t>> owned_;  ///< materials, and the layer that added them
  std::set<std::tuple<std::string, std::string, int, int>> seen_;
};

}  // namespace

Model assembled(const SceneParams& params, const Plan& plan, Pieces pieces, const GenerateContext& context) {
  return Assembly(params, plan, context).assemble(std::move(pieces));
}

}  // namespace seedmesh::scene
