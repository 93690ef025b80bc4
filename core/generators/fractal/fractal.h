#pragma once
/// Fractals by reduction copy machines: deterministic (MRCM), by chance (FRCM, the chaos game), and by escape
/// time.
///
///   params -> instructions (maps) -> lattice of bits -> faces
///                                 -> copies of the element, one mesh and many nodes
///                                 -> chaos game -> points, elements or voxels
///          -> escape times -> plate
///
/// Out:    the unit element's centre at the origin, +Y up, `size` metres an edge; a node for each stage. What
/// is
///         not a manifold is told in asset.extras: `non_manifold_edges`.
/// Issues: /instructions/… for maps that grow (mrcm), do not contract (frcm) or leave nothing; /text;
/// /element;
///         /iterations for what would pass a limit, before any of it is made.
/// Cost:   faces: about 60 bytes and 10 ns a square. points: 7 ns. See docs/fractals.md.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/base/job.h"
#include "core/generators/appraisal.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

std::vector<Issue> check(const FractalParams& params, const Limits& limits);
Result<Model> generate(const FractalParams& params, Job& job);

/// {pieces, dimension, exposed_quads, surface_area, volume, genus, bounds, non_manifold_edges, warnings}, in
/// the frame of the unit element; null where it does not apply or is not known.
Result<Json> derive(const FractalParams& params, Job& job);
Result<Appraisal> appraise(const FractalParams& params, const Job& job);

/// The named instructions.
Json vocabulary();

}  // namespace seedmesh::fractal
