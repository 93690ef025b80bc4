#include "core/model/row.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/model/append.h"
#include "core/model/build.h"

namespace seedmesh {
namespace {

constexpr float gap_share = 0.2F;

/// True where the materials differ at most in the seed of their textures.
bool may_share(const Material& a, const Material& b) {
  return a.name == b.name && a.impostor.parts.empty() && b.impostor.parts.empty() && are_alike(a, b);
}

/// Replaces images with the same bytes by the first of them.
void share_textures(Model& model) {
  std::vector<int> place(model.textures.size());
  std::vector<std::shared_ptr<const Image>> kept;
  for (std::size_t i = 0; i < model.textures.size(); ++i) {
    const auto known = std::find_if(kept.begin(), kept.end(), [&](const auto& each) {
      return each == model.textures[i] ||
             (each->mime == model.textures[i]->mime && each->bytes == model.textures[i]->bytes);
    });
    place[i] = static_cast<int>(known - kept.begin());
    if (known == kept.end()) kept.push_back(model.textures[i]);
  }
  for (Material& material : model.materials) {
    for (TextureUse* use : material.textures()) {
      if (use->texture >= 0) use->texture = place[static_cast<std::size_t>(use->texture)];
    }
  }
  model.textures = std::move(kept);
}

void share_materials(Model& model) {
  std::vector<int> place(model.materials.size());
  std::vector<Material> kept;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const auto known = std::find_if(
        kept.begin(), kept.end(), [&](const Material& each) { return may_share(each, model.materials[i]); });
    place[i] = static_cast<int>(known - kept.begin());
    if (known == kept.end()) kept.push_back(std::move(model.materials[i]));
  }
  const auto move = [&place](int& material) {
    if (material >= 0) material = place[static_cast<std::size_t>(material)];
  };
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      move(primitive.material);
      for (int& material : primitive.variant_materials) move(material);
    }
  }
  model.materials = std::move(kept);
}

/// The names of all variants, in the order of their first occurrence.
std::vector<std::string> all_variants(const std::vector<Model>& models) {
  std::vector<std::string> names;
  for (const Model& model : models) {
    for (const std::string& name : model.variants) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// Gives the primitives of `model` a material for each of `names`; where the model has no such variant, their
/// default material.
void widen_variants(Model& model, const std::vector<std::string>& names) {
  for (MeshGroup& group : model.meshes) {
    for (Primitive& primitive : group.primitives) {
      if (primitive.variant_materials.empty()) continue;
      std::vector<int> wide;
      for (const std::string& name : names) {
        const auto own = static_cast<std::size_t>(
            std::find(model.variants.begin(), model.variants.end(), name) - model.variants.begin());
        wide.push_back(own < primitive.variant_materials.size() ? primitive.variant_materials[own]
                                                                : primitive.material);
      }
      primitive.variant_materials = std::move(wide);
    }
  }
}

void drop_repeated_warnings(Model& model) {
  std::vector<Warning> kept;
  for (Warning& each : model.warnings) {
    const auto says_the_same = [&each](const Warning& other) {
      return std::tie(each.pointer, each.message, each.line, each.column) ==
             std::tie(other.pointer, other.message, other.line, other.column);
    };
    if (std::none_of(kept.begin(), kept.end(), says_the_same)) kept.push_back(std::move(each));
  }
  model.warnings = std::move(kept);
}

}  // namespace

Model row_of(std::vector<Model> models) {
  std::vector<Box> boxes;
  float widest = 0;
  for (const Model& model : models) {
    boxes.push_back(bounds_of(model));
    widest = std::max(widest, boxes.back().max.x - boxes.back().min.x);
  }
  Model row;
  row.name = models.front().name;
  row.variants = all_variants(models);
  float end = boxes.front().min.x;  // where the next model may begin
  for (std::size_t i = 0; i < models.size(); ++i) {
    widen_variants(models[i], row.variants);
    Transform at;
    at.translation.x = i == 0 ? 0 : end - boxes[i].min.x;
    end = at.translation.x + boxes[i].max.x + gap_share * widest;
    const std::size_t stand = row.nodes.size();
    std::vector<Extra> extras = std::move(models[i].extras);
    append(row, std::move(models[i]), -1, at);
    row.nodes[stand].extras = std::move(extras);
  }
  share_textures(row);
  share_materials(row);
  drop_repeated_warnings(row);
  return row;
}

}  // namespace seedmesh
