#pragma once
/// Estimates the size of a scene before anything is placed or generated.
#include <optional>

#include "core/generators/api.h"
#include "core/generators/scene/model_variants.h"

namespace seedmesh::scene {

/// Returns the extent of the ground, a square, before it is generated. Returns nullopt for a terrain from an
/// image, whose depth is unknown.
std::optional<Extent> known_extent(const SceneParams& params);

/// Returns the largest number of placements of a layer if all of `extent` is suitable: the requested number,
/// or the capacity of its pattern.
double expected_placements(const SceneLayer& layer, const Extent& extent);

/// Estimates the ground and all placements. Rules that depend on the ground are sampled (sampled_share.h), which
/// computes the heights of a terrain of up to 2049 x 2049 samples. `estimates` has one entry for each of
/// VariantTable::variants. Returns nullopt where no variant of a layer has an estimate. A variant without
/// estimate counts as the mean of its layer; a reduced ground counts as an eighth of its grid. The result is
/// exact where all positions are given and all estimates are exact. Bytes count each variant once and one node
/// for each placement.
std::optional<Estimate> estimate_of(const SceneParams& params, const VariantTable& variant_table,
                                    const std::vector<std::optional<Estimate>>& estimates,
                                    const GenerateContext& context);

}  // namespace seedmesh::scene
