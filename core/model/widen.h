#pragma once
/// For those who change meshes that others made.
#include "core/model/model.h"

namespace seedmesh {

/// Turns all indices of 16 bits to 32, the form that meshes are worked on in until finish() narrows them. A
/// maker of many pieces may give them narrow at once.
void widen(Model& model, const Job& job);

/// The same arrays once more, charged to the same purses.
Mesh copy_of(const Mesh& mesh);

}  // namespace seedmesh
