#pragma once
/// Heights of streets on natural ground. Grades keep the limits of their classes exactly.
#include <vector>

#include "core/base/job.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

struct CityPlan;
struct SeparatedStreet;
class Landform;

/// A point on the centre line of a street.
struct ProfilePoint {
  CmPoint at;
  double station = 0;  ///< distance along the street from its first node, metres
  double height = 0;
};

/// A reach that is longer than all ways.
constexpr double everywhere = 1e30;

/// The heights of all streets. Empty on level ground.
struct StreetHeights {
  std::vector<double> node;          ///< heights, indexed by node, metres
  std::vector<ProfilePoint> points;  ///< points of all streets, both nodes of each included
  /// Index into `points` of the first point of each edge; one more at the end.
  std::vector<std::uint32_t> first;

  bool is_level() const { return node.empty(); }
};

/// Computes the heights of nodes, streets, bridges and tunnels from the natural ground. Streets are level as far as the
/// corners at their nodes reach (CityPlan::corner_reaches), so that junctions are level. Between these corners,
/// streets are sampled about every 10 m; bridges and tunnels have no samples. Two passes of Dijkstra's algorithm give upper and
/// lower heights, with the grade limit of each class as cost. These heights differ from the ground only where a limit
/// requires it. Their mean keeps all limits with the least possible greatest cut or fill. Heights are then smoothed
/// along the streets and limited again. `least` is a lower bound of all heights. Cost: n log n in the samples.
/// With a `reach`, in metres, a height depends only on the ground of streets on ways of at most this length, and limits
/// may be exceeded.
StreetHeights street_heights(const CityPlan& plan, const Landform& landform, double least, double reach,
                             Job& job);

/// Returns the height of an edge at a station, both in metres. Beyond an end, the height is that of the end.
double height_on_street(const StreetHeights& heights, std::uint32_t edge, double station);

/// Returns the points of a street of level 0 that a plan shows: its ends, and on a terrain also the points where its
/// grade changes. Their positions are whole centimetres.
std::vector<ProfilePoint> shown_profile(const CityPlan& plan, std::uint32_t edge);

/// Returns the points of a street on another level: its corners and points about every 10 m between them. On level
/// ground, heights are measured from the ground.
std::vector<ProfilePoint> separated_profile(const CityPlan& plan, const SeparatedStreet& street);

}  // namespace seedmesh::city
