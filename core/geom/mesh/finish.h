#pragma once
/// The last steps between a generator and a writer.
#include "core/model/model.h"

namespace seedmesh {

/// Removes empty meshes; orders triangles for the vertex cache where that is not done yet; replaces -0 by 0;
/// computes bounds; narrows indices; and gives nodes, meshes and materials unique names.
void finish(Model& model, Job& job);

/// Performs only those of the steps above that concern single meshes. For code that packs a part of a model before
/// the rest is made.
void finish_meshes(Model& model, const Job& job);

/// Orders the triangles for a vertex cache and the vertices by first use, and removes unused vertices. Does
/// nothing where Mesh::cache_ordered is set. To be called before a mesh is copied many times.
void order_for_cache(Mesh& mesh, const Job& job);

}  // namespace seedmesh
