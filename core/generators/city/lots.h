#pragma once
/// Lots: blocks cut in two until the pieces are small enough. A cut is refused if it would leave a piece too
/// small, too narrow, too pointed, or without its frontage. Every lot therefore has access to a street.
/// Vanegas, Kelly, Weber, Halatsch, Aliaga and Mueller, "Procedural generation of parcels in urban modeling",
/// 2012, with access tested before a cut instead of after it.
#include "core/base/job.h"
#include "core/generators/city/density.h"
#include "core/generators/city/plan.h"
#include "core/generators/city/ribbons.h"

namespace seedmesh {
struct CityLots;
}

namespace seedmesh::city {

/// Divides the blocks and adds blocks, lots, parks and squares to the plan. Corners that cuts add to the outline
/// of a block are added to the sidewalks around it.
void divide_blocks(CityPlan& plan, std::vector<BlockOutline> outlines, const CityLots& lots,
                   const FieldMap& density, Job& job);

}  // namespace seedmesh::city
