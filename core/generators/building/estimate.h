#pragma once
/// The size of the output of a building, estimated from its shapes before meshes are made.
#include "core/generators/api.h"
#include "core/generators/building/materials.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// A building with more shapes than this gets no estimate.
constexpr std::uint64_t most_estimated_shapes = 100'000;

/// Returns the triangles and bytes of the shapes. Triangles of boxes and rectangles are exact. Those of solids follow
/// from the numbers of their corners. A built-in part is made once for each of its sizes and counted. Returns nullopt
/// for more than 500 sizes of parts, for assets that are no built-in part, and for flat parts. `materials` gets the
/// materials of all shapes and parts; with `tangents`, vertices with a normal map have tangents. Images of textures are not
/// counted.
///
/// Bytes follow add_bodies(): a shared mesh counts once, together with its nodes, and a merged mesh counts once for
/// each body. Shapes that are too thin to be drawn count as well, so that the estimate may be too high.
struct EstimateOptions {
  CopyForm copies = CopyForm::any;
  bool shares_all = false;  ///< equal bodies share a mesh, and each has a node
  bool tangents = false;
};
std::optional<Estimate> estimate_of(const Shapes& shapes, MaterialTable& materials,
                                    const EstimateOptions& options, Job& job);

}  // namespace seedmesh::building
