/// Blueprints over random footprints: sound meshes, and a door on the ground floor.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/generators/child.h"
#include "core/geom/mesh/finish.h"
#include "core/registry/registry.h"
#include "tests/core/building/blueprints/blueprint_shapes.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::building {
namespace {

using testing::IsEmpty;

struct Kind {
  const char* blueprint;
  double least, most;              ///< of the width and the depth, metres
  std::vector<std::string> doors;  ///< symbols that are replaced by a door
  Json low = Json::object();       ///< attributes of a low building
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {{"church", 10, 45, {"Portal"}},
                                        {"factory", 14, 70, {"Gate"}},
                                        {"house", 6, 20, {"Door"}},
                                        {"office_tower", 12, 60, {"EntranceDoor"}, {{"floors", 3}}},
                                        {"parisian_block", 9, 60, {"Portal"}, {{"floors", 2}}},
                                        {"skyscraper", 14, 60, {"EntranceDoor"}, {{"height", 30}}},
                                        {"temple", 10, 40, {"Door"}},
                                        {"terraced_house", 6, 50, {"Door", "BackDoor"}},
                                        {"villa", 8, 30, {"Door"}},
                                        {"warehouse", 10, 70, {"OfficeDoor", "Gate"}}};
  return all;
}

Json ring_of_radii(Rng& draw, int count, double width, double least, double most) {
  Json ring = Json::array();
  for (int i = 0; i < count; ++i) {
    const math::SinCos turn = math::sincos_degrees(360.0 * i / count);
    const double radius = width / 2 * draw.uniform(least, most);
    ring.push_back({radius * turn.cos, radius * turn.sin});
  }
  return ring;
}

/// A rectangle, a triangle, an L, a U, a T, a plus, a star, an irregular polygon, a court, a round plan.
Json footprint(const Kind& kind, std::uint64_t number) {
  Rng draw = Rng::of_seed(number).at(kind.blueprint);
  const double w = draw.uniform(kind.least, kind.most), d = draw.uniform(kind.least, kind.most);
  const double a = w * draw.uniform(0.2, 0.45), b = w - w * draw.uniform(0.2, 0.45),
               c = d * draw.uniform(0.25, 0.6);
  const double e = d * draw.uniform(0.2, 0.45), f = d - d * draw.uniform(0.2, 0.45);
  switch (number % 10) {
    case 0:
      return {{{0, 0}, {w, 0}, {w, d}, {0, d}}};
    case 1:
      return {{{0, 0}, {w, d * draw.uniform(-0.2, 0.2)}, {w * draw.unit(), d}}};
    case 2:
      return {{{0, 0}, {w, 0}, {w, c}, {a, c}, {a, d}, {0, d}}};
    case 3:
      return {{{0, 0}, {w, 0}, {w, d}, {b, d}, {b, c}, {a, c}, {a, d}, {0, d}}};
    case 4:
      return {{{0, 0}, {w, 0}, {w, c}, {b, c}, {b, d}, {a, d}, {a, c}, {0, c}}};
    case 5:
      return {
          {{a, 0}, {b, 0}, {b, e}, {w, e}, {w, f}, {b, f}, {b, d}, {a, d}, {a, f}, {0, f}, {0, e}, {a, e}}};
    case 6: {
      Json star = ring_of_radii(draw, 12, w, 1, 1.001);
      for (std::size_t i = 1; i < star.size(); i += 2)
        star[i] = {star[i][0].get<double>() * 0.55, star[i][1].get<double>() * 0.55};
      return Json::array({star});
    }
    case 7:
      return Json::array({ring_of_radii(draw, 7, 1.25 * w, 0.5, 1)});
    case 8:
      return {{{0, 0}, {w, 0}, {w, d}, {0, d}}, {{a, e}, {a, f}, {b, f}, {b, e}}};
    default:
      return Json::array({ring_of_radii(draw, 15, w, 0.999, 1)});
  }
}

void expect_sound(const Json& json, std::uint64_t seed, const std::string& place) {
  IssueList issues;
  const Generator* generator = find_generator("building");
  const Generator::Params params =
      read_parameters(*generator, json, "", {Job(0, Job::Options{}), generators()}, issues);
  ASSERT_TRUE(issues.empty()) << place;
  Job job(seed, Job::Options{});
  Result<Model> model = generator->generate(params, context_of(job));
  ASSERT_TRUE(model) << place << ": " << model.error().issues[0].message;
  finish(*model, job);
  EXPECT_THAT(faults(*model), IsEmpty()) << place;
}

TEST(BlueprintsOverAnyFootprint, HaveSoundMeshes) {
  for (const Kind& kind : kinds()) {
    for (std::uint64_t number = 0; number < 20; ++number) {
      const std::string place = std::string(kind.blueprint) + " " + std::to_string(number);
      Json json = {{"blueprint", kind.blueprint}, {"footprint", footprint(kind, number)}};
      for (const int lod : {1, 2}) {
        json["attributes"]["lod"] = lod;
        expect_sound(json, number, place + ", level " + std::to_string(lod));
      }
    }
  }
}

// Doors are on top of a plinth, a loading dock or the base of a villa.
TEST(BlueprintsOverAnyFootprint, HaveADoorOnTheGroundFloor) {
  constexpr double highest = 1.6;
  for (const Kind& kind : kinds()) {
    for (std::uint64_t number = 0; number < 20; ++number) {
      const Json shapes = shapes_of(
          {{"blueprint", kind.blueprint}, {"footprint", footprint(kind, number)}, {"attributes", kind.low}},
          number);
      const auto is_door = [&](const Json& shape) {
        return std::find(kind.doors.begin(), kind.doors.end(), shape["symbol"]) != kind.doors.end() &&
               !shape["active"].get<bool>() && shape["scope"]["origin"][1].get<double>() < highest &&
               shape["scope"]["size"][1].get<double>() > 1.9;
      };
      EXPECT_TRUE(std::any_of(shapes.begin(), shapes.end(), is_door)) << kind.blueprint << " " << number;
    }
  }
}

}  // namespace
}  // namespace seedmesh::building
