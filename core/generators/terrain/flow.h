#pragma once
/// Where water runs on a field.
#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

/// Margin 0. `order` names every sample once, receivers before those that drain to them; a sample at the
/// border drains to itself.
struct Drainage {
  Array<std::uint32_t> order, receiver;
  Array<float> filled;  ///< heights with every hollow filled to its rim
};

/// By flooding from the border (Barnes, Lehman and Mulla, "Priority-flood", 2014): hollows drain over their
/// lowest rim, everything else to its steepest neighbour of eight. About 150 ns a sample.
Drainage drainage_of(const Field& field, const Job& job);

/// Samples that drain through each, itself included, in fractions: water spreads over all lower neighbours by
/// their slope (Freeman 1991), and leaves hollows by their rim.
Array<float> gathered(const Field& field, const Drainage& drainage, const Job& job);

}  // namespace seedmesh::terrain
