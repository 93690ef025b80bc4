#pragma once
/// Trees by five models: weber_penn, proctree, sculpt, ez_tree and grown.
///
///   params -> Skeleton (limbs and leaves) -> build_model() -> bark: one closed mesh, and leaves: one mesh
///
/// The model has one root node. The foot of the trunk is at the origin, +Y is up, lengths are in metres.
#include "core/generators/api.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct TreeParams;
}

namespace seedmesh::tree {

/// Checks what the schema cannot express: mSegments is even, and images can be read.
std::vector<Issue> check(const TreeParams& params, const Limits& limits);

/// Returns one warning for each parameter that is given and has no effect. Pointers are relative to the parameters.
std::vector<Warning> warnings_of(const TreeParams& params);

/// Generates the model of a tree.
Result<Model> generate(const TreeParams& params, const GenerateContext& context);

/// {limbs, levels: [{count, length, radius}], leaves, height, bounds, warnings}: figures of the skeleton.
/// `length` is the mean over the limbs of a level, and `radius` the mean of their radii where they begin.
Result<Json> derive(const TreeParams& params, const GenerateContext& context);

/// Gives warnings, and an estimate if the skeleton has at most 300,000 joints and 1,500,000 leaves, which
/// takes about 0.1 s. The triangles of the bark are estimated within 50 %.
Result<Appraisal> appraise(const TreeParams& params, const GenerateContext& context);

/// Returns an empty object, because trees have no notation.
Json vocabulary();

}  // namespace seedmesh::tree
