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

/// Returns the estimated size and the warnings. Where random choices, conditions or organs determine the size, a model
/// of up to 50,000 modules and 200,000 triangles is made and counted, in about ten milliseconds. The estimate of a
/// larger one is empty, and so is that of open systems and of shared parts.
Result<Appraisal> appraise(const LsystemParams& params, const GenerateContext& context);

/// Returns {"turtle": [...]}: the rows of the command table (commands.h).
Json vocabulary();

}  // namespace seedmesh::lsystem
