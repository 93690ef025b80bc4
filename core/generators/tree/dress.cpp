#include "core/generators/tree/dress.h"

#include <algorithm>
#include <array>

#include "core/geom/foliage.h"
#include "core/geom/graft.h"

namespace seedmesh::tree {
namespace {

constexpr float bark_roughness = 0.95F, leaf_roughness = 0.65F;
// Young leaves: the summer's colour turned so far to a light yellow green.
constexpr double spring_share = 0.4;
constexpr Color spring_green{176, 206, 96};

constexpr std::array<const char*, 3> leafy_seasons{"spring", "summer", "autumn"};

GraftOptions graft_options(const TreeParams& params) {
  GraftOptions options;
  options.sides = sides_of(params);
  options.weld = params.weld;
  options.thinnest = static_cast<float>(params.twig_radius);
  if (params.model == TreeModel::weber_penn && params.LobeDepth > 0) {
    options.lobes = params.Lobes;
    options.lobe_depth = static_cast<float>(params.LobeDepth);
  }
  // Stems that split without an angle go on as one.
  options.overlaps = params.model == TreeModel::weber_penn &&
                     (params.base_splits > 0 || params.seg_splits_0 > 0 || params.seg_splits_1 > 0 ||
                      params.seg_splits_2 > 0 || params.seg_splits_3 > 0);
  if (params.model == TreeModel::proctree) options.v_scale = static_cast<float>(params.mVMultiplier);
  return options;
}

Material painted(std::string name, const glm::vec3& color, float roughness) {
  Material material;
  material.name = std::move(name);
  material.base_color = {color, 1};
  material.roughness = roughness;
  return material;
}

glm::vec3 linear(const Color& color) {
  return {linear_of_srgb(color.red), linear_of_srgb(color.green), linear_of_srgb(color.blue)};
}

Color mixed(const Color& a, const Color& b, double share) {
  const auto part = [&](std::uint8_t x, std::uint8_t y) {
    return static_cast<std::uint8_t>(math::to_int32(x + (y - x) * share + 0.5));
  };
  return {part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue)};
}

/// By leafy_seasons.
Color leaf_color(const TreeLeaf& leaf, std::size_t season) {
  if (season == 0) return mixed(leaf.color, spring_green, spring_share);
  return season == 2 && !leaf.evergreen ? leaf.autumn : leaf.color;
}

LeafForm form_of(const TreeParams& params) {
  switch (params.leaf.form) {
    case TreeForm::blade:
      return LeafForm::blade;
    case TreeForm::twig:
      return LeafForm::twig;
    case TreeForm::needle:
      return LeafForm::needle;
    case TreeForm::kite:
      return LeafForm::kite;
    default:
      return params.model == TreeModel::proctree ? LeafForm::twig : LeafForm::kite;
  }
}

bool has_leaves(const TreeParams& params) {
  if (params.leaf.form == TreeForm::none) return false;
  return params.season != TreeSeason::winter || params.leaf.evergreen;
}

void add_mesh(Model& model, const char* name, Mesh mesh, int material) {
  if (mesh.position.empty()) return;
  Node node;
  node.name = name;
  node.parent = 0;
  node.mesh = static_cast<int>(model.meshes.size());
  model.nodes.push_back(std::move(node));
  model.meshes.push_back({name, {}});
  model.meshes.back().primitives.push_back({std::move(mesh), material, {}});
}

/// The leaves' materials: that of the season, and all that have leaves as variants to choose from.
void paint_leaves(Model& model, const TreeParams& params) {
  const auto first = static_cast<int>(model.materials.size());
  std::vector<int> variants;
  for (std::size_t season = 0; season < leafy_seasons.size(); ++season) {
    Material material = painted(std::string("leaf_") + leafy_seasons[season],
                                linear(leaf_color(params.leaf, season)), leaf_roughness);
    material.double_sided = true;
    variants.push_back(static_cast<int>(model.materials.size()));
    model.materials.push_back(std::move(material));
    model.variants.emplace_back(leafy_seasons[season]);
  }
  const int chosen = params.season == TreeSeason::winter ? 1 : static_cast<int>(params.season);
  model.meshes.back().primitives.back().material = first + chosen;
  model.meshes.back().primitives.back().variant_materials = variants;
  if (model.meshes.size() > 1) {
    model.meshes.front().primitives.front().variant_materials.assign(
        variants.size(), model.meshes.front().primitives.front().material);
  }
}

}  // namespace

int sides_of(const TreeParams& params) {
  return params.model == TreeModel::proctree ? std::max(3, params.mSegments) : params.sides;
}

Model dress(Skeleton skeleton, const TreeParams& params, Job& job) {
  Model model;
  model.name = "tree";
  Node root;
  root.name = "tree";
  model.nodes.push_back(std::move(root));
  model.materials.push_back(painted("bark", linear(params.bark_color), bark_roughness));
  add_mesh(model, "bark", graft(skeleton.limbs, graft_options(params), job), 0);
  skeleton.limbs = Limbs(job);  // its memory goes back before the leaves need theirs
  if (!has_leaves(params)) return model;
  FoliageOptions options;
  options.density = params.leaf.density;
  options.size = static_cast<float>(params.leaf.size);
  options.crown = static_cast<float>(params.leaf.crown_normals);
  options.tint = static_cast<float>(params.leaf.tint);
  Mesh leaves = foliage(skeleton.organs.organ.span(), leaf_template(form_of(params)), options, job);
  if (leaves.position.empty()) return model;
  add_mesh(model, "leaves", std::move(leaves), 0);
  paint_leaves(model, params);
  return model;
}

}  // namespace seedmesh::tree
