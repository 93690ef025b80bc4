#pragma once
/// Heights of streets on natural ground. Grades keep the limits of their classes exactly.
#include <vector>

#include "core/base/job.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

struct CityPlan;
struct Bridge;
class Landform;

/// A point of the middle of a street.
struct ProfilePoint {
  CmPoint at;
  double station = 0;  ///< distance along the street from its first node, metres
  double height = 0;
};

/// The heights of all streets. Empty on level ground.
struct StreetHeights {
  std::vector<double> node;          ///< heights, indexed by node, metres
  std::vector<ProfilePoint> points;  ///< points of all streets, both nodes of each included
  std::vector<std::uint32_t> first;  ///< index into `points`, by edge and one more

  bool is_level() const { return node.empty(); }
};

/// Computes the heights of nodes, streets and bridges from the natural ground. Streets are level as far as the
/// corners at their nodes reach (CityPlan::corner_reaches), so that junctions are level. Between these corners,
/// streets are sampled about every 10 m; bridges have no samples. Two passes of Dijkstra's algorithm, with the
/// grade limit of each class as cost, give upper and lower heights that differ from the ground only where a limit
/// requires it. Their mean keeps all limits with the least possible greatest cut or fill. Heights are then
/// smoothed along the streets and limited again. `least` is a lower bound of all heights. Cost: n log n in the
/// samples.
StreetHeights street_heights(const CityPlan& plan, const Landform& landform, double least, Job& job);

/// Returns the height of an edge at a station in metres; level beyond both ends.
double height_on_street(const StreetHeights& heights, std::uint32_t edge, double station);

/// Returns the steepest grade of a street, as rise over run.
double steepest_grade(const StreetHeights& heights, std::uint32_t edge);

/// Returns the points of a street of level 0 that a plan shows: its ends, and on a terrain the points where its grade
/// changes, which are whole centimetres.
std::vector<ProfilePoint> shown_profile(const CityPlan& plan, std::uint32_t edge);

/// Returns the points of a street on another level: its corners and points about every 10 m between them. On level
/// ground the heights are those above it.
std::vector<ProfilePoint> bridge_profile(const CityPlan& plan, const Bridge& bridge);

}  // namespace seedmesh::city
