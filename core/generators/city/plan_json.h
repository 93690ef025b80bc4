#pragma once
/// The plan as GeoJSON in local metres: [east, north], and on a terrain the height as a third number. Rings are closed
/// and have the winding order of RFC 7946.
#include "core/generators/city/plan.h"
#include "core/schema/json.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Returns a FeatureCollection; docs/cities.md lists kinds and properties.
Json plan_json(const CityPlan& plan, const CityParams& params, Job& job);

}  // namespace seedmesh::city
