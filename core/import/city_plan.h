#pragma once
/// Converts plans of the generator `city` (docs/cities.md, Plan) to maps, by adding tags of OpenStreetMap to
/// their features.
#include "core/import/map_data.h"
#include "core/schema/json.h"

namespace seedmesh {

/// Whether a FeatureCollection is a plan of `city`: it states local metres, or has the area as its first feature.
bool is_city_plan(const Json& file);

/// Gives a feature of a plan its tags. A lot becomes the footprint of its building. Returns false for a
/// feature whose content other features already show, such as a node or a carriageway.
bool describe_plan_feature(const Json& properties, MapFeature& feature);

}  // namespace seedmesh
