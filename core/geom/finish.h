#pragma once
/// The list of steps that every model goes through between its generator and the writer.
#include "core/model/model.h"

namespace seedmesh {

/// In order: drops empty meshes, orders triangles for the vertex cache where the maker did not, narrows
/// indices, sets bounds, replaces -0 by 0, names what has no name (unique names for nodes, meshes,
/// materials).
void finish(Model& model, Job& job);

/// Of these steps those that are about meshes alone. For who packs a part of a model before the rest is made.
void finish_meshes(Model& model, const Job& job);

/// Triangles in an order that a vertex cache likes, vertices in the order of their first use; unused ones go.
/// Nothing where the mesh says that it is so. For who makes many copies of a mesh.
void order_for_cache(Mesh& mesh, const Job& job);

}  // namespace seedmesh
