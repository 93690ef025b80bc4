#pragma once
/// The words of the L-systems of a scene, for the result of derive().
#include "core/generators/api.h"
#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/place_layers.h"
#include "core/schema/json.h"

namespace seedmesh::scene {

/// Returns {string, truncated, length, branches, depth} for each placed L-system, by the name of its model.
/// `string` is the last word, cut at 64 KiB, and `truncated` is true if it is cut. `length` is its number of
/// modules, and `branches` its number of "[". `depth` is that of nested brackets, and null if the word is
/// cut. All words together are cut at 16 MiB. Errors: those of a model.
Result<Json> words_of(const ScenePlacements& all_placements, const VariantTable& variant_table,
                      const GenerateContext& context);

}  // namespace seedmesh::scene
