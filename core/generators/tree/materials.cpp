#include "core/generators/tree/materials.h"

#include <algorithm>
#include <array>

#include "core/base/math.h"
#include "core/generators/material_members.h"
#include "core/texture/data_uri.h"
#include "core/texture/leaf.h"

namespace seedmesh::tree {
namespace {

// Leaves of coarse levels are up to 1.45 times as bright, which is a factor of 1.18 for sRGB values. Images have brighter
// texels than their main colour, so that one stays well below 255.
constexpr double far_headroom = 1.18, highest_with_headroom = 216;
// Share of the alpha cutoff for sparse leaves far away.
constexpr float sparse_cutoff = 0.85F;
constexpr float bark_roughness = 0.95F, leaf_roughness = 0.65F;
constexpr Color plain_bark{107, 84, 64};
// The colour of young leaves is mixed with this share of a light yellow green.
constexpr double spring_share = 0.4;
constexpr Color spring_green{176, 206, 96};
constexpr Color autumn_yellow{200, 145, 46};

constexpr std::array<const char*, 3> leafy_seasons{"spring", "summer", "autumn"};

// The schema lists the shapes in the order of LeafShape.
static_assert(static_cast<int>(TreeLeafShape::petal) + 1 == leaf_shape_count);

glm::vec3 linear(const Color& color) {
  return {linear_of_srgb(color.red), linear_of_srgb(color.green), linear_of_srgb(color.blue)};
}

Color mixed(const Color& a, const Color& b, double share) {
  const auto part = [&](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(math::to_int32(x + (y - x) * share + 0.5));
  };
  return {part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue)};
}

/// `season` indexes leafy_seasons. Petals keep their colour unless the request gives an autumn colour.
Color leaf_color(const TreeLeaf& leaf, std::size_t season) {
  const bool is_blossom = leaf.leaf_shape == TreeLeafShape::petal;
  if (season == 0 && !is_blossom) return mixed(leaf.color, spring_green, spring_share);
  if (season != 2 || leaf.evergreen) return leaf.color;
  return leaf.autumn.value_or(is_blossom ? leaf.color : autumn_yellow);
}

/// The season of the request as an index of leafy_seasons; summer for evergreen trees in winter.
std::size_t season_of(const TreeParams& params) {
  return params.season == TreeSeason::winter ? 1 : static_cast<std::size_t>(params.season);
}

/// The largest value of each component over all seasons. The colours of seasons are darker multiples of it. `headroom`:
/// factor of sRGB values, as far as they stay below the highest one.
Color brightest(const TreeLeaf& leaf, double headroom) {
  Color most{1, 1, 1};
  for (std::size_t season = 0; season < leafy_seasons.size(); ++season) {
    const Color each = leaf_color(leaf, season);
    most = {std::max(most.red, each.red), std::max(most.green, each.green), std::max(most.blue, each.blue)};
  }
  const double highest = std::max({most.red, most.green, most.blue});
  const double by = std::clamp(highest_with_headroom / highest, 1.0, headroom);
  const auto raised = [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(math::to_int32(value * by + 0.5));
  };
  return {raised(most.red), raised(most.green), raised(most.blue)};
}

template <class Images>
void check(const Images& images, const std::string& pointer, std::vector<Issue>& issues) {
  const auto check_one = [&](const std::string& uri, const char* member) {
    if (uri.empty()) return;
    std::string error = texture::error_of_image_uri(uri);
    if (!error.empty())
      issues.emplace_back(IssueKind::invalid_value, pointer + "/" + member, std::move(error));
  };
  check_one(images.color, "color");
  check_one(images.normal, "normal");
  check_one(images.surface, "surface");
}

/// Uses the images of the request, which replace a generated texture.
template <class Images>
void use_images(Material& material, const Images& images, const std::string& pointer, Model& model,
                const Job& job) {
  const bool repeats = !images.cut_out;
  const auto load = [&](const std::string& uri, const char* member) {
    if (uri.empty()) return TextureUse{};
    const int image =
        texture::add_image_of_uri(model, uri, material.name + "_" + member, pointer + "/" + member, job);
    return TextureUse{image, 0, repeats};
  };
  material.base_color_texture = load(images.color, "color");
  material.normal_texture = load(images.normal, "normal");
  material.metallic_roughness_texture = material.occlusion_texture = load(images.surface, "surface");
  if (!images.color.empty()) {
    material.recipe = {};
    material.base_color = {1, 1, 1, 1};
  }
  if (images.cut_out) material.alpha_mode = AlphaMode::mask;
}

/// Cuts out leaves whose image has an alpha channel, even without `cut_out`.
void cut_out_by_alpha(Material& material, Model& model) {
  const int color = material.base_color_texture.texture;
  if (color < 0 || !texture::has_alpha(*model.textures[static_cast<std::size_t>(color)])) return;
  material.alpha_mode = AlphaMode::mask;
  for (TextureUse* use : {&material.base_color_texture, &material.normal_texture,
                          &material.metallic_roughness_texture, &material.occlusion_texture})
    use->repeat = false;
}

}  // namespace

void check_images(const TreeParams& params, std::vector<Issue>& issues) {
  check(params.bark_images, "/bark_images", issues);
  check(params.leaf.images, "/leaf/images", issues);
}

bool has_bark_texture(const TreeParams& params) {
  return params.bark != TreeBark::none || !params.bark_images.color.empty() ||
         !params.bark_images.normal.empty() || !params.bark_images.surface.empty();
}

bool has_generated_bark(const TreeParams& params) {
  return params.bark != TreeBark::none && params.bark_images.color.empty() &&
         params.bark_images.normal.empty() && params.bark_images.surface.empty();
}

TreeBuild build_of(const TreeParams& params) {
  if (params.leaf.build != TreeBuild::usual) return params.leaf.build;
  return params.model == TreeModel::proctree ? TreeBuild::bunch : TreeBuild::card;
}

bool shows_twig(const TreeParams& params) {
  const TreeBuild build = build_of(params);
  if (has_needles(static_cast<LeafShape>(params.leaf.leaf_shape))) return build != TreeBuild::mesh;
  return build == TreeBuild::twig || build == TreeBuild::bunch;
}

bool has_leaves(const TreeParams& params) {
  if (params.leaf.build == TreeBuild::none) return false;
  return params.season != TreeSeason::winter || params.leaf.evergreen;
}

bool has_leaf_texture(const TreeParams& params) {
  if (params.leaf.picture == TreePicture::auto_) return build_of(params) != TreeBuild::mesh;
  return params.leaf.picture == TreePicture::own;
}

bool has_outward_faces(const TreeParams& params, const Demand& demand) {
  if (demand.share_organs || params.leaf.leaf_faces == TreeLeafFaces::two_sided) return false;
  return params.leaf.leaf_faces == TreeLeafFaces::outward || !demand.two_sided_leaves;
}

glm::vec3 color_of_leaves(const TreeParams& params) {
  return linear(leaf_color(params.leaf, season_of(params)));
}

bool has_leaf_relief(const TreeParams& params, const Demand& demand) {
  if (!params.leaf.images.normal.empty()) return true;
  return !has_outward_faces(params, demand) && has_leaf_texture(params) && params.leaf.images.color.empty();
}

bool has_bark_relief(const TreeParams& params) {
  if (!params.bark_images.normal.empty()) return true;
  return params.bark != TreeBark::none && params.bark_images.color.empty();
}

int add_bark_material(Model& model, const TreeParams& params, const Job& job) {
  Material material;
  material.name = "bark";
  material.base_color = {linear(params.bark_color.value_or(plain_bark)), 1};
  material.roughness = bark_roughness;
  if (params.bark != TreeBark::none) {
    material.recipe.kind = text_of(params.bark);
    material.recipe.seed = static_cast<std::uint64_t>(params.bark_seed);
    if (params.bark_color) {
      material.recipe.color = {{params.bark_color->red, params.bark_color->green, params.bark_color->blue}};
    }
  }
  set_specular(material, params.bark_specular);
  set_emission(material, params.bark_emission);
  use_images(material, params.bark_images, "/bark_images", model, job);
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

LeafMaterials add_leaf_materials(Model& model, const TreeParams& params, const GenerateContext& context) {
  const Job& job = context.job;
  const bool has_own_sides = has_outward_faces(params, context.demand);
  Material material;
  material.roughness = leaf_roughness;
  material.double_sided = !has_own_sides;
  texture::let_light_through(material, static_cast<LeafShape>(params.leaf.leaf_shape));
  set_specular(material, params.leaf.specular);
  set_emission(material, params.leaf.emission);
  const Color most = brightest(params.leaf, context.demand.lods > 1 ? far_headroom : 1);
  if (has_leaf_texture(params)) {
    material.recipe.kind =
        texture::leaf_kind(static_cast<LeafShape>(params.leaf.leaf_shape), shows_twig(params));
    material.recipe.color = {{most.red, most.green, most.blue}};
    material.recipe.has_own_sides = has_own_sides;
  }
  LeafMaterials result;
  material.name = "leaf";
  use_images(material, params.leaf.images, "/leaf/images", model, job);
  if (!params.leaf.images.color.empty()) {
    cut_out_by_alpha(material, model);
    material.double_sided = !has_own_sides;
    result.material = static_cast<int>(model.materials.size());
    model.materials.push_back(std::move(material));
    return result;
  }
  for (std::size_t season = 0; season < leafy_seasons.size(); ++season) {
    const glm::vec3 color = linear(leaf_color(params.leaf, season));
    material.name = std::string("leaf_") + leafy_seasons[season];
    material.base_color = {color, 1};
    material.recipe.factor = glm::min(color / linear(most), glm::vec3(1));
    result.variants.push_back(static_cast<int>(model.materials.size()));
    model.materials.push_back(material);
    model.variants.emplace_back(leafy_seasons[season]);
  }
  result.material = result.variants[season_of(params)];
  return result;
}

LeafMaterials double_sided(Model& model, const LeafMaterials& materials, const FarLeafMaterial& look) {
  const auto add_copy = [&](int original) {
    Material copy = model.materials[static_cast<std::size_t>(original)];
    copy.name += look.name;
    copy.double_sided = true;
    copy.base_color =
        glm::vec4(glm::min(glm::vec3(copy.base_color) * look.gain, glm::vec3(1)), copy.base_color.w);
    copy.recipe.factor = glm::min(copy.recipe.factor * look.gain, glm::vec3(1));
    if (look.is_sparse) {
      copy.alpha_mode = AlphaMode::mask;
      copy.alpha_cutoff = sparse_cutoff * texture::leaf_cutoff(copy.recipe.kind);
    }
    model.materials.push_back(std::move(copy));
    return static_cast<int>(model.materials.size()) - 1;
  };
  LeafMaterials result;
  for (const int each : materials.variants) {
    result.variants.push_back(add_copy(each));
    if (each == materials.material) result.material = result.variants.back();
  }
  if (result.material < 0) result.material = add_copy(materials.material);
  return result;
}

}  // namespace seedmesh::tree
