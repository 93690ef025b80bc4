#pragma once
/// Materials of bark and leaves: generated textures, images of the request, or a plain colour.
#include <vector>

#include "core/generators/api.h"
#include "core/model/model.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {

/// Adds an error for each image that cannot be read.
void check_images(const TreeParams& params, std::vector<Issue>& issues);

/// Whether the bark has a texture, which then repeats around each limb.
bool has_bark_texture(const TreeParams& params);

/// Whether all of that texture is generated, so that its strips tile (core/texture/bark.h).
bool has_generated_bark(const TreeParams& params);

/// The build of the leaves; `usual` is resolved (see the parameter leaf.build).
TreeBuild build_of(const TreeParams& params);

/// Whether leaves have the texture of a twig.
bool shows_twig(const TreeParams& params);

/// Whether there are leaves in the season of the request.
bool has_leaves(const TreeParams& params);

/// Whether leaves have a generated texture.
bool has_leaf_texture(const TreeParams& params);

/// Whether leaves have faces on both sides with one outward normal (see the parameter leaf.faces). Leaves that
/// share a mesh have not, because such normals depend on the position of a leaf.
bool has_outward_faces(const TreeParams& params, const Demand& demand);

/// The linear colour of the leaves in the season of the request.
glm::vec3 color_of_leaves(const TreeParams& params);

/// Whether leaves, or bark respectively, get a normal map when the output has textures. Leaves with outward
/// faces use only a normal map of the request.
bool has_leaf_relief(const TreeParams& params, const Demand& demand);
bool has_bark_relief(const TreeParams& params);

/// Adds a material and returns its index. Throws Stop (Code::invalid) for a damaged image.
int add_bark_material(Model& model, const TreeParams& params, const Job& job);

/// The materials of leaves, one for each season that has leaves. They are Model::variants, which share one texture and
/// differ in colour.
struct LeafMaterials {
  int material = -1;          ///< material of the season of the request
  std::vector<int> variants;  ///< indices by Model::variants; may be empty
};
/// Adds the materials of leaves and their variants. Throws Stop (Code::invalid) for a damaged image.
LeafMaterials add_leaf_materials(Model& model, const TreeParams& params, const GenerateContext& context);

/// The appearance of leaves that have one double-sided face.
struct FarLeafMaterial {
  float gain = 1;          ///< factor of the colour
  bool is_sparse = false;  ///< few are left: a lower alpha cutoff makes leaves and needles wider
  std::string name;        ///< end of the names of the materials
};
/// Adds double-sided copies of the materials of leaves.
LeafMaterials double_sided(Model& model, const LeafMaterials& materials, const FarLeafMaterial& look);

}  // namespace seedmesh::tree
