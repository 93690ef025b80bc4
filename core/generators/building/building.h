#pragma once
/// Buildings by shape grammars: rules cut a box or a footprint into floors, facades and windows.
///
///   rules -> Grammar (parser) -> Shapes (derive) -> bodies, shared or merged by material
///
/// Out:    metres, +Y up. The first scope stands on the ground: a box is centred on the origin, a footprint lies
///         at its coordinates. One node "building" has the bodies below it.
/// Errors: all syntax errors of the rules, at /rules with line and column. Errors of the derivation, such as numbers
///         that are not finite and endless recursion. Errors at /start, /attributes/..., /footprint, /assets/... and
///         /materials/...
/// Cost:   about 0.3 us a shape and 0.5 us a body. See docs/buildings.md.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/generators/api.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// Returns all errors that the schema cannot express. Pointers are relative to the parameters.
std::vector<Issue> check(const BuildingParams& params, const Limits& limits, const Job* job = nullptr);

/// Returns the rules of a request, for requests with other seeds, sizes and attributes. Null if the request has errors
/// or a shape grammar.
Generator::Prepared prepare(const BuildingParams& params, const CheckContext& context);

/// Makes the model. If the context has prepared rules that belong to the parameters, they are not read again.
Result<Model> generate(const BuildingParams& params, const GenerateContext& context);

/// Returns {shapes: [{id, parent, symbol, parameters, active, scope: {origin, axes, size}}], count, truncated,
/// reports, warnings}. At most 100,000 shapes are listed.
Result<Json> derive(const BuildingParams& params, const GenerateContext& context);
Result<Appraisal> appraise(const BuildingParams& params, const GenerateContext& context);

/// Returns the vocabulary of rules: operations, other words, parts and names of materials.
Json vocabulary();

}  // namespace seedmesh::building
