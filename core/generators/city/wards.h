#pragma once
/// Wards of a medieval town: cells about a centre, streets between them, a wall around them with gates, a square and a
/// citadel. After the stages of Dunayev, "Medieval fantasy city generator" (TownGeneratorOS, 2016-2017).
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/route.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

class Landform;

/// The streets of a town of wards, before minor streets divide them.
struct WardPlan {
  std::vector<Ward> wards;
  Route route;                 ///< streets between wards, along the wall, and from the gates to the border
  std::vector<CmPoint> gates;  ///< nodes of the wall
};

/// What wards depend on besides their parameters.
struct WardGround {
  const Region& region;
  const FieldMap& density;
  const FieldMap* obstacles = nullptr;  ///< null: none
  const Landform* landform = nullptr;   ///< null: level ground
};

/// Lays out the wards: Voronoi cells of points on a spiral, those nearest to the centre first, as long as they lie on
/// land, have one outline without a hole, and no street around them is too steep. Main streets are shortest paths along the cells from the gates to the
/// square; roads lead straight from the gates to the border of the area. Adds the cross sections of the streets along
/// the wall to `sections`. Issues: fewer than four wards find space. Cost: quadratic in the number of wards.
WardPlan lay_out_wards(const CityParams& params, const WardGround& ground,
                       std::vector<CrossSection>& sections, Job& job, std::vector<Issue>& issues);

/// The ward around a position in centimetres; null outside of all.
const Ward* ward_at(const std::vector<Ward>& wards, const glm::dvec2& cm);

}  // namespace seedmesh::city
