#pragma once
/// L-systems: parallel rewriting of modules, drawn by a turtle.
///
///   params -> compile() -> Grammar -> derive -> Drawing (turtle) -> Skeleton -> skin() or wires() -> bark,
///   one primitive a colour
///                                                                          \-> polygons()       -> surfaces
///
/// Out: one root node, foot where the turtle starts, +Y up, metres; materials by the turtle's colour index.
/// Based on Prusinkiewicz and Lindenmayer, "The Algorithmic Beauty of Plants", 1990; docs/lsystem.md tells
/// every choice.
#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct LsystemParams;
}

namespace seedmesh::lsystem {

/// Every fault of the grammar's texts, with pointers relative to the parameters. Makes nothing.
std::vector<Issue> check(const LsystemParams& params, const Limits& limits);

/// The model. Issues: those of check().
Result<Model> generate(const LsystemParams& params, Job& job);

/// {iterations, length, counts, string, truncated, turtle, warnings}: the word and what the turtle did,
/// without geometry.
Result<Json> derive(const LsystemParams& params, Job& job);

/// Size and warnings, without making anything. The estimate is empty where chance or conditions decide.
Result<Appraisal> appraise(const LsystemParams& params, const Job& job);

/// {"turtle": [...]}: the rows of the table that the interpreter itself reads.
Json vocabulary();

}  // namespace seedmesh::lsystem
