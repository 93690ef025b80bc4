#pragma once
/// The mesh of a field with refined ground.
#include "core/generators/terrain/refined_ground.h"
#include "core/model/mesh.h"

namespace seedmesh::terrain {

/// The site of a vertex, and the members `weight` and `small` of its RefinedPoint.
struct VertexSite {
  Site site;
  float weight = 0, small = 0;
};

struct RefinedMesh {
  Mesh mesh;                ///< samples of the field first, row by row
  Array<VertexSite> sites;  ///< of each vertex; those of samples outside of the reach are empty
};

/// Triangulates all samples of the field like grid_mesh(), and the divided squares with more vertices. Neighbours share
/// all vertices of their common edges. Vertices of the border, and of squares that are not divided and have no divided
/// neighbour, are those of grid_mesh(). `colors` is empty or has all samples. Spends triangles. Cost: about 0.6
/// microseconds for each vertex of divided squares.
RefinedMesh refined_mesh(const Field& field, const RefinedGround& ground, const GroundColors& ground_colors,
                         const Array<glm::u8vec4>& colors, Job& job);

}  // namespace seedmesh::terrain
