// Cells on a spiral of Fermat (Vogel, "A better way to construct the sunflower head", 1979), relaxed once (Lloyd 1982),
// become wards; see wards.h.
#include "core/generators/city/wards.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/generators/city/landform.h"
#include "core/generators/city/ward_streets.h"
#include "core/geom/polygon/plan.h"
#include "core/geom/polygon/voronoi.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double golden_angle = 137.50776405;  // degrees
constexpr double shift = 0.3;                  // of the points, as a share of the size
constexpr double merged = 1200;                // corners of cells this near become one, cm
constexpr double least_space = 2500;           // between wards and the border or a shore, cm
constexpr double least_density = 0.1;
constexpr std::size_t least_wards = 4;

/// Points of a spiral with about the same area each, moved by their draws.
std::vector<dvec2> points_of(const CityStreets& streets, Rng rng) {
  const dvec2 centre(streets.centre[0] * 100, streets.centre[1] * 100);
  const double size = streets.wards.size * 100;
  const int count = streets.wards.count * 3 + 30;
  std::vector<dvec2> points;
  for (int i = 0; i < count; ++i) {
    Rng draw = rng.at(static_cast<std::uint64_t>(i));
    const math::SinCos turn = math::sincos_degrees(golden_angle * i);
    const double radius = size * std::sqrt(i / math::pi);
    const double east = draw.uniform(-shift, shift), north = draw.uniform(-shift, shift);
    points.push_back(centre + dvec2(turn.cos, turn.sin) * radius + dvec2(east, north) * size);
  }
  return points;
}

/// Relaxed cells with common corners.
WardCells cells_of(const CityStreets& streets, Rng rng, const Job& job) {
  std::vector<dvec2> points = points_of(streets, rng);
  const dvec2 centre(streets.centre[0] * 100, streets.centre[1] * 100);
  const double reach = streets.wards.size * 100 * std::sqrt(static_cast<double>(points.size()));
  const dvec2 low = centre - dvec2(reach), high = centre + dvec2(reach);
  auto rings = voronoi_cells(points, low, high, job);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (!rings[i].empty()) points[i] = centroid_of(rings[i]);
  }
  rings = voronoi_cells(points, low, high, job);
  WardCells cells;
  cells.middle = points;
  for (const auto& ring : rings) {
    std::vector<std::uint32_t> corners;
    for (const dvec2& p : ring) {
      const std::uint32_t corner = cells.corner_near(p, merged);
      if (corners.empty() || corners.back() != corner) corners.push_back(corner);
    }
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    cells.rings.push_back(std::move(corners));
  }
  return cells;
}

/// Whether a cell is a sound polygon on dry land with people, and no edge of it is too steep.
bool is_fit(const WardCells& cells, std::uint32_t cell, const WardGround& ground, double grade_limit) {
  const CmRing ring = cells.ring_of(cell);
  if (ring.size() < 4 || !is_simple(ring) || doubled_area(ring) <= 0) return false;
  const dvec2 middle = cells.middle[cell];
  if (!is_on_land(ground.region, middle) || ground.density.at(middle / 100.0) < least_density) return false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const FieldMap* obstacles = ground.obstacles;
    if (obstacles && (obstacles->at(in_metres(a)) >= 0.5 || obstacles->at(middle / 100.0) >= 0.5))
      return false;
    if (ground.landform && is_too_steep(*ground.landform, in_cm(a), in_cm(b), grade_limit)) return false;
    for (const OutlineEdge& edge : ground.region.outline) {
      if (segments_meet(a, b, edge.a, edge.b) ||
          distance_to_segment(in_cm(a), in_cm(edge.a), in_cm(edge.b)) < least_space ||
          distance_to_segment(in_cm(edge.a), in_cm(a), in_cm(b)) < least_space)
        return false;
    }
  }
  return true;
}

/// The cells of the town, the nearest to the centre first.
std::vector<std::uint32_t> chosen_cells(const WardCells& cells, const CityParams& params,
                                        const WardGround& ground, const Job& job) {
  const dvec2 centre(params.streets.centre[0] * 100, params.streets.centre[1] * 100);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < cells.rings.size(); ++i) {
    if (is_fit(cells, i, ground, params.streets.classes.minor.grade))
      order.emplace_back(glm::length(cells.middle[i] - centre), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> chosen;
  const auto most = static_cast<std::size_t>(params.streets.wards.count);
  for (bool goes_on = true; goes_on && chosen.size() < most;) {
    goes_on = false;
    for (const auto& [distance, cell] : order) {
      job.check();
      if (chosen.size() == most || std::find(chosen.begin(), chosen.end(), cell) != chosen.end()) continue;
      chosen.push_back(cell);
      if (outline_of(cells, chosen).empty()) {
        chosen.pop_back();
      } else {
        goes_on = true;
      }
    }
  }
  return chosen;
}

/// Moves the corners of the outline towards the middle of their neighbours, where all wards stay sound.
void smooth(WardCells& cells, const std::vector<std::uint32_t>& chosen,
            const std::vector<std::uint32_t>& outline) {
  const std::vector<CmPoint> before = cells.corner;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const dvec2 a = in_cm(before[outline[(i + outline.size() - 1) % outline.size()]]),
                b = in_cm(before[outline[(i + 1) % outline.size()]]);
    CmPoint& p = cells.corner[outline[i]];
    p = rounded_cm(in_cm(p) * 0.5 + (a + b) * 0.25);
    const bool is_sound = std::all_of(chosen.begin(), chosen.end(), [&](std::uint32_t cell) {
      const CmRing ring = cells.ring_of(cell);
      return is_simple(ring) && doubled_area(ring) > 0;
    });
    if (!is_sound) p = before[outline[i]];
  }
}

/// 1 for a circle.
double compactness(const CmRing& ring) {
  double around = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) around += distance(ring[i], ring[(i + 1) % ring.size()]);
  return 2 * math::pi * static_cast<double>(doubled_area(ring)) / (around * around);
}

bool have_common_edge(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (a[i] == b[(k + 1) % b.size()] && a[(i + 1) % a.size()] == b[k]) return true;
    }
  }
  return false;
}

/// The wards with their zones: the first one is the square.
std::vector<Ward> wards_of(const WardCells& cells, const std::vector<std::uint32_t>& chosen,
                           const std::vector<std::uint32_t>& outline, const CityStreets& streets, Rng rng) {
  const auto is_at_wall = [&](std::uint32_t cell) {
    const auto& ring = cells.rings[cell];
    return std::any_of(ring.begin(), ring.end(), [&](std::uint32_t corner) {
      return std::find(outline.begin(), outline.end(), corner) != outline.end();
    });
  };
  std::size_t citadel = chosen.size();
  double best = 0.6;
  for (std::size_t i = 1; i < chosen.size() && streets.wards.citadel; ++i) {
    const double here = compactness(cells.ring_of(chosen[i]));
    if (!is_at_wall(chosen[i]) || here <= best) continue;
    best = here;
    citadel = i;
  }
  std::vector<Ward> wards;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto& ring = cells.rings[chosen[i]];
    Ward ward;
    ward.ring = cells.ring_of(chosen[i]);
    if (i == 0) {
      ward.zone = zone_square;
    } else if (i == citadel) {
      ward.zone = zone_citadel;
    } else if (have_common_edge(ring, cells.rings[chosen[0]])) {
      ward.zone = "merchants";
    } else if (citadel < chosen.size() && have_common_edge(ring, cells.rings[chosen[citadel]])) {
      ward.zone = "patricians";
    } else {
      Rng draw = rng.at(static_cast<std::uint64_t>(chosen[i]));
      ward.zone = is_at_wall(chosen[i]) && draw.unit() < 0.5 ? "poor" : "craftsmen";
    }
    wards.push_back(std::move(ward));
  }
  return wards;
}

}  // namespace

WardPlan lay_out_wards(const CityParams& params, const WardGround& ground,
                       std::vector<CrossSection>& sections, Job& job, std::vector<Issue>& issues) {
  const Rng rng = job.rng().at("wards");
  WardCells cells = cells_of(params.streets, rng.at("points"), job);
  const std::vector<std::uint32_t> chosen = chosen_cells(cells, params, ground, job);
  if (chosen.size() < least_wards) {
    issues.emplace_back(conflict_with({"area"}), "/streets/wards",
                        "found space for " + std::to_string(chosen.size()) + " wards, expected at least " +
                            std::to_string(least_wards) + ": a larger area or a smaller wards.size");
    return {};
  }
  const std::vector<std::uint32_t> outline = outline_of(cells, chosen);
  smooth(cells, chosen, outline);
  WardPlan plan;
  plan.wards = wards_of(cells, chosen, outline, params.streets, rng.at("zones"));
  std::uint32_t wall = static_cast<std::uint32_t>(EdgeClass::minor);
  if (params.streets.wards.wall_height > 0) {
    CrossSection section = sections[static_cast<std::size_t>(EdgeClass::minor)];
    section.sidewalk[1] = wall_width;
    section.has_wall = true;
    wall = static_cast<std::uint32_t>(sections.size());
    sections.push_back(section);
  }
  add_ward_streets(plan, cells, chosen, outline, {params.streets, ground, wall, rng.at("gates")});
  return plan;
}

const Ward* ward_at(const std::vector<Ward>& wards, const dvec2& cm) {
  for (const Ward& ward : wards) {
    if (is_inside(ward.ring, cm)) return &ward;
  }
  return nullptr;
}

}  // namespace seedmesh::city
