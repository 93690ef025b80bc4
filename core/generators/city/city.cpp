#include "core/generators/city/city.h"

#include <algorithm>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "core/base/heap.h"
#include "core/generators/city/bridge_mesh.h"
#include "core/generators/city/city_model.h"
#include "core/generators/city/contents.h"
#include "core/generators/city/footprints.h"
#include "core/generators/city/given.h"
#include "core/generators/city/growth.h"
#include "core/generators/city/house_placement.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/lots.h"
#include "core/generators/city/plan_json.h"
#include "core/generators/city/plan_warnings.h"
#include "core/generators/city/statistics.h"
#include "core/generators/city/surface.h"
#include "core/generators/city/tensor.h"
#include "core/generators/city/wards.h"
#include "core/schema/json.h"
#include "core/schema/warning_list.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

// Estimates, with the lists that only the making needs.
constexpr std::uint64_t bytes_a_street = 2500;
constexpr std::uint64_t bytes_a_lot = 900;

CmPoint centimetres(double east, double north) { return rounded_cm({east * 100, north * 100}); }

std::vector<CmRing> area_rings(const CityParams& params) {
  if (params.area.polygon.empty()) {
    const double east = params.area.size[0] / 2, north = params.area.size[1] / 2;
    return {{centimetres(-east, -north), centimetres(east, -north), centimetres(east, north),
             centimetres(-east, north)}};
  }
  std::vector<CmRing> rings;
  for (const auto& given : params.area.polygon) {
    CmRing ring;
    for (const auto& p : given) {
      const CmPoint point = centimetres(p[0], p[1]);
      if (ring.empty() || ring.back() != point) ring.push_back(point);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    const bool is_outer = rings.empty();
    if ((doubled_area(ring) > 0) != is_outer) std::reverse(ring.begin(), ring.end());
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// The box around the area, in metres.
struct Box {
  glm::dvec2 low, high;
};
Box box_of(const std::vector<CmRing>& area) {
  Box box{in_metres(area[0][0]), in_metres(area[0][0])};
  for (const CmPoint& p : area[0]) {
    box.low = glm::min(box.low, in_metres(p));
    box.high = glm::max(box.high, in_metres(p));
  }
  return box;
}

/// The maps of a request; those that it does not have are empty.
struct Maps {
  std::optional<FieldMap> density, water, obstacles, pattern;
};
Maps read_maps(const CityParams& params, const Box& box, const Job& job, std::vector<Issue>& issues) {
  const auto read = [&](const MapValue& value, const char* pointer) {
    return FieldMap::read(value, pointer, box.low, box.high, job, issues);
  };
  Maps maps;
  maps.density = read(params.maps.density, "/maps/density");
  if (params.maps.water) maps.water = read(*params.maps.water, "/maps/water");
  if (params.maps.obstacles) maps.obstacles = read(*params.maps.obstacles, "/maps/obstacles");
  if (params.maps.pattern) maps.pattern = read(*params.maps.pattern, "/maps/pattern");
  return maps;
}

std::vector<NamedZone> zones_of(const CityParams& params, const Box& box, const Job& job,
                                std::vector<Issue>& issues) {
  std::vector<NamedZone> zones;
  zones.reserve(params.maps.zones.size());
  for (std::size_t i = 0; i < params.maps.zones.size(); ++i) {
    const std::string pointer = "/maps/zones/" + std::to_string(i) + "/area";
    auto map = FieldMap::read(params.maps.zones[i].area, pointer, box.low, box.high, job, issues);
    if (map) zones.push_back({params.maps.zones[i].zone, *std::move(map)});
  }
  return zones;
}

/// The area cut into land and water.
Region region_of_request(const CityParams& params, const Maps& maps, const CityPlan& plan, Job& job,
                         std::vector<Issue>& issues) {
  const std::vector<CmRing>& area = plan.area;
  std::vector<Rings> water = given_water(params, issues);
  if (const auto& level = plan.landform->water_level()) {
    const Box box = box_of(area);
    const auto is_water = [&](const glm::dvec2& p) { return plan.landform->at(p) < *level ? 1.0 : 0.0; };
    water.push_back(contour_of(is_water, box.low, box.high, job));
  }
  if (maps.water) {
    const Box box = box_of(area);
    const std::vector<Rings>& polygons = maps.water->polygons();
    water.insert(water.end(), polygons.begin(), polygons.end());
    if (polygons.empty()) {
      water.push_back(
          contour_of([&](const glm::dvec2& p) { return maps.water->at(p); }, box.low, box.high, job));
    }
  }
  return region_of(area, water, job);
}

/// The first point at which two bridges meet, unless it is an end of both, or they are equal.
std::optional<CmPoint> meeting_of(const CmRing& a, const CmRing& b) {
  if (a == b || std::equal(a.begin(), a.end(), b.rbegin(), b.rend())) return std::nullopt;
  for (std::size_t i = 1; i < a.size(); ++i) {
    for (std::size_t k = 1; k < b.size(); ++k) {
      if (!segments_meet(a[i - 1], a[i], b[k - 1], b[k])) continue;
      for (const CmPoint& p : {a[i - 1], a[i]}) {
        const bool is_common_end = (p == a.front() || p == a.back()) && (p == b.front() || p == b.back());
        if ((p == b[k - 1] || p == b[k]) && !is_common_end) return p;
      }
      if (cross_properly(a[i - 1], a[i], b[k - 1], b[k])) return a[i - 1];
    }
  }
  return std::nullopt;
}

/// The given streets as pieces, cut at the border and at water. A bridge that is given twice is kept once. Adds an issue
/// for a street that meets another one over water, since bridges have no junctions.
Route given_route_of(const Region& region, const std::vector<GivenLine>& lines, std::vector<Issue>& issues) {
  Route all;
  std::set<std::pair<int, CmRing>> known;
  const auto add_separated = [&](SeparatedLine separated) {
    const CmRing back(separated.line.rbegin(), separated.line.rend());
    if (known.emplace(separated.level, std::min(separated.line, back)).second)
      all.separated.push_back(std::move(separated));
  };
  std::vector<CmRing> over_water;
  for (const GivenLine& line : lines) {
    if (line.level != 0) {
      add_separated({line.points, line.section, line.level});
      continue;
    }
    Route route = given_route(region, line.points, line.section);
    all.pieces.insert(all.pieces.end(), route.pieces.begin(), route.pieces.end());
    for (SeparatedLine& each : route.separated) {
      for (const CmRing& other : over_water) {
        const std::optional<CmPoint> at = meeting_of(each.line, other);
        if (!at) continue;
        issues.emplace_back(conflict_with({}), line.geometry,
                            "meets another street over water near " + number_text(at->x / 100.0) + ", " +
                                number_text(at->y / 100.0) +
                                "; expected land there, since bridges have no junctions");
        break;
      }
      over_water.push_back(each.line);
      add_separated(std::move(each));
    }
  }
  return all;
}

/// Streets stay above the water of a terrain.
double least_height(const Landform& landform) {
  constexpr double freeboard = 1.5;  // m
  return landform.water_level() ? *landform.water_level() + freeboard : -1e9;
}

bool has_streets(const StreetGraph& graph) {
  for (std::uint32_t edge = 0; edge < graph.edges.size(); ++edge) {
    if (graph.is_street(edge)) return true;
  }
  return false;
}

Error too_steep(const CityParams& params) {
  return Error{
      Code::invalid,
      {{conflict_with({"streets"}), params.terrain ? "/terrain" : "/maps/height",
        "found no position where a street keeps its grade limit; expected less steep ground or greater "
        "limits in streets.classes"}}};
}

/// Refuses areas whose streets would need more memory than the limit, before they grow.
void refuse_too_large(const GrowthInput& input, const Job& job) {
  const std::uint64_t most = job.limits().memory_bytes;
  const double needed = least_pieces(input) * static_cast<double>(bytes_a_street);
  if (needed <= static_cast<double>(most)) return;
  job.refuse(limit_issue({Resource::memory_bytes, most, static_cast<std::uint64_t>(needed)},
                         "the streets of this area need more memory than the limit; expected a smaller area, "
                         "or greater distances between streets",
                         "/area"));
}

std::optional<Error> refusal(const CityParams& params, const GenerateContext& context) {
  std::vector<Issue> issues = check(params, {context.job, context.generators});
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

}  // namespace

/// Lays out the streets and finds their heights. On hills, removes streets with deep cuts or fills, whose removal
/// changes the heights of others, in up to 24 rounds. In the first rounds, heights depend on the streets around alone,
/// so that a change in one part affects few streets elsewhere. Networks that this separates stay until no street is too
/// deep, or until half of the rounds are over. Then they are linked once.
std::vector<BlockOutline> lay_out(CityPlan& plan, const GrowthInput& input, const CornerCut& cut, Job& job) {
  constexpr int most_rounds = 24, most_local_rounds = 8;
  constexpr double around = 150;  // m
  bool may_link = input.streets.method != CityMethod::given;
  bool is_local = input.landform != nullptr;
  for (int round = 0;; ++round) {
    plan.parts.clear();
    std::vector<BlockOutline> blocks = lay_out_streets(plan, cut, job);
    const auto set_heights = [&](double reach) {
      plan.heights = street_heights(plan, *plan.landform, input.least_height, reach, job);
    };
    if (is_local && round < most_local_rounds) {
      set_heights(around);
      if (drop_deep_streets(input, plan.heights, may_link ? Separate::kept : Separate::removed, plan.graph,
                            job)) {
        if (!has_streets(plan.graph)) return blocks;
        continue;
      }
    }
    is_local = false;
    set_heights(everywhere);
    if (!input.landform || round == most_rounds) return blocks;
    const bool keeps = may_link && round <= most_rounds / 2;
    const Separate separate = keeps ? Separate::kept : Separate::removed;
    const bool was_deep = drop_deep_streets(input, plan.heights, separate, plan.graph, job);
    const bool links =
        may_link && round > 0 && (!was_deep || round == most_rounds / 2) && !is_one_network(plan.graph);
    if ((!was_deep && !links) || !has_streets(plan.graph)) return blocks;
    if (!links) continue;
    link_networks(input, plan.graph, job);
    may_link = false;
  }
}

Result<CityPlan> plan_of(const CityParams& params, Job& job) { return plan_on(params, nullptr, job); }

Result<CityPlan> plan_on(const CityParams& params, std::shared_ptr<const Landform> given_ground, Job& job) {
  CityPlan plan;
  plan.area = area_rings(params);
  plan.classes = classes_of(params);
  plan.landmarks = landmarks_of(params, job);
  std::vector<Issue> issues;
  const Box box = box_of(plan.area);
  plan.zones = zones_of(params, box, job, issues);
  const StreetGrammar grammar(params.streets.productions, "/streets/productions", issues);
  const Maps maps = read_maps(params, box, job, issues);
  const std::vector<GivenFootprint> given_buildings = given_footprints(params, issues);
  for (Landmark& each : landmarks_of(given_buildings)) plan.landmarks.push_back(std::move(each));
  const FootprintIndex footprints(given_buildings);
  const std::vector<GivenLine> lines = given_lines(params, plan.classes, issues);
  if (!issues.empty() || !maps.density) return Error{Code::invalid, std::move(issues)};
  plan.landform = std::move(given_ground);
  if (!plan.landform) {
    Result<Landform> ground = Landform::make(params, box.low, box.high, job);
    if (!ground) return std::move(ground).error();
    plan.landform = std::make_shared<const Landform>(std::move(*ground));
  }
  plan.region = region_of_request(params, maps, plan, job, issues);
  const Route given = given_route_of(plan.region, lines, issues);
  job.progress("streets", 0);
  const FieldMap* obstacles = maps.obstacles ? &*maps.obstacles : nullptr;
  const Landform* landform = plan.landform->is_level() ? nullptr : plan.landform.get();
  WardPlan wards;
  const bool has_wards = params.streets.method == CityMethod::wards;
  if (has_wards) {
    wards =
        lay_out_wards(params, {plan.region, *maps.density, obstacles, landform}, plan.classes, job, issues);
  }
  const FieldMap* blend = maps.pattern ? &*maps.pattern : nullptr;
  const StreetFields fields =
      fields_of(params.streets, {plan.region, blend, landform}, job.rng().at("pattern"), issues);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  const GrowthInput input = {params.streets,
                             *maps.density,
                             grammar,
                             plan.region,
                             obstacles,
                             lines.empty() ? nullptr : &given,
                             has_wards ? &wards : nullptr,
                             fields.majors.get(),
                             fields.minors.get(),
                             landform,
                             footprints.is_empty() ? nullptr : &footprints,
                             plan.classes,
                             least_height(*plan.landform)};
  refuse_too_large(input, job);
  plan.graph = grow_streets(input, job);
  plan.wards = std::move(wards.wards);
  plan.gates = std::move(wards.gates);
  plan.charges.emplace_back(job, plan.graph.edges.size() * bytes_a_street);
  job.progress("blocks", 0);
  if (landform && !has_streets(plan.graph)) return too_steep(params);
  const CornerCut cut = {params.lots.corner_width * 100, params.lots.corner_angle};
  std::vector<BlockOutline> blocks = lay_out(plan, input, cut, job);
  if (landform && !has_streets(plan.graph)) return too_steep(params);
  job.progress("lots", 0);
  divide_blocks(plan, std::move(blocks), params.lots, *maps.density, job);
  plan.charges.emplace_back(job, plan.lots.size() * bytes_a_lot);
  place_houses(plan, params, obstacles, footprints, job);
  place_landmarks(plan);
  return plan;
}

namespace {

/// Plans of this many parts leave so much unused memory that returning it justifies the time.
constexpr std::size_t parts_of_large_plans = 20'000;

/// The model of a request, and the number of parts of its plan, which is freed.
Result<Model> planned_model(const CityParams& params, const GenerateContext& context, std::size_t& parts) {
  Job& job = context.job;
  Result<CityPlan> plan = plan_of(params, job);
  if (!plan) return plan.error();
  const std::string statistics = canonical_text(statistics_of(*plan, job));
  std::vector<Warning> remarks = plan_warnings(params, *plan, job);
  parts = plan->parts.size();
  if (parts >= parts_of_large_plans) {
    return_unused_heap();
    job.budget()->prefer_low_memory();
  }
  job.progress("mesh", 0);
  Result<Model> model = city_model(*plan, params, context);
  if (!model) return model;
  warn_of_unused_surfaces(params, *model);
  model->extras.push_back({"statistics", statistics});
  for (Warning& each : remarks) model->warnings.push_back(std::move(each));
  return model;
}

}  // namespace

Result<Model> generate(const CityParams& params, const GenerateContext& context) {
  if (auto refused = refusal(params, context)) return std::move(*refused);
  std::size_t parts = 0;
  Result<Model> model = planned_model(params, context, parts);
  if (parts >= parts_of_large_plans) return_unused_heap();
  return model;
}

Result<Json> derive(const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  const Result<CityPlan> plan = plan_of(params, job);
  if (!plan) return plan.error();
  Json answer;
  answer["statistics"] = statistics_of(*plan, job);
  answer["plan"] = plan_json(*plan, params, job);
  answer["warnings"] = warning_list(plan_warnings(params, *plan, job));
  return answer;
}

Result<Appraisal> appraise(const CityParams& params, const GenerateContext& context) {
  Job& job = context.job;
  if (auto refused = refusal(params, context)) return std::move(*refused);
  const Result<CityPlan> plan = plan_of(params, job);
  if (!plan) return plan.error();
  Appraisal appraisal;
  appraisal.warnings = plan_warnings(params, *plan, job);
  Estimate estimate;
  const Surface surface(*plan, params.streets.wards.wall_height, job);
  estimate.triangles = ground_triangles(*plan, surface, context.demand.textures > 0, job) +
                       bridge_mesh(*plan, job).elements() + tunnel_mesh(surface, job).elements();
  if (auto warning = tunnel_warning(surface)) appraisal.warnings.push_back(*std::move(warning));
  estimate.bytes = estimate.triangles * 48;
  if (auto error = estimate_contents(estimate, surface, params, context)) return std::move(*error);
  appraisal.estimate = estimate;
  return appraisal;
}

Result<Payload> encode(const CityParams& params, const WantedFormat&, const GenerateContext& context) {
  if (auto refused = refusal(params, context)) return std::move(*refused);
  const Result<CityPlan> plan = plan_of(params, context.job);
  if (!plan) return plan.error();
  context.job.progress("encode", 0);
  Payload payload;
  payload.add(canonical_text(plan_json(*plan, params, context.job), [&] { context.job.check(); }));
  return payload;
}

Json vocabulary() { return Json::object(); }

}  // namespace seedmesh::city
