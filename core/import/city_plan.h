#pragma once
/// Plans of the generator `city` (docs/cities.md, Plan) as maps: what their features are, in tags of OpenStreetMap.
#include "core/import/map_data.h"
#include "core/schema/json.h"

namespace seedmesh {

/// Whether a FeatureCollection is such a plan: it states local metres, or has the area as its first feature.
bool is_city_plan(const Json& file);

/// Gives a feature of a plan its tags. A lot becomes the footprint of its building. False: the feature only describes
/// what others draw, such as a node or a carriageway.
bool describe_plan_feature(const Json& properties, MapFeature& feature);

}  // namespace seedmesh
