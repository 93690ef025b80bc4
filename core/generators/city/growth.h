#pragma once
/// Streets that grow: major streets first, then the cells between them one by one, so that a change in one
/// quarter stays there. Kelly and McCabe, "Citygen: an interactive system for procedural city generation", 2007,
/// over the productions of Parish and Mueller (productions.h).
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/productions.h"

namespace seedmesh {
struct CityStreets;
}

namespace seedmesh::city {

/// What the growth reads.
struct GrowthInput {
  const CityStreets& streets;
  const FieldMap& density;
  const StreetGrammar& grammar;
  const std::vector<CmRing>& area;  ///< the outer ring counter-clockwise, then holes clockwise
};

/// A piece of street between two points.
struct StreetPiece {
  CmPoint a, b;
  EdgeClass kind;
};

/// Whether a position in centimetres is inside the area.
bool is_in_area(const std::vector<CmRing>& area, const glm::dvec2& cm);

/// The major streets, or all streets of a raster, clipped to the area.
std::vector<StreetPiece> grow_majors(const GrowthInput& input, Job& job);

/// The minor streets within one cell, which is a face of the graph of major streets and the border. `loops`
/// holds the half-edges of its outline and of the components inside.
std::vector<StreetPiece> grow_cell(const GrowthInput& input, const StreetGraph& majors,
                                   const std::vector<std::vector<std::uint32_t>>& loops, Job& job);

/// The whole street graph: majors, cells, and what is left after pieces outside of the area and loose components
/// are removed.
StreetGraph grow_streets(const GrowthInput& input, Job& job);

/// The directions of a pattern at a position: a unit vector; the others are its quarter turns.
glm::dvec2 frame_at(const CityStreets& streets, bool is_radial, const glm::dvec2& cm);

}  // namespace seedmesh::city
