#pragma once
/// From the street graph to street space and blocks. In each face the kerbs and then the borders of the blocks
/// are the outline moved inwards; the corners of both are computed once and shared by all polygons at them, so
/// that the partition has neither gap nor overlap.
#include "core/base/job.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// An edge of a block's outline.
struct BlockEdge {
  std::uint32_t street = no_index;  ///< edge of the graph; no_index on the border of the area
  std::uint32_t sidewalk =
      no_index;  ///< part between it and the street; its ring contains this edge reversed
};

/// A block before it is divided.
struct BlockOutline {
  CmRing ring;
  std::vector<BlockEdge> edges;             ///< edge i runs from point i to the next
  std::vector<CmRing> holes;                ///< outlines of components inside, clockwise
  std::vector<std::uint32_t> hole_streets;  ///< streets around the holes
};

/// Adds carriageways, junctions, sidewalks and verges to the plan, and returns the outlines of the blocks in the
/// order of the faces.
std::vector<BlockOutline> lay_out_streets(CityPlan& plan, Job& job);

}  // namespace seedmesh::city
