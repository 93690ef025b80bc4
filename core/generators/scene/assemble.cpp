#include "core/generators/scene/assemble.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "core/base/math.h"
#include "core/generators/registry.h"
#include "core/generators/scene/grow.h"
#include "core/generators/scene/levels.h"
#include "core/generators/scene/looks.h"
#include "core/model/append.h"
#include "core/model/levels.h"
#include "core/schema/json.h"
#include "core/texture/impostor.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

/// What a stand shows, and in which square of the ground.
struct Copy {
  std::uint32_t cast;
  std::uint16_t level, chunk;
  std::uint32_t stand;

  bool goes_with(const Copy& other) const {
    return cast == other.cast && level == other.level && chunk == other.chunk;
  }
};

Box box_of(const MeshGroup& group) {
  std::optional<Box> all;
  for (const Primitive& each : group.primitives) {
    const Box box = bounds_of(each.mesh);
    all = all ? Box{glm::min(all->min, box.min), glm::max(all->max, box.max)} : box;
  }
  return all.value_or(Box{});
}

/// Plants can; a house looks flat.
bool can_be_picture(const Child& request) {
  const Generator* generator = find_generator(request.generator);
  return generator && generator->has_impostor;
}

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
    const std::uint64_t others = count(model_).triangles;
    groups_.resize(pieces.models.size());
    std::size_t layer = 0;
    for (std::size_t i = 0; i < pieces.models.size(); ++i) {
      while (layer + 1 < casting_.layers.size() && casting_.layers[layer + 1].first <= i) ++layer;
      add_cast(i, layer, pieces.models[i]);
      pieces.models[i] = Model{};
    }
    if (chooses_levels(params_, job_.demand())) {
      std::vector<Stature> statures;
      for (const Group& group : groups_) statures.push_back(group.stature);
      levels_ = levels_of(params_, {ground_, planting_, casting_}, statures, others, job_);
    }
    Json told = Json::array();
    for (std::size_t i = 0; i < params_.layers.size(); ++i) told.push_back(add_layer(i));
    model_.extras.push_back({"layers", canonical_text(told)});
    for (const Warning& each : planting_.warnings) model_.warnings.push_back(each);
    tell_what_is_missing();
    return std::move(model_);
  }

 private:
  struct Group {
    std::vector<int> meshes;  ///< finest first, last of all the picture where there is one
    Stature stature;
    Grower grower;  ///< without joints: it stands still
  };

  /// What was asked for and no model could give.
  void tell_what_is_missing() {
    const Demand& demand = job_.demand();
    const auto has_picture = [](const Group& group) { return group.stature.has_picture; };
    if (demand.impostor && std::none_of(groups_.begin(), groups_.end(), has_picture))
      model_.warnings.push_back(
          {"/output/impostor", "no model has so many triangles that a picture has fewer"});
    if (demand.growth && model_.animations.empty())
      model_.warnings.push_back({"/output/animation", "nothing that stands here grows"});
  }

  /// Variants of a model warn alike.
  void cast_warnings(Model& made) {
    for (Warning& each : made.warnings) {
      if (!is_used_elsewhere(casting_, each) &&
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
    const std::string& name = casting_.casts[number].name;
    if (Taken growing = taken_to_grow(made); !growing.grower.joints.empty()) {
      own.grower = std::move(growing.grower);
      own.grower.mesh = add_mesh(name + "_growing", std::move(growing.primitives), materials);
    }
    if (const Generator* generator = find_generator(casting_.casts[number].request.generator);
        generator != nullptr && generator->parts)
      set_apart(made);
    std::vector<std::vector<Primitive>> levels = levels_made(made, job_);
    for (std::size_t level = 0; level < levels.size(); ++level) {
      const int mesh = add_mesh(name + (level > 0 ? "_LOD" + std::to_string(level) : ""),
                                std::move(levels[level]), materials);
      if (mesh < 0) continue;
      own.meshes.push_back(mesh);
      own.stature.triangles.push_back(triangles_of(model_.meshes[static_cast<std::size_t>(mesh)]));
    }
    if (!own.meshes.empty()) measure(own, casting_.casts[number]);
  }

  /// The primitives with the scene's materials; -1 where there is nothing.
  int add_mesh(std::string name, std::vector<Primitive> primitives, const std::vector<int>& materials) {
    MeshGroup group{std::move(name), {}};
    for (Primitive& each : primitives) {
      if (each.mesh.elements() == 0) continue;
      if (each.material >= 0) each.material = materials[static_cast<std::size_t>(each.material)];
      each.variant_materials.clear();
      group.primitives.push_back(std::move(each));
    }
    if (group.primitives.empty()) return -1;
    model_.meshes.push_back(std::move(group));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  /// Its size, and a picture of it where that is wanted and less than its coarsest mesh.
  void measure(Group& own, const Cast& cast) {
    const Demand& demand = job_.demand();
    const bool has_picture = wants_pictures(params_, demand) && can_be_picture(cast.request) &&
                             own.stature.triangles.back() > texture::triangles_of_impostor;
    if (!has_picture && !chooses_levels(params_, demand)) return;
    const Box box = box_of(model_.meshes[static_cast<std::size_t>(own.meshes.front())]);
    const glm::dvec3 size(box.max - box.min);
    own.stature.radius = glm::length(size) / 2;
    own.stature.middle = static_cast<double>(box.min.y + box.max.y) / 2;
    if (!has_picture) return;
    const int picture = texture::add_impostor(model_, {{.mesh = own.meshes.front(), .at = glm::mat4(1)}},
                                              cast.name + "_impostor", job_);
    if (picture < 0) return;
    own.meshes.push_back(picture);
    own.stature.has_picture = true;
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
    Array<Copy> copies(job_);
    copies.reserve(stands.size());
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < stands.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const std::uint32_t cast = casting_.cast_of(number, stands[i]);
      const std::uint16_t level = levels_.empty() ? std::uint16_t{0} : levels_[number][i];
      triangles += add_growing(cast, number, i, parent);
      if (groups_[cast].meshes.empty()) continue;
      triangles += groups_[cast].stature.triangles_at(level);
      copies.push_back({cast, level, chunk_of(stands[i].at), static_cast<std::uint32_t>(i)});
    }
    std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
      return std::tie(a.cast, a.level, a.chunk, a.stand) < std::tie(b.cast, b.level, b.chunk, b.stand);
    });
    for (std::size_t begin = 0; begin < copies.size();) {
      std::size_t end = begin;
      while (end < copies.size() && copies[end].goes_with(copies[begin])) ++end;
      add_copies(copies.span().subspan(begin, end - begin), number, parent);
      begin = end;
    }
    Json told = {
        {"name", name}, {"placed", stands.size()}, {"models", models_of(number)}, {"triangles", triangles}};
    if (!levels_.empty()) told["levels"] = levels_told(copies);
    planting_.layers[number] = Array<Stand>();  // its nodes know all of it
    return told;
  }

  /// How many models of a layer stand somewhere.
  std::size_t models_of(std::size_t layer) const {
    std::set<std::uint32_t> seen;
    for (const Stand& stand : planting_.layers[layer]) seen.insert(casting_.cast_of(layer, stand));
    return seen.size();
  }

  /// How many stand there at each level, and as pictures.
  Json levels_told(const Array<Copy>& copies) const {
    std::vector<std::size_t> meshes;
    std::size_t pictures = 0;
    for (const Copy& each : copies) {
      const Stature& stature = groups_[each.cast].stature;
      if (each.level >= stature.triangles.size()) {
        ++pictures;
        continue;
      }
      if (each.level >= meshes.size()) meshes.resize(std::size_t{each.level} + 1, 0);
      ++meshes[each.level];
    }
    return {{"meshes", meshes}, {"impostors", pictures}};
  }

  /// Its triangles; 0 where the model does not grow.
  std::uint64_t add_growing(std::uint32_t cast, std::size_t layer, std::size_t stand, int parent) {
    Grower& grower = groups_[cast].grower;
    if (grower.mesh < 0) return 0;
    add_grower(model_, grower,
               {casting_.casts[cast].name + "_" + std::to_string(stand), place_of(layer, stand), parent,
                start_of(params_.layers[layer], planting_.layers[layer][stand])});
    return triangles_of(model_.meshes[static_cast<std::size_t>(grower.mesh)]);
  }

  Transform place_of(std::size_t layer, std::size_t stand) const {
    return transform_of(planting_.layers[layer][stand], params_.layers[layer], ground_);
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
    const Group& group = groups_[copies.front().cast];
    if (group.meshes.empty()) return;
    const auto across = static_cast<std::uint32_t>(params_.chunks);
    Node node;
    node.name = casting_.casts[copies.front().cast].name;
    if (across > 1) {
      node.name += "_" + std::to_string(copies.front().chunk % across) + "_" +
                   std::to_string(copies.front().chunk / across);
    }
    const std::size_t level = copies.front().level, meshes = group.stature.triangles.size();
    if (level > 0) node.name += level < meshes ? "_LOD" + std::to_string(level) : "_impostor";
    node.parent = parent;
    node.mesh = group.meshes[level];
    const auto wanted = static_cast<std::size_t>(job_.demand().lods);
    for (std::size_t i = level + 1; i < std::min(level + wanted, meshes); ++i)
      node.lods.push_back(group.meshes[i]);
    if (job_.demand().impostor && group.stature.has_picture && level < meshes) {
      node.lods.push_back(group.meshes.back());
      node.has_impostor = true;
    }
    if (copies.size() == 1) {
      node.transform = place_of(layer, copies.front().stand);
    } else {
      node.instances.transforms.reserve(copies.size());
      for (const Copy& each : copies) node.instances.transforms.push_back(place_of(layer, each.stand));
    }
    model_.nodes.push_back(std::move(node));
  }

  const SceneParams& params_;
  const Ground& ground_;
  Planting& planting_;
  const Casting& casting_;
  Job& job_;
  Model model_;
  std::vector<Group> groups_;
  Levels levels_;                                   ///< empty: all stand at the finest
  std::vector<std::pair<int, std::size_t>> owned_;  ///< materials and the layer that brought them
  std::set<std::tuple<std::string, std::string, int, int>> seen_;
};

}  // namespace

Model assembled(const SceneParams& params, const Plan& plan, Pieces pieces, Job& job) {
  return Assembly(params, plan, job).assemble(std::move(pieces));
}

}  // namespace seedmesh::scene
