#pragma once
/// Conversions for code that changes finished meshes.
#include "core/model/model.h"

namespace seedmesh {

/// Converts all 16-bit indices to 32-bit ones. Mesh operations expect these until finish() narrows them
/// again. Generators of many small meshes may make 16-bit indices directly.
void widen(Model& model, const Job& job);

/// Returns a deep copy of all arrays, charged to the same memory budgets.
Mesh copy_of(const Mesh& mesh);

/// Refuses a mesh of more vertices than 32-bit indices can name. `what` is the subject of the message, such as
/// "The bark".
void check_vertex_count(const Job& job, std::uint64_t vertices, std::string_view what);

}  // namespace seedmesh
