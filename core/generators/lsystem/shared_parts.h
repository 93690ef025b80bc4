#pragma once
/// Large self-similar systems: what a symbol derives to is drawn once, and placed wherever it occurs again.
///
/// The number of meshes does not depend on the number of steps. The 21 million segments of a tree of fifteen
/// steps therefore need the memory of a few thousand segments.
#include <nlohmann/json_fwd.hpp>

#include "core/generators/lsystem/draw.h"

namespace seedmesh::lsystem {

/// Returns true where the request selects shared parts and its system allows them: a plain system
/// (DrawingCache::fits) whose widths follow from symbols or steps, and an output for which no step processes
/// the plant as a whole.
bool has_shared_parts(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                      const GenerateContext& context);

/// Adds a warning if the request has `share: always` but the model is made as a whole.
void warn_of_whole(const LsystemParams& params, std::vector<Warning>& warnings);

/// Returns the model with shared parts. Spends the modules, joints and triangles that are made, not those that are
/// shown.
Model shared_model(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                   const GenerateContext& context);

/// Measures the whole drawing: its turtle at the end and TurtleReport with bounds.
void measure_shared(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps,
                    Drawing& drawing, const GenerateContext& context);

}  // namespace seedmesh::lsystem
