#pragma once
/// Buildings by shape grammars: rules cut a box or a footprint into floors, facades, windows.
///
///   rules -> Grammar (parser) -> Shapes (derive) -> bodies, shared or merged by material
///
/// Out:    +Y up, metres; the first scope stands on the ground, a box with its centre above the origin, a
///         footprint where its coordinates say. One node "building" with the bodies below it.
/// Issues: /rules with line and column: faults of the text, all at once; while it runs, numbers that are not
///         finite and rules without an end. /start, /attributes/..., /footprint, /assets/..., /materials/...
/// Cost:   about 0.3 us a shape and 0.5 us a body. See docs/buildings.md.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

std::vector<Issue> check(const BuildingParams& params, const Limits& limits);
Result<Model> generate(const BuildingParams& params, Job& job);

/// {shapes: [{id, parent, symbol, parameters, active, scope: {origin, axes, size}}], count, truncated,
/// reports, warnings}: at most 100,000 shapes are listed.
Result<Json> derive(const BuildingParams& params, Job& job);
Result<Appraisal> appraise(const BuildingParams& params, const Job& job);

/// Operations with kind, arity, text and example; other words of the rules; parts; names of materials.
Json vocabulary();

}  // namespace seedmesh::building
