#include "core/geom/polygon/massing.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <set>

#include "core/geom/polygon/massing_merge.h"
#include "tests/core/geom/plans.h"

namespace seedmesh {
namespace {

constexpr int roof_count = static_cast<int>(mass_roof_names.size());

Job job_of() { return Job(1, Job::Options{}); }

MassOptions options_of(MassRoof roof, double eaves = 3, double height = 2) {
  MassOptions options;
  options.roof = roof;
  options.eaves = eaves;
  options.roof_height = roof == MassRoof::flat ? 0 : height;
  return options;
}

/// By tetrahedra with the origin: positive for a closed surface that faces outwards.
double volume_of(const Mass& mass) {
  double six = 0;
  for (const auto& t : mass.triangles)
    six += glm::dot(mass.point[t[0]], glm::cross(mass.point[t[1]], mass.point[t[2]]));
  return six / 6;
}

double top_of(const Mass& mass) {
  double top = -1e9;
  for (const glm::dvec3& p : mass.point) top = std::max(top, p.z);
  return top;
}

/// The greatest sine between a triangle and the normal of its face, for triangles with an area.
double worst_normal(const Mass& mass) {
  double worst = 0;
  for (std::size_t f = 0; f < mass.faces.size(); ++f) {
    const std::size_t end = f + 1 < mass.faces.size() ? mass.faces[f + 1].first : mass.triangles.size();
    for (std::size_t i = mass.faces[f].first; i < end; ++i) {
      const auto& t = mass.triangles[i];
      const glm::dvec3 twice =
          glm::cross(mass.point[t[1]] - mass.point[t[0]], mass.point[t[2]] - mass.point[t[0]]);
      if (glm::length(twice) < 1e-4) continue;
      worst = std::max(worst, glm::length(twice / glm::length(twice) - mass.faces[f].normal));
    }
  }
  return worst;
}

TEST(Massing, HasTheVolumesOfRoofsOverARectangle) {
  const double w = 8, l = 14, h = 2, body = w * l * 3;
  const Plan plan = rectangle(l, w);
  const auto roof_volume = [&](MassRoof roof) {
    const Job job = job_of();
    return volume_of(mass_of(plan, options_of(roof, 3, h), job)) - body;
  };
  EXPECT_NEAR(roof_volume(MassRoof::flat), 0, 1e-9);
  EXPECT_NEAR(roof_volume(MassRoof::skillion), w * l * h / 2, 1e-9);
  EXPECT_NEAR(roof_volume(MassRoof::gabled), w * l * h / 2, 1e-9);
  EXPECT_NEAR(roof_volume(MassRoof::saltbox), w * l * h / 2, 1e-9);
  EXPECT_NEAR(roof_volume(MassRoof::gambrel), w * l * h * (2 * 0.2 * 0.3 + 2 * 0.3 * 0.8), 1e-9);
  EXPECT_NEAR(roof_volume(MassRoof::pyramidal), w * l * h / 3, 1e-9);
  // A hipped roof of one slope: a prism without two half pyramids at its ends.
  EXPECT_NEAR(roof_volume(MassRoof::hipped), (l - w) * w * h / 2 + w * w * h / 3, 1e-6);
  // Each end loses a tetrahedron: half of the width and of the height, and a quarter of the width deep.
  EXPECT_NEAR(roof_volume(MassRoof::half_hipped), w * l * h / 2 - 2 * (w / 2 * h / 2 / 2) * (w / 4) / 3,
              1e-9);
  // Twelve chords of half an ellipse: 12 / 2 * sin(pi / 12) of the two semi-axes.
  EXPECT_NEAR(roof_volume(MassRoof::round), l * (w / 2) * h * 6 * std::sin(math::pi / 12), 1e-9);
}

TEST(Massing, ReachesTheHeightThatItIsGiven) {
  for (int i = 0; i < roof_count; ++i) {
    const Job job = job_of();
    const Mass mass = mass_of(rectangle(12, 9), options_of(static_cast<MassRoof>(i), 4, 2.5), job);
    EXPECT_EQ(mass.made, static_cast<MassRoof>(i));
    EXPECT_NEAR(top_of(mass), i == 0 ? 4 : 6.5, 1e-9) << mass_roof_names[static_cast<std::size_t>(i)];
    EXPECT_LT(worst_normal(mass), 1e-6) << mass_roof_names[static_cast<std::size_t>(i)];
  }
}

TEST(Massing, SlopesDownInItsDirection) {
  const Job job = job_of();
  MassOptions options = options_of(MassRoof::skillion);
  options.direction = glm::dvec2(0, -1);  // to the south
  for (const glm::dvec3& p : mass_of(rectangle(12, 9), options, job).point) {
    if (p.z > 0) {
      EXPECT_NEAR(p.z, p.y > 4 ? 5 : 3, 1e-9);
    }
  }
}

TEST(Massing, TurnsTheRidgeAcross) {
  const Job job = job_of();
  MassOptions options = options_of(MassRoof::gabled);
  const auto ridge = [&] {
    std::vector<glm::dvec2> points;
    for (const glm::dvec3& p : mass_of(rectangle(12, 9), options, job).point) {
      if (p.z > 4.9) points.emplace_back(p);
    }
    return points;
  };
  for (const glm::dvec2& p : ridge()) EXPECT_NEAR(p.y, 4.5, 1e-9);
  options.across = true;
  for (const glm::dvec2& p : ridge()) EXPECT_NEAR(p.x, 6, 1e-9);
}

TEST(Massing, ReplacesADomeOverACourtyardByAHippedRoof) {
  const Job job = job_of();
  const Plan plan = plan_of({{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{{6, 6}, {6, 14}, {14, 14}, {14, 6}}});
  const Mass mass = mass_of(plan, options_of(MassRoof::dome), job);
  EXPECT_EQ(mass.made, MassRoof::hipped);
  EXPECT_TRUE(is_closed(mass));
}

/// Every roof over a plan is closed, faces outwards, and keeps its height.
void expect_sound(const Plan& plan, int seed) {
  const Job job = job_of();
  const double floor_area = area(plan);
  for (int i = 0; i < roof_count; ++i) {
    MassOptions options = options_of(static_cast<MassRoof>(i), 3.5, 2.5);
    options.base = 0.5;
    const Mass mass = mass_of(plan, options, job);
    const auto name = [&] {
      return std::to_string(seed) + " " + mass_roof_names[static_cast<std::size_t>(i)];
    };
    ASSERT_TRUE(is_closed(mass)) << name();
    ASSERT_LE(top_of(mass), 6 + 1e-6) << name();
    const double volume = volume_of(mass);
    ASSERT_GE(volume, 3 * floor_area * (1 - 1e-9)) << name();
    const double widest = options.roof == MassRoof::onion ? 1.6 : 1;
    ASSERT_LE(volume, (3 + 2.5 * widest) * floor_area * (1 + 1e-9)) << name();
  }
}

TEST(Massing, ClosesEveryRoofOverPlansByChance) {
  for (int seed = 0; seed < 1200; ++seed) {
    const Rng rng = Rng::of_seed(static_cast<std::uint64_t>(seed)).at("massing");
    expect_sound(random_star(rng.at("star"), 3 + static_cast<std::uint32_t>(seed) % 20, seed % 3 == 0), seed);
    expect_sound(random_blocks(rng.at("blocks"), 3 + seed % 6), seed);
  }
}

/// Whether two points are one in single precision. Four walls meet there, so that no body is closed.
bool touches_itself(const Plan& plan) {
  std::set<std::pair<float, float>> points;
  for (const PlanRing& ring : plan.rings) {
    for (const glm::dvec2& p : ring) {
      if (!points.emplace(static_cast<float>(p.x), static_cast<float>(p.y)).second) return true;
    }
  }
  return false;
}

TEST(Massing, StaysClosedAsItIsWritten) {
  // Spikes, holes, courtyards and sides that are nearly parallel; points are written in single precision.
  int count = 0;
  for (std::uint64_t number = 0; number < 1500; ++number) {
    const Plan plan = real_like_plan(Rng::of_seed(number).at("written"), number);
    if (touches_itself(plan)) continue;
    ++count;
    for (int i = 0; i < roof_count; ++i) {
      const Job job = job_of();
      Mass mass = mass_of(plan, options_of(static_cast<MassRoof>(i)), job);
      for (glm::dvec3& p : mass.point) p = glm::dvec3(glm::vec3(p));
      ASSERT_TRUE(merge_points(mass)) << number << " " << mass_roof_names[static_cast<std::size_t>(i)];
    }
  }
  EXPECT_GT(count, 1200);
}

TEST(SmallestBox, TurnsWithThePlan) {
  const math::SinCos turn = math::sincos(0.4);
  PlanRing ring;
  const Plan straight = rectangle(10, 4);
  for (const glm::dvec2& p : straight.rings[0])
    ring.emplace_back(p.x * turn.cos - p.y * turn.sin, p.x * turn.sin + p.y * turn.cos);
  const PlanBox box = smallest_box(plan_of(ring));
  EXPECT_NEAR(box.half.x, 5, 1e-12);
  EXPECT_NEAR(box.half.y, 2, 1e-12);
  EXPECT_NEAR(std::abs(box.along.x), turn.cos, 1e-12);
}

}  // namespace
}  // namespace seedmesh
