#pragma once
/// Coarser levels of a grid of all samples.
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// About every `step`th sample of `part`, a window of the field's own samples: evenly spread, the first and
/// the last of each row and column among them; two triangles a square, cut along the diagonal that is closer
/// to level. A `whole` border has every sample of the part's border, stitched to the line inside it: parts
/// side by side then fit together whatever step each has. Triangles come in an order that a vertex cache
/// likes, samples by their first use. Spends triangles. About 10 ns a triangle.
Triangulation decimated(const Field& field, const Window& part, std::int32_t step, Border border, Job& job);

}  // namespace seedmesh::terrain
