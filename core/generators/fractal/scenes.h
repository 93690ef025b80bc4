#pragma once
/// How parts of a fractal become nodes of a model.
#include <functional>
#include <string>

#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/pieces.h"

namespace seedmesh::fractal {

/// Adds a mesh with material 0, shown by a node of its own below `parent`.
void add_mesh(Model& model, int parent, const std::string& name, Mesh mesh);

/// Calls `make(node, amount)` for the one amount, or for each stage of the request with a node of its own,
/// beside each other in rows from left to right and from top to bottom.
void each_stage(Model& model, const FractalParams& params, std::int64_t amount,
                const std::function<void(int node, std::int64_t amount)>& make);

/// A cloud as points, copies of `element`, or the surface of the cells that hold points.
void add_cloud(Model& model, int parent, const FractalParams& params, Cloud cloud,
               const std::vector<Primitive>& element, Job& job);

/// The area inside the Koch snowflake as a plate, a tenth as thick as the unit element. Closed.
Mesh koch_plate(int rounds, double size, Job& job);

}  // namespace seedmesh::fractal
