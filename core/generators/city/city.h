#pragma once
/// Cities: an exact partition of an area into streets, blocks, lots, parks and squares.
///
///   params -> grow_streets(): major streets, then minor streets in the faces between them -> StreetGraph
///          -> lay_out_streets(): carriageways, junctions, sidewalks, outlines of blocks
///          -> divide_blocks(): lots with street access -> place_houses() -> CityPlan
///          -> plan_json() and statistics_of(), or city_model()
///
/// x is east and y north in the plan; the model has x east, y up and z south. The origin is that of the request.
/// docs/cities.md describes the plan.
#include "core/generators/api.h"
#include "core/generators/city/plan.h"
#include "core/gltf/payload.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Returns all errors that the schema cannot express, with pointers relative to the parameters.
std::vector<Issue> check(const CityParams& params, const CheckContext& context);

/// Returns the plan as data; for its output forms see plan_json() and city_model(). Errors: those of check().
Result<CityPlan> plan_of(const CityParams& params, Job& job);

/// Like plan_of(), on ground that another generator made, which replaces params.terrain and params.maps.height.
Result<CityPlan> plan_on(const CityParams& params, std::shared_ptr<const Landform> ground, Job& job);

/// Generates the model of a city. Errors: those of check(), and limits.
Result<Model> generate(const CityParams& params, const GenerateContext& context);

/// Returns the object {statistics, plan, warnings}; see plan_json() and statistics_of().
Result<Json> derive(const CityParams& params, const GenerateContext& context);

/// Computes the plan, and generates one sample building for each rule, number of floors and class of widths of 2 m.
/// Triangles and bytes of the other buildings are estimated from these samples.
Result<Appraisal> appraise(const CityParams& params, const GenerateContext& context);

/// Returns the plan alone, in the format "geojson".
Result<Payload> encode(const CityParams& params, const WantedFormat& format, const GenerateContext& context);

/// Returns an empty object: the words of street productions are those of the generator lsystem.
Json vocabulary();

}  // namespace seedmesh::city
