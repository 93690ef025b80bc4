#pragma once
/// Streets that grow: major streets first, then the minor streets of each cell between them. A change in one
/// cell does not affect the others. Kelly and McCabe, "Citygen: an interactive system for procedural city
/// generation", 2007, over the productions of Parish and Mueller (productions.h).
#include <optional>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/productions.h"
#include "core/generators/city/route.h"

namespace seedmesh {
struct CityStreets;
}

namespace seedmesh::city {

struct WardPlan;
class Landform;
class TensorField;
class FootprintIndex;

/// The input of the growth. Of its members it owns only `sections`.
struct GrowthInput {
  const CityStreets& streets;
  const FieldMap& density;
  const StreetGrammar& grammar;
  const Region& region;
  const FieldMap* obstacles = nullptr;         ///< null: none
  const Route* given = nullptr;                ///< null: none
  const WardPlan* wards = nullptr;             ///< null: major streets grow
  const TensorField* tensor = nullptr;         ///< of major streets; null: they follow a pattern
  const TensorField* minor_field = nullptr;    ///< of minor streets; null: they follow a pattern
  const Landform* landform = nullptr;          ///< null: level ground
  const FootprintIndex* footprints = nullptr;  ///< null: none
  std::vector<CrossSection> sections = {};     ///< by tag
  double least_height = -1e9;                  ///< of streets, m

  /// Whether an obstacle is at a position in metres, or a given building is too near. Its least distance is 1 m
  /// plus half the width of the widest class of streets with its sidewalk.
  bool is_blocked(const glm::dvec2& metres) const;
  /// Whether a given building is nearer to the piece than half the width of its street with the sidewalk. Samples the
  /// piece every metre.
  bool is_on_footprint(const StreetPiece& piece) const;
  /// Whether an obstacle is on the segment between two positions (cm), or the ground along it is too steep
  /// for a street of this grade limit. Samples the obstacles every 4 m.
  bool is_blocked(const glm::dvec2& a, const glm::dvec2& b, double grade_limit) const;
  /// The same for obstacles and given buildings alone.
  bool is_obstructed(const glm::dvec2& a, const glm::dvec2& b) const;
  /// Whether the ground along a segment (cm) is too steep. Between its ends it may be at most 1.5 times as
  /// steep as `grade_limit`, and at most 5 m above or below the straight line.
  bool is_too_steep(const glm::dvec2& a, const glm::dvec2& b, double grade_limit) const;
  /// Whether a piece meets given streets only where it crosses one of them at a wide angle.
  bool keeps_off_given(const StreetPiece& piece) const;
  /// Returns the grade limit of a street of a kind that grows.
  double limit_of(std::uint32_t kind) const;
  /// Whether no piece of a route meets an obstacle, a given street or ground that is too steep.
  bool is_free(const Route& route) const;
  /// Returns a route whose pieces on ground that is too steep are replaced by tunnels through a ridge, of at most
  /// `streets.tunnel_length`. Nothing where another reason forbids the route, where the ground is too low, or where
  /// major streets follow slopes.
  std::optional<Route> tunnelled(const Route& route) const;
};

/// Returns the major streets, or all streets of a raster, clipped to the area.
Route grow_majors(const GrowthInput& input, Job& job);

/// Returns positions in centimetres that are on land, out of a lattice of 15 by 15 over the bounding box of the land.
std::vector<glm::dvec2> lattice_of(const Region& region);

/// Returns how many pieces of streets grow at least: an estimate from the counts of level, dense areas, or 0 where it is
/// not known.
double least_pieces(const GrowthInput& input);

/// Returns one straight street through a dense position, for areas in which the pattern has no street. Empty where the
/// density is too low everywhere, or if the productions build no road.
std::vector<StreetPiece> through_street(const GrowthInput& input, const Job& job);

/// Returns the local constraints of minor streets.
ConstraintLimits limits_of(const CityStreets& streets);

/// The minor streets of a cell. `has_branches`: a road was built at whose end others could branch off.
struct CellStreets {
  std::vector<StreetPiece> pieces;
  bool has_branches = false;
};

/// Returns the minor streets within one cell, which is a face of the graph of major streets and the border. `loops`
/// holds the half-edges of its outline and of the components inside.
CellStreets grow_cell(const GrowthInput& input, const StreetGraph& majors,
                      const std::vector<std::vector<std::uint32_t>>& loops, Job& job);

/// Whether all streets, with those of other levels, are one network. Cost: linear.
bool is_one_network(const StreetGraph& graph);

/// Returns straight minor streets between networks that have no common node. The shortest network comes first.
/// Its link is the shortest one that meets streets at wide angles and crosses no street, shore, border or
/// obstacle. Networks without such a link stay apart. Cost for each network: 64 times the edges.
std::vector<StreetPiece> links_between_networks(const GrowthInput& input, const StreetGraph& graph,
                                                const Job& job);

/// Makes a share of the minor streets lanes. A street ends at junctions, at dead ends and where its class changes.
/// Choices depend on the positions of its ends alone.
void choose_lanes(StreetGraph& graph, double share, const Rng& rng);

/// Returns the whole street graph: the major streets and the streets of all cells. Pieces outside of the area and
/// loose components have been removed.
StreetGraph grow_streets(const GrowthInput& input, Job& job);

/// Removes the streets that grew where their cut or fill is deeper than 8 m, and what is loose without them. Returns
/// false if there are none. `input` has a landform. Cost: linear.
bool drop_deep_streets(const GrowthInput& input, const StreetHeights& heights, StreetGraph& graph, Job& job);

/// Returns one direction of a pattern at a position in centimetres, as a unit vector; the others are its quarter
/// turns. Radial: away from `streets.centre`. Otherwise: `streets.angle`.
glm::dvec2 frame_at(const CityStreets& streets, bool is_radial, const glm::dvec2& cm);

}  // namespace seedmesh::city
