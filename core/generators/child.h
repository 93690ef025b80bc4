#pragma once
/// Requests inside requests. Where a schema refers to common.schema.json#/$defs/child, the generator gets a
/// Child and makes its model with these functions. All models of a request share one set of limits, one
/// deadline and one memory budget.
#include <string>
#include <string_view>

#include "core/base/rng.h"
#include "core/generators/api.h"

namespace seedmesh {

/// Greatest depth of requests inside requests. Presets count too, so presets cannot refer to each other
/// in a cycle.
constexpr int deepest_child = 4;

/// Reads the parameters at `pointer` and those of every request inside them, which become canonical. Adds the
/// errors of the schemas and of the generators' check(), each once.
Generator::Params read_parameters(const Generator& generator, const Json& json, const std::string& pointer,
                                  const CheckContext& context, IssueList& errors);

/// Makes the model of the child at `pointer` of the surrounding parameters; finish() has not run on it. A
/// child without a seed takes its seed from `stream`, which must differ for each location. Errors and
/// warnings point into the surrounding parameters. The child reports no progress. The child's model has no
/// tangents: the pipeline makes those of the whole model.
Result<Model> generate_child(const Child& child, const std::string& pointer, Rng stream,
                             const GenerateContext& around, const Demand& demand = {});

/// Returns the result of Generator::prepare for the child, which generate_prepared() can use for similar
/// children; null if there is none.
Generator::Prepared prepare_child(const Child& child, const GenerateContext& around);

/// Makes the same model as generate_child(), in less time if `prepared` belongs to its parameters.
Result<Model> generate_prepared(const Child& child, const std::string& pointer, Rng stream,
                                const GenerateContext& around, const Demand& demand,
                                Generator::Prepared prepared);

/// Returns the result of derive() for the child, under the rules of generate_child(). The pointers of its warnings stay
/// relative to the child.
Result<Json> derive_child(const Child& child, const std::string& pointer, Rng stream,
                          const GenerateContext& around);

/// Returns the appraisal of the child, under the rules of generate_child(), but with the textures and tangents of the output
/// around it.
Result<Appraisal> appraise_child(const Child& child, const std::string& pointer, Rng stream,
                                 const GenerateContext& around);

/// Returns the message for a generator that does not exist, with the nearest name or with all names.
std::string unknown_generator(GeneratorList generators, std::string_view name);

}  // namespace seedmesh
