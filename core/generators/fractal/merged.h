#pragma once
/// BitGrid -> Mesh with few triangles: squares of one plane that face alike become rectangles.
#include "core/generators/fractal/faces.h"

namespace seedmesh::fractal {

/// The surface of exposed_faces() as rectangles: in each plane runs of squares that stand above each other
/// are one. A corner of any rectangle is a vertex of every rectangle on whose rim it lies, so that the mesh
/// is closed as that of the squares is and no T-junction is left. Flat normals; rectangles of one plane share
/// vertices. Spends two triangles for each rectangle as they are found, the rest before the mesh is made. The
/// corners take a bit for each corner of a cell while it runs. Slices are made in parallel, each at a place
/// that was counted before.
Mesh merged_faces(const Solid& solid, const SideColors* colors, Job& job);

}  // namespace seedmesh::fractal
