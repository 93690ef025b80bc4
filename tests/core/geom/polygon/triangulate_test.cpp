#include "core/geom/polygon/triangulate.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/polygon/orientation.h"
#include "core/geom/polygon/plan.h"

namespace seedmesh {
namespace {

using glm::dvec2;

/// A turned frame, so that coordinates are rounded.
struct Frame {
  dvec2 x{1, 0}, shift{0};
  dvec2 of(const dvec2& p) const { return shift + x * p.x + dvec2(-x.y, x.x) * p.y; }
};

Frame random_frame(Rng& rng) {
  const math::SinCos turn = math::sincos_degrees(rng.uniform(0, 360));
  const double scale = rng.uniform(0.01, 30);
  return {{scale * turn.cos, scale * turn.sin}, {rng.uniform(-200, 200), rng.uniform(-200, 200)}};
}

/// A grid of cells with polygons in some of them as holes: many share coordinates and lie on common lines.
Plan random_plan(Rng rng, bool is_turned) {
  const std::uint32_t columns = 1 + rng.below(5), rows = 1 + rng.below(4);
  const Frame frame = is_turned ? random_frame(rng) : Frame{};
  Plan plan;
  PlanRing& outer = plan.rings.emplace_back();
  const auto add_side = [&](dvec2 from, dvec2 to, std::uint32_t steps) {
    const bool is_notched = rng.below(2) == 0;
    const dvec2 along = (to - from) / static_cast<double>(steps), out = dvec2(along.y, -along.x);
    for (std::uint32_t i = 0; i < steps; ++i) {
      const dvec2 at = from + along * static_cast<double>(i);
      outer.push_back(at);
      if (!is_notched || rng.below(3) == 0) continue;
      outer.push_back(at + 0.25 * along);
      outer.push_back(at + 0.5 * along + out * rng.uniform(0.1, 0.5));
    }
  };
  const dvec2 corner(columns, rows);
  add_side({0, 0}, {corner.x, 0}, columns);
  add_side({corner.x, 0}, corner, rows);
  add_side(corner, {0, corner.y}, columns);
  add_side({0, corner.y}, {0, 0}, rows);
  for (std::uint32_t cell = 0; cell < columns * rows; ++cell) {
    if (rng.below(4) == 0) continue;
    const dvec2 at(cell % columns, cell / columns);
    PlanRing hole;
    const std::uint32_t kind = rng.below(3);
    if (kind == 0) {
      hole = {{0.25, 0.25}, {0.25, 0.75}, {0.5, 0.75}, {0.75, 0.75}, {0.75, 0.25}};
    } else {
      const std::uint32_t corners = 3 + rng.below(5);
      for (std::uint32_t i = 0; i < corners; ++i) {
        const math::SinCos turn = math::sincos_degrees(-360.0 * i / corners);
        const double radius = kind == 1 ? 0.4 : rng.uniform(0.05, 0.45);
        hole.emplace_back(0.5 + radius * turn.cos, 0.5 + radius * turn.sin);
      }
    }
    for (dvec2& p : hole) p += at;
    plan.rings.push_back(std::move(hole));
  }
  for (PlanRing& ring : plan.rings) {
    for (dvec2& p : ring) p = frame.of(p);
    std::ranges::rotate(ring, ring.begin() + rng.below(static_cast<std::uint32_t>(ring.size())));
  }
  return plan;
}

/// Each edge of the plan in one triangle, each other edge in two triangles that turn opposite ways.
bool are_edges_matched(const Plan& plan, std::span<const std::uint32_t> triangles) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (++balance[{triangles[t + k], triangles[t + (k + 1) % 3]}] > 1) return false;
    }
  }
  std::uint32_t first = 0;
  for (const PlanRing& ring : plan.rings) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      if (--balance[{first + i, first + (i + 1) % count}] != 0) return false;
    }
    first += count;
  }
  return std::ranges::all_of(balance, [&](const auto& each) {
    const auto back = balance.find({each.first.second, each.first.first});
    return each.second == 0 || (back != balance.end() && back->second == each.second);
  });
}

double area_of(const Plan& plan, std::span<const std::uint32_t> triangles) {
  PlanRing points;
  for (const PlanRing& ring : plan.rings) points.insert(points.end(), ring.begin(), ring.end());
  double sum = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    sum += 0.5 *
           std::abs(doubled_area(points[triangles[t]], points[triangles[t + 1]], points[triangles[t + 2]]));
  }
  return sum;
}

void expect_sound(const Plan& plan, std::uint64_t seed) {
  const std::vector<std::uint32_t> triangles = triangulate(plan);
  // Euler: a polygon of n corners with h holes has n + 2 h - 2 triangles.
  EXPECT_EQ(triangles.size() / 3, edge_count(plan) + 2 * (plan.rings.size() - 1) - 2) << seed;
  EXPECT_TRUE(are_edges_matched(plan, triangles)) << seed;
  EXPECT_NEAR(area_of(plan, triangles), area(plan), 1e-9 * area(plan)) << seed;
}

TEST(Orientation, IsExactWhereRoundedArithmeticIsNot) {
  // Kettner, Mehlhorn, Pion, Schirra and Yap, "Classroom examples of robustness problems", 2008: points near
  // (0.5, 0.5) against the line through (12, 12) and (24, 24). On that line x equals y.
  const double step = std::ldexp(1.0, -53);
  int wrong = 0;
  for (int i = 0; i < 256; ++i) {
    for (int k = 0; k < 256; ++k) {
      const dvec2 p(0.5 + i * step, 0.5 + k * step);
      const int expected = p.y > p.x ? 1 : p.y < p.x ? -1 : 0;
      EXPECT_EQ(orientation({12, 12}, {24, 24}, p), expected);
      EXPECT_EQ(orientation({24, 24}, p, {12, 12}), expected);
      const double rounded = doubled_area(p, {12, 12}, {24, 24});
      wrong += (rounded > 0) - (rounded < 0) != expected ? 1 : 0;
    }
  }
  EXPECT_GT(wrong, 1000);
}

TEST(Triangulator, FillsAPlanWithTwoHolesFromAReport) {
  const Plan plan =
      read_plan({{{36.842, -111.542}, {-65.34, 112.511}, {-64.57, -231.103}, {21.216, -133.046}},
                 {{-40.093, -72.297}, {-37.799, -68.468}, {-33.555, -71.269}, {-35.908, -74.869}},
                 {{-34.708, -63.605}, {-12.309, -35.775}, {-25.343, -52.325}, {-30.634, -66.445}}});
  expect_sound(plan, 0);
}

TEST(Triangulator, KeepsPointsInTheMiddleOfStraightEdges) {
  for (const double angle : {0.0, 17.0, 33.3, 45.0, 71.9}) {
    const math::SinCos turn = math::sincos_degrees(angle);
    const Frame frame{{turn.cos, turn.sin}, {3.1, -7.7}};
    PlanRing ring;
    for (const auto& [from, along] : {std::pair{dvec2(0, 0), dvec2(1, 0)},
                                      {dvec2(1, 0), dvec2(0, 1)},
                                      {dvec2(1, 1), dvec2(-1, 0)},
                                      {dvec2(0, 1), dvec2(0, -1)}}) {
      for (int i = 0; i < 7; ++i) ring.push_back(frame.of(from + along * (i / 7.0)));
    }
    expect_sound(Plan{{ring}}, static_cast<std::uint64_t>(angle));
  }
}

TEST(Triangulator, ClosesAHundredThousandRandomPlansWithUpToTwentyHoles) {
  const Rng rng(17);
  std::size_t holes = 0;
  for (std::uint64_t seed = 0; seed < 100'000 && !testing::Test::HasFailure(); ++seed) {
    const Plan plan = random_plan(rng.at(seed), seed % 2 == 1);
    holes = std::max(holes, plan.rings.size() - 1);
    expect_sound(plan, seed);
  }
  EXPECT_EQ(holes, 20U);
}

}  // namespace
}  // namespace seedmesh
