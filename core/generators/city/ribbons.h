#pragma once
/// Computes street areas and blocks from the street graph. Kerbs and block borders are inward offsets of the outline of
/// each face of the graph. Each corner is computed once and shared by all polygons that meet there, so that the
/// partition has neither gap nor overlap.
#include "core/base/job.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// An edge of a block's outline.
struct BlockEdge {
  std::uint32_t street = no_index;  ///< edge of the graph; no_index on the border of the area
  /// Index of the part (sidewalk) between this edge and the street. The ring of that part contains the edge
  /// in the opposite direction.
  std::uint32_t sidewalk = no_index;
};

/// A block before it is divided.
struct BlockOutline {
  CmRing ring;
  std::vector<BlockEdge> edges;  ///< edge i runs from point i to the next
  /// Outlines of separate street networks inside the block, clockwise; their edges are not in `edges`.
  std::vector<CmRing> holes;
  std::vector<std::uint32_t> hole_streets;  ///< edges of the street graph that surround the holes
};

/// The cut across the corners of blocks, between streets.
struct CornerCut {
  double width = 0;            ///< centimetres; 0: none
  double greatest_angle = 90;  ///< greatest angle of the corners that are cut, degrees
};

/// Adds carriageways, junctions, sidewalks and verges to the plan, and returns the outlines of the blocks in the
/// order of the faces. Areas that the cut takes from the blocks belong to the sidewalks.
std::vector<BlockOutline> lay_out_streets(CityPlan& plan, const CornerCut& cut, Job& job);

}  // namespace seedmesh::city
