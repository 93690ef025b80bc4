#pragma once
/// L-systems: parallel rewriting of modules, drawn by a turtle.
///
///   params -> compile() -> Grammar -> derive -> Drawing (turtle) -> Skeleton -> skin(), wires() -> bark
///                                                                           \-> polygons()      -> surfaces
///
/// The model has one root node at the start of the turtle, +Y up, in metres. The turtle's colour index
/// selects the material; bark has one primitive for each colour. Source: Prusinkiewicz and Lindenmayer, "The
/// Algorithmic Beauty of Plants", 1990. docs/lsystem.md describes all choices.
#include "core/generators/api.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct LsystemParams;
}

namespace seedmesh::lsystem {

/// Returns all errors of the grammar's texts, with pointers relative to the parameters. Generates nothing.
std::vector<Issue> check(const LsystemParams& params, const Limits& limits);

/// Generates the model. Errors are those of check(), and exceeded limits.
Result<Model> generate(const LsystemParams& params, const GenerateContext& context);

/// Returns {iterations, length, counts, string, truncated, turtle, warnings}: the word and the measures of
/// its drawing, without geometry.
Result<Json> derive(const LsystemParams& params, const GenerateContext& context);

/// Returns the estimated size and the warnings without generating. The estimate is empty where random choices
/// or conditions decide the size.
Result<Appraisal> appraise(const LsystemParams& params, const GenerateContext& context);

/// Returns {"turtle": [...]}: the rows of the command table (commands.h).
Json vocabulary();

}  // namespace seedmesh::lsystem
