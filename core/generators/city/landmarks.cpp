#include "core/generators/city/landmarks.h"

#include <algorithm>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include "core/base/math.h"
#include "core/generators/city/rings.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// The box around a ring, in centimetres.
struct Box {
  glm::dvec2 low, high;
  bool contains(const glm::dvec2& p) const {
    return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
  }
};
Box box_of(const CmRing& ring) {
  Box box{in_cm(ring[0]), in_cm(ring[0])};
  for (const CmPoint& p : ring) {
    box.low = glm::min(box.low, in_cm(p));
    box.high = glm::max(box.high, in_cm(p));
  }
  return box;
}

/// The corners of a building's ground plan in its own frame, x and z; empty for other generators.
std::vector<glm::dvec2> plan_of_building(const Child& request) {
  if (request.generator != "building") return {};
  const Json parameters = Json::parse(request.parameters);
  std::vector<glm::dvec2> corners;
  if (parameters.contains("footprint")) {
    for (const Json& each : parameters["footprint"][0]) corners.emplace_back(each[0], each[1]);
    return corners;
  }
  glm::dvec2 half(6, 5);  // the default size
  if (parameters.contains("size"))
    half = {parameters["size"][0].get<double>() / 2, parameters["size"][2].get<double>() / 2};
  for (const glm::dvec2& sign : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.push_back(sign * half);
  return corners;
}

/// A position of the landmark's own frame, x and z, in the city.
glm::dvec2 placed(const Landmark& landmark, const glm::dvec2& p) {
  const math::SinCos turn = math::sincos_degrees(landmark.turn);
  return landmark.position + glm::dvec2(p.x * turn.cos + p.y * turn.sin, p.x * turn.sin - p.y * turn.cos);
}

/// Whether a landmark's ground plan lies on a lot: its corners, and no edge that crosses the outline of the lot.
bool fits(const Landmark& landmark, const std::vector<CmRing>& lot) {
  CmRing plan;
  for (const glm::dvec2& p : plan_of_building(landmark.request)) {
    const glm::dvec2 at = placed(landmark, p);
    if (!is_in(lot, at * 100.0)) return false;
    plan.push_back(rounded_cm(at * 100.0));
  }
  for (const CmRing& ring : lot) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      for (std::size_t k = 0; k < plan.size(); ++k) {
        if (cross_properly(ring[i], ring[(i + 1) % ring.size()], plan[k], plan[(k + 1) % plan.size()]))
          return false;
      }
    }
  }
  return true;
}

}  // namespace

std::vector<Landmark> landmarks_of(const CityParams& params, const Job& job) {
  std::vector<Landmark> landmarks;
  const Rng rng = job.rng().at("landmarks");
  for (std::size_t i = 0; i < params.buildings.landmarks.size(); ++i) {
    const CityLandmark& given = params.buildings.landmarks[i];
    Landmark each;
    each.request = given.model;
    // Below 2^32, so that programs with floating-point numbers keep it.
    if (!each.request.seed) each.request.seed = rng.at(i).key() >> 32U;
    each.pointer = "/buildings/landmarks/" + std::to_string(i);
    each.position = {given.position[0], given.position[1]};
    each.turn = given.turn;
    each.radius = given.radius;
    each.is_block_whole = given.plot == CityPlot::block;
    each.is_on_square = given.plot == CityPlot::square;
    each.replaces_house = given.plot != CityPlot::free;
    landmarks.push_back(std::move(each));
  }
  return landmarks;
}

void place_landmarks(CityPlan& plan) {
  if (plan.landmarks.empty()) return;
  std::vector<std::uint32_t> lot_of_part(plan.parts.size(), no_index);
  for (std::uint32_t n = 0; n < plan.lots.size(); ++n) lot_of_part[plan.lots[n].part] = n;
  std::vector<Box> boxes;
  for (const Part& part : plan.parts) boxes.push_back(box_of(part.rings[0]));
  for (std::uint32_t i = 0; i < plan.landmarks.size(); ++i) {
    Landmark& landmark = plan.landmarks[i];
    for (std::uint32_t n = 0; n < plan.parts.size() && landmark.part == no_index; ++n) {
      if (boxes[n].contains(landmark.position * 100.0) &&
          is_in(plan.parts[n].rings, landmark.position * 100.0))
        landmark.part = n;
    }
    landmark.lot = landmark.part != no_index ? lot_of_part[landmark.part] : no_index;
    if (landmark.is_on_square && landmark.part != no_index && landmark.lot == no_index)
      landmark.is_too_large = !fits(landmark, plan.parts[landmark.part].rings);
    if (landmark.lot == no_index || !landmark.replaces_house) continue;
    Lot* lot = &plan.lots[landmark.lot];
    lot->house.reset();
    landmark.is_too_large = !fits(landmark, plan.parts[landmark.part].rings);
    if (!landmark.is_too_large && lot->landmark == no_index) lot->landmark = i;
  }
}

std::optional<Footing> footing_of(const Landmark& landmark) {
  const std::vector<glm::dvec2> corners = plan_of_building(landmark.request);
  if (corners.empty() || landmark.part == no_index) return std::nullopt;
  glm::dvec2 low = corners[0], high = low;
  for (const glm::dvec2& p : corners) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return Footing{placed(landmark, (low + high) / 2.0), landmark.turn, high.x - low.x, high.y - low.y,
                 landmark.part};
}

std::vector<Warning> landmark_warnings(const CityPlan& plan) {
  std::vector<Warning> warnings;
  for (const Landmark& landmark : plan.landmarks) {
    if (landmark.is_given) continue;  // they stay as they are
    if (landmark.is_too_large) {
      warnings.push_back({landmark.pointer + "/model",
                          std::string("the building is larger than the ") +
                              (landmark.lot != no_index ? "lot" : name_of(plan.parts[landmark.part].kind)) +
                              " on which it stands",
                          0, 0});
    }
    if (landmark.lot != no_index) continue;
    std::string place = "outside of the area";
    if (landmark.part != no_index) {
      const PartKind kind = plan.parts[landmark.part].kind;
      if (kind == PartKind::park || kind == PartKind::square) continue;
      place = kind == PartKind::water ? "on water" : std::string("on a ") + name_of(kind);
    }
    warnings.push_back({landmark.pointer + "/position",
                        "the position is " + place + "; expected one on a lot, in a park or on a square", 0,
                        0});
  }
  return warnings;
}

}  // namespace seedmesh::city
