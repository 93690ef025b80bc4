#include "core/generators/lsystem/materials.h"

#include <algorithm>

#include "core/generators/material_members.h"
#include "core/texture/data_uri.h"

namespace seedmesh::lsystem {
namespace {

struct Look {
  const char* name;
  Color color;
  double roughness;
};

// Palette for requests without materials: bark, three greens, and flower colours.
constexpr Look palette[] = {
    {"bark", {107, 79, 53}, 0.9},    {"leaf", {79, 138, 60}, 0.6},     {"young_leaf", {142, 184, 82}, 0.6},
    {"old_leaf", {53, 96, 48}, 0.7}, {"petal", {232, 160, 191}, 0.5},  {"stamen", {240, 200, 80}, 0.6},
    {"berry", {178, 34, 52}, 0.4},   {"stone", {136, 136, 132}, 0.95},
};

using Given = LsystemMaterial;

bool has_texture(const Given& given) { return given.texture != LsystemTexture::none; }

void paint(Material& material, const Color& color, double roughness, double metallic) {
  material.base_color = linear_color(color);
  material.roughness = static_cast<float>(roughness);
  material.metallic = static_cast<float>(metallic);
}

std::string pointer_to(std::size_t index) { return "/materials/" + std::to_string(index); }

std::optional<std::array<std::uint8_t, 3>> main_color(const std::optional<Color>& color) {
  if (!color) return std::nullopt;
  return std::array<std::uint8_t, 3>{color->red, color->green, color->blue};
}

}  // namespace

void check_materials(const LsystemParams& params, std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < params.materials.size(); ++i) {
    const Given& given = params.materials[i];
    if (!given.color && !has_texture(given) && given.images.color.empty()) {
      issues.emplace_back(missing_for({"color", "texture", "images"}), pointer_to(i),
                          "found neither color nor texture nor images/color; a material needs one of them");
    }
    const auto check = [&](const std::string& uri, const char* member) {
      if (uri.empty()) return;
      std::string error = texture::error_of_image_uri(uri);
      if (!error.empty())
        issues.emplace_back(IssueKind::invalid_value, pointer_to(i) + "/images/" + member, std::move(error));
    };
    check(given.images.color, "color");
    check(given.images.normal, "normal");
    check(given.images.surface, "surface");
  }
}

bool wraps_images(const LsystemParams& params) {
  return std::any_of(params.materials.begin(), params.materials.end(), [](const Given& given) {
    return has_texture(given) || !given.images.color.empty() || !given.images.normal.empty();
  });
}

std::int16_t palette_color_of(LsystemShape shape) {
  using Shape = LsystemShape;
  constexpr std::int16_t leaf = 1, petal = 4, berry = 6;
  if (shape == Shape::petal) return petal;
  if (shape == Shape::fruit) return berry;
  constexpr Shape others[] = {Shape::patches, Shape::model, Shape::sphere, Shape::disc};
  return std::ranges::find(others, shape) == std::end(others) ? leaf : -1;
}

MaterialSet::MaterialSet(Model& model, const LsystemParams& params, const Job& job)
    : model_(model),
      params_(params),
      last_(static_cast<std::int16_t>(
          (params.materials.empty() ? std::size(palette) : params.materials.size()) - 1)) {
  for (std::size_t i = 0; i < params.materials.size(); ++i) {
    const auto& images = params.materials[i].images;
    const std::string name = "image_" + std::to_string(i), at = pointer_to(i) + "/images/";
    textures_.push_back({load(images.color, name + "_color", at + "color", job),
                         load(images.normal, name + "_normal", at + "normal", job),
                         load(images.surface, name + "_surface", at + "surface", job)});
  }
}

int MaterialSet::load(const std::string& uri, const std::string& name, const std::string& pointer,
                      const Job& job) {
  return uri.empty() ? -1 : texture::add_image_of_uri(model_, uri, name, pointer, job);
}

int MaterialSet::material(std::int16_t color, Sides sides, const TextureRecipe& recipe) {
  const auto index = static_cast<std::size_t>(index_of(color));
  for (const Made& each : made_) {
    if (each.index == index && each.sides == sides && each.kind == recipe.kind) return each.material;
  }
  Material material = make(index);
  material.double_sided = material.double_sided || sides == Sides::both;
  if (sides == Sides::both) material.name += "_surface";
  if (sides == Sides::none) drop_textures(material, index);
  const bool has_own = !material.recipe.kind.empty() || material.base_color_texture.texture >= 0;
  if (!recipe.kind.empty() && !has_own) {
    material.recipe = recipe;
    if (!params_.materials.empty()) material.recipe.color = main_color(params_.materials[index].color);
  }
  model_.materials.push_back(std::move(material));
  made_.push_back({index, sides, recipe.kind, static_cast<int>(model_.materials.size()) - 1});
  return made_.back().material;
}

Material MaterialSet::make(std::size_t index) const {
  Material material;
  if (params_.materials.empty()) {
    material.name = palette[index].name;
    paint(material, palette[index].color, palette[index].roughness, 0);
    return material;
  }
  const Given& given = params_.materials[index];
  material.name = given.name.empty() ? "color_" + std::to_string(index) : given.name;
  paint(material, given.color.value_or(Color{255, 255, 255}), given.roughness, given.metallic);
  if (given.opacity < 1) {
    material.base_color.w = static_cast<float>(given.opacity);
    material.alpha_mode = AlphaMode::blend;
  }
  set_emission(material, given.emission);
  set_specular(material, given.specular);
  if (has_texture(given)) {
    material.recipe = {std::string(text_of(given.texture)), static_cast<std::uint64_t>(given.texture_seed),
                       main_color(given.color)};
  }
  set_textures(material, index);
  return material;
}

void MaterialSet::drop_textures(Material& material, std::size_t index) {
  if (params_.materials.empty()) return;
  const Textures& textures = textures_[index];
  const bool has_images = textures.color >= 0 || textures.normal >= 0 || textures.surface >= 0;
  if (material.recipe.kind.empty() && !has_images) return;
  material.recipe = {};
  material.base_color_texture = material.normal_texture = {};
  material.metallic_roughness_texture = material.occlusion_texture = {};
  model_.warnings.push_back(
      {pointer_to(index) + (has_images ? "/images" : "/texture"), "has no effect on lines", 0, 0});
}

/// Images of the request have priority over a generated texture.
void MaterialSet::set_textures(Material& material, std::size_t index) const {
  const Textures& textures = textures_[index];
  if (textures.color < 0 && textures.normal < 0 && textures.surface < 0) return;
  const auto& images = params_.materials[index].images;
  if (textures.color >= 0) material.recipe = {};
  const bool repeats = !images.cut_out;
  if (textures.color >= 0) material.base_color_texture = {textures.color, 0, repeats};
  if (textures.normal >= 0) material.normal_texture = {textures.normal, 0, repeats};
  if (textures.surface >= 0) {
    material.metallic_roughness_texture = {textures.surface, 0, repeats};
    material.occlusion_texture = {textures.surface, 0, repeats};
  }
  if (images.cut_out) {
    material.alpha_mode = AlphaMode::mask;
    material.double_sided = true;
  }
}

}  // namespace seedmesh::lsystem
