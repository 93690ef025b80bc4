#pragma once
/// Samples without a height, such as the voids of radar measurements.
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

/// Replaces all heights that are not finite by heights between those around them, and counts them in `voids`.
/// It builds a pyramid of means. Each void gets the bilinearly interpolated value of the finest level that
/// has one (Gortler et al., "The Lumigraph", 1996, section 3.4, "pull-push"). Requires margin 0. False if no
/// height is finite. Linear time.
bool fill_voids(Field& field, const Job& job);

/// States how many samples were filled.
Warning void_warning(const Field& field);

}  // namespace seedmesh::terrain
