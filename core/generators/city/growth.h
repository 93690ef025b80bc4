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

/// The input of the growth. It owns only the member `sections`.
struct GrowthInput {
  const CityStreets& streets;
  const FieldMap& density;
  const StreetGrammar& grammar;
  const Region& region;
  const FieldMap* obstacles = nullptr;         ///< null: none
  const Route* given = nullptr;                ///< null: none
  const WardPlan* wards = nullptr;             ///< null: major streets grow
  const TensorField* tensor = nullptr;         ///< field of major streets; null: they follow a pattern
  const TensorField* minor_field = nullptr;    ///< field of minor streets; null: they follow a pattern
  const Landform* landform = nullptr;          ///< null: level ground
  const FootprintIndex* footprints = nullptr;  ///< null: none
  std::vector<CrossSection> sections = {};     ///< cross sections by tag
  double least_height = -1e9;                  ///< least height of streets, m

  /// Whether an obstacle is at a position in metres, or a given building is too near to it. The least distance from a
  /// given building is 1 m plus half the width of the widest class of streets with its sidewalk.
  bool is_blocked(const glm::dvec2& metres) const;
  /// Whether a given building is nearer to the piece than half the width of its street with the sidewalk. Samples the
  /// piece every metre.
  bool is_on_footprint(const StreetPiece& piece) const;
  /// Whether an obstacle is on the segment between two positions (cm), or its ground is too steep for `grade_limit`
  /// (rise over run). Samples the obstacles every 4 m.
  bool is_blocked(const glm::dvec2& a, const glm::dvec2& b, double grade_limit) const;
  /// The same for obstacles and given buildings alone.
  bool is_obstructed(const glm::dvec2& a, const glm::dvec2& b) const;
  /// Whether the ground along a segment (cm) is too steep. Between its ends it may be at most 1.5 times as
  /// steep as `grade_limit`, and at most 5 m above or below the straight line.
  bool is_too_steep(const glm::dvec2& a, const glm::dvec2& b, double grade_limit) const;
  /// Whether a piece keeps off the given streets, except where it crosses one of them at a wide angle.
  bool keeps_off_given(const StreetPiece& piece) const;
  /// Returns the grade limit of a street of a kind that grows.
  double limit_of(std::uint32_t kind) const;
  /// Whether no piece of a route meets an obstacle, a given street or ground that is too steep.
  bool is_free(const Route& route) const;
  /// Returns a route whose pieces on ground that is too steep are replaced by tunnels through a ridge, of at most
  /// `streets.tunnel_length`. Returns nullopt if another reason forbids the route, if the ground is too low, or if
  /// major streets follow slopes.
  std::optional<Route> tunnelled(const Route& route) const;
};

/// Returns the major streets, or all streets of a raster, clipped to the area.
Route grow_majors(const GrowthInput& input, Job& job);

/// Returns those positions that are on land, in centimetres, of a lattice of 15 by 15 over the bounding box of the
/// land.
std::vector<glm::dvec2> lattice_of(const Region& region);

/// Returns an estimate of the least number of pieces of streets that grow. It follows from counts on level, dense
/// areas. Returns 0 where there is no estimate.
double least_pieces(const GrowthInput& input);

/// Returns one straight street through a dense position, for areas in which the pattern has no street. Returns an
/// empty list if the density is too low everywhere, or if the productions build no road.
std::vector<StreetPiece> through_street(const GrowthInput& input, const Job& job);

/// Returns the local constraints of minor streets.
ConstraintLimits limits_of(const CityStreets& streets);

/// The minor streets of a cell. `has_branches` is true if a road was built from whose end other roads could branch
/// off.
struct CellStreets {
  std::vector<StreetPiece> pieces;
  bool has_branches = false;
};

/// Returns the minor streets within one cell, which is a face of the graph of major streets and the border. `loops`
/// contains the half-edges of its outline and of the components inside.
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

/// What becomes of networks that are separate from the longest one and contain no given street. `kept`: those of at
/// least 5 % of its length stay.
enum class Separate : std::uint8_t { kept, removed };

/// Removes grown streets whose cut or fill is deeper than 8 m, and streets that are loose without them. Returns false
/// if no street has such a cut or fill. `input.landform` must not be null. Cost: linear.
bool drop_deep_streets(const GrowthInput& input, const StreetHeights& heights, Separate separate,
                       StreetGraph& graph, Job& job);

/// Links separate networks by minor streets. Networks that stay separate and contain no given street are removed,
/// except the longest one. Cost: that of links_between_networks().
void link_networks(const GrowthInput& input, StreetGraph& graph, Job& job);

/// Returns one direction of a pattern at a position in centimetres, as a unit vector; the others are its quarter
/// turns. A radial pattern has the direction away from `streets.centre`, any other pattern that of `streets.angle`.
glm::dvec2 frame_at(const CityStreets& streets, bool is_radial, const glm::dvec2& cm);

}  // namespace seedmesh::city
