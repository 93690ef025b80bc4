#include "core/generators/tree/dress.h"

#include <algorithm>

#include "core/geom/graft.h"

namespace seedmesh::tree {

int sides_of(const TreeParams& params) {
  return params.model == TreeModel::proctree ? std::max(3, params.mSegments) : params.sides;
}

Model dress(Skeleton skeleton, const TreeParams& params, Job& job) {
  Model model;
  model.name = "tree";
  Node root;
  root.name = "tree";
  model.nodes.push_back(std::move(root));
  GraftOptions options;
  options.sides = sides_of(params);
  options.weld = params.weld;
  options.thinnest = static_cast<float>(params.twig_radius);
  if (params.model == TreeModel::weber_penn && params.LobeDepth > 0) {
    options.lobes = params.Lobes;
    options.lobe_depth = static_cast<float>(params.LobeDepth);
  }
  if (params.model == TreeModel::proctree) options.v_scale = static_cast<float>(params.mVMultiplier);
  Mesh bark = graft(skeleton.limbs, options, job);
  Node node;
  node.name = "bark";
  node.parent = 0;
  node.mesh = 0;
  model.nodes.push_back(std::move(node));
  model.meshes.push_back({"bark", {}});
  Material material;
  material.name = "bark";
  material.base_color = {linear_of_srgb(107), linear_of_srgb(84), linear_of_srgb(64), 1};
  material.roughness = 0.95F;
  model.materials.push_back(material);
  model.meshes.back().primitives.push_back({std::move(bark), 0, {}});
  return model;
}

}  // namespace seedmesh::tree
