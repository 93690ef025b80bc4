#pragma once
/// Trees by parametric models: weber_penn, proctree, sculpt.
///
///   params -> model -> Skeleton (limbs, leaves) -> dress() -> bark, one closed mesh; leaves, one mesh
///
/// Out: one root node, the foot of the trunk at the origin, +Y up, metres; two materials.
#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct TreeParams;
}

namespace seedmesh::tree {

/// Rules between parameters: mSegments is even.
std::vector<Issue> check(const TreeParams& params, const Limits& limits);

Result<Model> generate(const TreeParams& params, Job& job);

/// {limbs, levels: [{count, length, radius}], leaves, height, bounds, warnings}: the skeleton in figures.
/// `length` and `radius` are means over the limbs of the level, the radius where they begin.
Result<Json> derive(const TreeParams& params, Job& job);

/// Warnings, and an estimate by the skeleton, which is grown where it has at most 300,000 joints and
/// 1,500,000 leaves; bark within a half of what will be made.
Result<Appraisal> appraise(const TreeParams& params, const Job& job);

/// Nothing: a tree has no notation.
Json vocabulary();

}  // namespace seedmesh::tree
