#pragma once
/// Coarser levels of a full grid.
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {

/// Triangulates about every `step`th sample of `part`, a window of the field's samples. The samples are
/// evenly spaced and include the first and last of each row and column. Each square has two triangles, split
/// along the diagonal with the smaller height difference. With Border::whole, all samples of the part's
/// border are used, and joined to the first line of samples inside. Adjacent parts then fit together,
/// whatever their steps are. Triangles and samples are in vertex cache order. Spends triangles. Cost: about
/// 10 ns for each triangle.
Triangulation decimated(const Field& field, const Window& part, std::int32_t step, Border border, Job& job);

}  // namespace seedmesh::terrain
