#pragma once
/// Drainage of a field.
#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// Requires margin 0. `order` lists every sample once, receivers before the samples that drain to them. A
/// border sample drains to itself.
struct Drainage {
  Array<std::uint32_t> order, receiver;
  Array<float> filled;  ///< heights with every depression filled to its rim
};

/// Computes the flow by flooding from the border (Barnes, Lehman and Mulla, "Priority-flood", 2014).
/// Depressions drain over their lowest rim, other samples to their steepest of eight neighbours. Cost: about
/// 30 ns for each sample.
Drainage drainage_of(const Field& field, const Job& job);

/// Returns for each sample the number of samples that drain through it, including itself. The numbers have
/// fractions. Water spreads over all lower neighbours by slope (Freeman 1991), and leaves depressions over
/// their rim.
Array<float> gathered(const Field& field, const Drainage& drainage, const Job& job);

}  // namespace seedmesh::terrain
