#pragma once
/// Wards of a medieval town: cells about a centre, streets between them, a wall around them with gates, a square and a
/// citadel. After the stages of Dunayev, "Medieval fantasy city generator" (TownGeneratorOS, 2016-2017).
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

/// The data that wards depend on besides their parameters.
struct WardGround {
  const Region& region;
  const FieldMap& density;
  const FieldMap* obstacles = nullptr;  ///< null: none
  const Landform* landform = nullptr;   ///< null: level ground
};

/// Lays out the wards, which are Voronoi cells of points on a spiral, those nearest to the centre first. A cell has to
/// be on land, 25 m away from water and the border, free of obstacles, populated, and not too steep. All wards
/// together have one outline without a hole. Main streets are shortest paths along the cells from the gates to the
/// square; roads lead straight from the gates to the border of the area. Adds the cross sections of the streets along
/// the wall to `sections`. Adds an issue if fewer than four cells are suitable. Cost: quadratic in the number of
/// wards.
WardPlan lay_out_wards(const CityParams& params, const WardGround& ground,
                       std::vector<CrossSection>& sections, Job& job, std::vector<Issue>& issues);

/// Returns the ward that contains a position in centimetres; null if there is none.
const Ward* ward_at(const std::vector<Ward>& wards, const glm::dvec2& cm);

}  // namespace seedmesh::city
