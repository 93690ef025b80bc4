#pragma once
/// The words of the L-systems of a scene, for the result of derive().
#include "core/generators/api.h"
#include "core/generators/scene/model_variants.h"
#include "core/generators/scene/plant.h"
#include "core/schema/json.h"

namespace seedmesh::scene {

/// Returns {string, truncated, length, branches, depth} for each placed L-system, by the name of its model.
/// These are the last word, whether it is cut at 64 KiB, and the numbers of its modules and of its branches
/// ("["). The depth is that of nested brackets. The depth of a word that is cut is null. All words together
/// are cut at 16 MiB. Errors: those of a model.
Result<Json> words_of(const Planting& planting, const VariantTable& variant_table,
                      const GenerateContext& context);

}  // namespace seedmesh::scene
