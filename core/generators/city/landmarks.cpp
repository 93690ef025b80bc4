#include "core/generators/city/landmarks.h"

#include <algorithm>

#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

bool is_in(const std::vector<CmRing>& rings, const glm::dvec2& metres) {
  bool inside = false;
  for (const CmRing& ring : rings) inside ^= is_inside(ring, metres * 100.0);
  return inside;
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
    each.replaces_house = given.plot != CityPlot::free;
    landmarks.push_back(std::move(each));
  }
  return landmarks;
}

void place_landmarks(CityPlan& plan) {
  for (std::uint32_t i = 0; i < plan.landmarks.size(); ++i) {
    Landmark& landmark = plan.landmarks[i];
    for (std::uint32_t n = 0; n < plan.parts.size() && landmark.part == no_index; ++n) {
      if (is_in(plan.parts[n].rings, landmark.position)) landmark.part = n;
    }
    const auto lot = std::find_if(plan.lots.begin(), plan.lots.end(),
                                  [&](const Lot& each) { return each.part == landmark.part; });
    if (lot == plan.lots.end()) continue;
    landmark.lot = static_cast<std::uint32_t>(lot - plan.lots.begin());
    if (!landmark.replaces_house) continue;
    lot->house.reset();
    if (lot->landmark == no_index) lot->landmark = i;
  }
}

std::vector<Warning> landmark_warnings(const CityPlan& plan) {
  std::vector<Warning> warnings;
  for (const Landmark& landmark : plan.landmarks) {
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
