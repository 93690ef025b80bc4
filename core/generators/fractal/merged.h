#pragma once
/// Solid -> Mesh with few triangles: squares of one plane that face the same way become rectangles.
#include "core/generators/fractal/faces.h"

namespace seedmesh::fractal {

/// Returns the surface of exposed_faces() as rectangles: equal runs of squares in consecutive rows of a plane become
/// one. A corner of a rectangle is a vertex of every rectangle on whose boundary it lies, so the mesh is
/// closed and has no T-junctions. Normals are flat. Rectangles of one plane share vertices. Spends two
/// triangles for each rectangle when it is found, and further triangles of rectangles with more than four
/// vertices before the mesh is made. Needs one bit for each corner of a cell. Slices are made in parallel.
Mesh merged_faces(const Solid& solid, const SideColors* colors, Job& job);

}  // namespace seedmesh::fractal
