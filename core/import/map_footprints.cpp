// Footprints of buildings; see map_footprints.h.
#include "core/import/map_footprints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/import/map_rings.h"
#include "core/import/map_scene.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using Role = MapBody::Role;

// A building is hidden by its parts where these cover at least this share of it.
constexpr double mostly_covered = 0.9;
constexpr double cell = 128;           ///< of the search for parts
constexpr double largest_plain = 1e6;  ///< square metres of a building without a tag
// Buildings that are tried around a part.
constexpr std::size_t most_tried = 256;

/// Whether the object does not exist yet or any more, by its kind (building=proposed) or by a prefix of a name
/// (demolished:building), after the page "Lifecycle prefix" of the OpenStreetMap wiki.
bool is_absent(const MapTags& tags) {
  constexpr std::array<std::string_view, 7> states{"demolished", "razed",    "removed", "destroyed",
                                                   "dismantled", "proposed", "planned"};
  return std::any_of(states.begin(), states.end(), [&](std::string_view state) {
    return tags.is("building", state) || tags.is("building:part", state) ||
           tags.has(std::string(state) + ":building") || tags.has(std::string(state) + ":building:part");
  });
}

Role role_of(const MapFeature& feature, const MapData& data) {
  if (feature.polygons.empty() || is_absent(feature.tags)) return Role::none;
  const MapTags& tags = feature.tags;
  if (tags.has("building:part")) return Role::part;
  if (tags.has("building")) return Role::outline;
  if (tags.get("building") == "no" || !data.plain_polygons_are_buildings || has_ground_tag(tags))
    return Role::none;
  return Role::outline;
}

/// Whether a plan is too large for a building without a tag that states it: it is a district or a country.
bool is_district(const MapTags& tags, const Plan& plan) {
  const bool is_described = tags.has("building") || tags.has("building:part") || tags.has("height") ||
                            tags.has("building:levels") || tags.has("roof:shape");
  return !is_described && area(plan) > largest_plain;
}

/// The footprints of all buildings and parts.
std::vector<MapBody> bodies_of(MapConversion& map, const MapData& data, std::vector<bool>& is_building) {
  std::vector<MapBody> bodies;
  for (std::size_t i = 0; i < data.features.size(); ++i) {
    if (i % 256 == 0) map.job.check();
    const MapFeature& feature = data.features[i];
    const Role role = role_of(feature, data);
    if (role == Role::none) continue;
    is_building[i] = true;
    if (feature.tags.is("location", "underground") || feature.tags.has("is_underground")) {
      map.warnings.add("a building underground is left out", feature.position);
      continue;
    }
    for (const std::vector<MapRing>& polygon : feature.polygons) {
      const std::vector<PlanRing> rings = map.outline(polygon, "a footprint", feature.position);
      if (rings.empty()) continue;
      ValidPlans sound = valid_plans(rings, &map.job);
      if (sound.lost_holes > 0) {
        map.warnings.add("a courtyard crosses other edges of its footprint; it is left out",
                         feature.position);
      }
      if (sound.has_crossing) {
        map.warnings.add("a footprint crosses itself; it is left out in part or whole", feature.position);
      } else if (sound.is_divided && !sound.plans.empty()) {
        map.warnings.add("a footprint crosses itself; it is divided at the crossings", feature.position);
      } else if (sound.plans.empty()) {
        map.warnings.add("a footprint has no area; it is left out", feature.position);
      }
      for (Plan& plan : sound.plans) {
        if (is_district(feature.tags, plan)) {
          map.warnings.add(
              "a polygon of more than a square kilometre is left out, because no tag states that it is a "
              "building",
              feature.position);
          continue;
        }
        bodies.push_back({&feature, nullptr, std::move(plan), role, false});
      }
    }
  }
  return bodies;
}

/// A point inside a plan: the middle of its largest triangle.
dvec2 inner_point(const Plan& plan, const Job& job) {
  std::vector<dvec2> points;
  for (const PlanRing& ring : plan.rings) points.insert(points.end(), ring.begin(), ring.end());
  const std::vector<std::uint32_t> corners = triangulate(plan, ThinTriangles::keep, &job);
  double largest = -1;
  dvec2 best = plan.rings[0][0];
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const dvec2 a = points[corners[i]], b = points[corners[i + 1]], c = points[corners[i + 2]];
    const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (twice <= largest) continue;
    largest = twice;
    best = (a + b + c) / 3.0;
  }
  return best;
}

using Square = std::pair<std::int32_t, std::int32_t>;
Square square_of(const dvec2& p) {
  const auto number = [](double value) {
    return math::to_int32(std::floor(std::clamp(value / cell, -1e6, 1e6)));
  };
  return {number(p.x), number(p.y)};
}

/// Buildings by the squares that their boxes touch; great ones are in a list of their own.
class OutlineIndex {
 public:
  explicit OutlineIndex(const std::vector<MapBody>& bodies) : bodies_(bodies) {
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      if (bodies[i].role == Role::outline) add(i);
    }
  }

  /// The smallest building around a point; null without one.
  const MapBody* around(const dvec2& p) const {
    const MapBody* best = nullptr;
    std::size_t tried = 0;
    const auto look = [&](std::uint32_t i) {
      if (++tried > most_tried) return;
      const MapBody& body = bodies_[i];
      if (contains(body.plan, p) && (!best || area(body.plan) < area(best->plan))) best = &body;
    };
    if (const auto found = by_square_.find(square_of(p)); found != by_square_.end()) {
      for (const std::uint32_t i : found->second) look(i);
    }
    for (const std::uint32_t i : great_) look(i);
    return best;
  }

 private:
  void add(std::uint32_t number) {
    dvec2 low = bodies_[number].plan.rings[0][0], high = low;
    for (const dvec2& p : bodies_[number].plan.rings[0]) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const auto [x0, y0] = square_of(low);
    const auto [x1, y1] = square_of(high);
    constexpr std::int32_t most_squares = 8;
    if (x1 - x0 > most_squares || y1 - y0 > most_squares) {
      great_.push_back(number);
      return;
    }
    for (std::int32_t y = y0; y <= y1; ++y) {
      for (std::int32_t x = x0; x <= x1; ++x) by_square_[{x, y}].push_back(number);
    }
  }

  const std::vector<MapBody>& bodies_;
  std::map<Square, std::vector<std::uint32_t>> by_square_;
  std::vector<std::uint32_t> great_;
};

/// Parts replace the building around them.
void hide_outlines(MapConversion& map, std::vector<MapBody>& bodies) {
  const OutlineIndex index(bodies);
  std::vector<double> covered(bodies.size(), 0);
  for (MapBody& body : bodies) {
    if (body.role != Role::part) continue;
    const MapBody* around = index.around(inner_point(body.plan, map.job));
    if (!around) continue;
    const auto number = static_cast<std::size_t>(around - bodies.data());
    body.outline = around->feature;
    bodies[number].is_hidden = true;
    covered[number] += area(body.plan);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].is_hidden && covered[i] < mostly_covered * area(bodies[i].plan)) {
      map.warnings.add("a building is replaced by its parts, which cover less than 90 % of it",
                       bodies[i].feature->position);
    }
  }
}

}  // namespace

std::vector<MapBody> map_bodies(MapConversion& map, const MapData& data, std::vector<bool>& is_building) {
  std::vector<MapBody> bodies = bodies_of(map, data, is_building);
  hide_outlines(map, bodies);
  return bodies;
}

}  // namespace seedmesh
