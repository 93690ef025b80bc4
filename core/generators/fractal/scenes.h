#pragma once
/// Nodes of a model for the parts of a fractal.
#include <functional>
#include <string>

#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/pieces.h"

namespace seedmesh::fractal {

/// Adds a mesh with material 0 and a node for it below `parent`.
void add_mesh(Model& model, int parent, const std::string& name, Mesh mesh);

/// Calls make(node, amount) once, or for each stage of the request with a node of its own. Stages are in rows
/// from left to right and from top to bottom.
void each_stage(Model& model, const FractalParams& params, std::int64_t amount, const Job& job,
                const std::function<void(int node, std::int64_t amount)>& make);

/// Adds a cloud as points, as copies of `element`, or as the surface of the cells that contain points.
void add_cloud(Model& model, int parent, const FractalParams& params, Cloud cloud,
               const std::vector<Primitive>& element, Job& job);

/// Returns the area inside the Koch snowflake as a closed plate with a tenth of the thickness of the unit element.
Mesh koch_plate(int rounds, double size, Job& job);

}  // namespace seedmesh::fractal
