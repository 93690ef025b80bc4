#pragma once
/// Requests inside requests. A schema takes one where it refers to common.schema.json#/$defs/child; its
/// generator is handed a Child and asks here for the model. One Job serves all of them, so limits, deadline
/// and memory are those of the whole request.
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/generators/registry.h"
#include "core/model/model.h"
#include "core/schema/child.h"
#include "core/schema/faults.h"

namespace seedmesh {

/// Requests may stand in each other this deep. Presets count too, so that shipped ones cannot go in circles.
constexpr int deepest_child = 4;

/// Reads the parameters that stand at `pointer` and those of every request inside them, which become
/// canonical. Adds the faults of the schema and those that only the generators know, each once. Schemas bound
/// how many children there can be.
Generator::Params read_parameters(const Generator& generator, const Json& json, const std::string& pointer,
                                  const Limits& limits, Faults& faults);

/// The model of a child that stands at `pointer` of the parameters around it, not finished. Where the child
/// has no seed of its own it grows from `place`, which is to be a different stream for each place. Faults and
/// warnings point into the parameters around it. Stages of the child are not told as progress.
/// `demand`: what is asked of its model; plain where nothing is said.
Result<Model> generate_child(const Child& child, const std::string& pointer, Rng place, const Job& job,
                             const Demand& demand = {});

/// The same for the estimate.
Result<Appraisal> appraise_child(const Child& child, const std::string& pointer, Rng place, const Job& job);

/// "there is no generator "tre"; did you mean "tree"?", or which there are.
std::string unknown_generator(std::string_view name);

}  // namespace seedmesh
