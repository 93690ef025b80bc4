#pragma once
/// What bark and leaves look like: pictures made by seed, the request's own, or one colour.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {

/// What the schema cannot say of the images.
void check_images(const TreeParams& params, std::vector<Issue>& issues);

/// True where the bark wears a picture, which is to go a whole number of times round a limb.
bool has_bark_picture(const TreeParams& params);

/// What leaves are made of where the model decides: see the parameter leaf.build.
TreeBuild build_of(const TreeParams& params);

/// Do its squares have the picture of a twig?
bool shows_twig(const TreeParams& params);

/// Are there any in this season?
bool has_leaves(const TreeParams& params);

/// True where leaves wear one made by seed.
bool wears_picture(const TreeParams& params);

/// True where they have a normal map, if pictures are wanted; and where bark has one.
bool has_leaf_relief(const TreeParams& params);
bool has_bark_relief(const TreeParams& params);

/// The number of the new material. Throws Stop (Code::invalid) for an image that is damaged.
int add_bark_look(Model& model, const TreeParams& params, const Job& job);

/// Materials of all seasons with leaves, which share one picture and differ in the colour that multiplies it,
/// as Model::variants.
struct LeafLook {
  int material = -1;          ///< of the season that was asked for
  std::vector<int> variants;  ///< by Model::variants; empty: there are none
};
LeafLook add_leaf_look(Model& model, const TreeParams& params, const Job& job);

}  // namespace seedmesh::tree
