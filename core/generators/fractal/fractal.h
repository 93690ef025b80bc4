#pragma once
/// Iterated function systems, as reduction copy machines, and escape-time fractals:
///
///   method mrcm    all maps in every round, deterministic
///   method frcm    the chaos game: randomly chosen maps
///   method escape  the Mandelbrot set and Julia sets
///
///   params -> instructions (maps) -> lattice of bits -> faces
///                                 -> copies of the element: one mesh, many nodes
///                                 -> chaos game -> points, elements or voxels
///          -> escape times -> plate
/// Result: the centre of the unit element is at the origin, +Y is up, an edge has `size` metres. There is a node
/// for each stage. asset.extras has `non_manifold_edges`, the number of edges at which four faces meet.
///
/// Errors: /instructions/... for maps that enlarge (mrcm), do not contract (frcm) or leave nothing;
///         /text; /element; /iterations for a fractal that would exceed a limit, before any part of it is
///         made.
///
/// Cost:   about 60 bytes and 10 ns for each square, 7 ns for each point. See docs/fractals.md.
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/generators/api.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// Returns all errors that the schema cannot express. Pointers are relative to the parameters.
std::vector<Issue> check(const FractalParams& params, const Limits& limits);
/// Returns one warning for each parameter that is given and has no effect. Pointers are relative to the parameters.
std::vector<Warning> warnings_of(const FractalParams& params);

/// Generates the model of a fractal.
Result<Model> generate(const FractalParams& params, const GenerateContext& context);

/// {pieces, dimension, exposed_quads, surface_area, volume, genus, bounds, non_manifold_edges, warnings}, in
/// the frame of the unit element. A member that does not apply or is not known is null.
Result<Json> derive(const FractalParams& params, const GenerateContext& context);
Result<Appraisal> appraise(const FractalParams& params, const GenerateContext& context);

/// {instructions: [{name, maps, lattice}]}: the named instructions.
Json vocabulary();

}  // namespace seedmesh::fractal
