#include "core/geom/plant/polygons.h"

#include <gmock/gmock.h>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/polygon/triangulate.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class Drawing {
 public:
  explicit Drawing(const Job& job) : outlines(job) {}
  void add(const std::vector<glm::vec3>& points, std::int16_t color = 0) {
    outlines.outline.push_back({static_cast<std::uint32_t>(outlines.vertex.size()),
                                static_cast<std::uint32_t>(points.size()), color, 0});
    for (const glm::vec3& p : points) outlines.vertex.push_back(p);
  }
  Outlines outlines;
};

/// What the judge would say of the layers, each a mesh of its own with a double-sided material.
std::vector<std::string> defects_of(const std::vector<Bark>& barks) {
  std::vector<std::string> all;
  for (const Bark& bark : barks) {
    for (const std::string& fault : faults(bark.mesh)) all.push_back(fault);
  }
  return all;
}

double area_of(const std::vector<Bark>& barks) {
  double area = 0;
  for (const Bark& bark : barks) area += measure({&bark.mesh}).area;
  return area;
}

Job job_of() { return Job(1, Job::Options{}); }

TEST(Polygons, FillASquareWithUnitTextureCoordinates) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4);
  const auto barks = polygons(drawing.outlines, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_EQ(barks[0].color, 4);
  EXPECT_THAT(barks[0].mesh.normal, testing::Each(glm::vec3(0, 0, 1)));
  EXPECT_THAT(barks[0].mesh.uv[0],
              ElementsAre(glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)));
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_EQ(job.spent(Resource::triangles) > 0, true);
}

TEST(Polygons, FillConcaveOutlinesExactly) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});
  const auto barks = polygons(drawing.outlines, job);
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_NEAR(area_of(barks), 4 * 3 - 2 * 2, 1e-5);
}

TEST(Polygons, KeepPointsOnAStraightEdge) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  const auto barks = polygons(drawing.outlines, job);
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_THAT(barks[0].mesh.position, SizeIs(7));
  EXPECT_NEAR(area_of(barks), 4, 1e-6);
}

TEST(Polygons, PassOverOutlinesWithoutArea) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {1, 0, 0}});
  drawing.add({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  drawing.add({{3, 3, 3}, {3, 3, 3}, {3, 3, 3}, {3, 3, 3}});
  drawing.add({{0, 0, 0}, {5, 5, 0}, {0, 0, 0}, {-5, -5, 0}});
  EXPECT_THAT(polygons(drawing.outlines, job), IsEmpty());
  EXPECT_THAT(polygons(Outlines(job), job), IsEmpty());
}

TEST(Polygons, PassOverRepeatedPoints) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
  const auto barks = polygons(drawing.outlines, job);
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_THAT(barks[0].mesh.position, SizeIs(4));
}

TEST(Polygons, FillOutlinesThatTouchThemselves) {
  Job job = job_of();
  Drawing drawing(job);
  // a ring cut open: the way to the hole is walked twice, once in each direction
  drawing.add({{0, 0, 0},
               {4, 0, 0},
               {4, 4, 0},
               {0, 4, 0},
               {0, 0, 0},
               {1, 1, 0},
               {1, 3, 0},
               {3, 3, 0},
               {3, 1, 0},
               {1, 1, 0}});
  const auto barks = polygons(drawing.outlines, job);
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_NEAR(area_of(barks), 16 - 4, 1e-5);
}

TEST(Polygons, FillOutlinesThatCrossThemselvesWithoutDefects) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {3, 1, 0}, {0, 1, 0}, {3, 0, 0}, {1.5F, 4, 0}});
  drawing.add({{9, 0, 0}, {9, 1, 0}, {8, 1, 0}, {8, 0, 0}, {9, 0, 0}, {9, 1, 0}, {8, 1, 0}, {8, 0, 0}});
  for (const Bark& bark : polygons(drawing.outlines, job)) {
    const MeshMeasures m = measure({&bark.mesh});
    EXPECT_EQ(
        m.over_used_edges + m.inconsistent_edges + m.zero_area + m.unused + m.not_unit + m.duplicate_faces,
        0U);
  }
}

TEST(Polygons, MakeAnOutlineDrawnTwiceOnce) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  drawing.add({{1, 0, 0}, {1, 1, 0}, {0, 0, 0}});
  drawing.add({{1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(measure({&polygons(drawing.outlines, job)[0].mesh}).triangles, 1U);
}

TEST(Polygons, TurnNeighboursSoThatTheyAgreeOnTheOutside) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  drawing.add({{1, 0, 0}, {1, 1, 1}, {0, 1, 0}});
  drawing.add({{1, 0, 0}, {1, 1, 1}, {2, 0, 0}});
  const auto barks = polygons(drawing.outlines, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_EQ(measure({&barks[0].mesh}).open_edges, 5U);
}

TEST(Polygons, TurnWholeGroupsThatALaterPolygonJoins) {
  Job job = job_of();
  Drawing drawing(job);
  drawing.add({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  drawing.add({{3, 0, 0}, {2, 0, 0}, {2, 1, 0}, {3, 1, 0}});
  drawing.add({{3, 0, 0}, {3, 1, 0}, {4, 0, 0}});
  drawing.add({{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  const auto barks = polygons(drawing.outlines, job);
  ASSERT_THAT(barks, SizeIs(1));
  EXPECT_THAT(defects_of(barks), IsEmpty());
  EXPECT_NEAR(area_of(barks), 3.5, 1e-6);
}

TEST(Polygons, TakeAnotherLayerToCloseAMoebiusStrip) {
  Job job = job_of();
  Drawing drawing(job);
  const auto rung = [](int i) {
    const math::SinCos round = math::sincos(2 * math::pi * i / 12), twist = math::sincos(math::pi * i / 12);
    const glm::dvec3 middle{round.cos, 0, round.sin};
    const glm::dvec3 across = glm::dvec3{round.cos * twist.cos, twist.sin, round.sin * twist.cos} * 0.3;
    return std::pair{glm::vec3(middle - across), glm::vec3(middle + across)};
  };
  for (int i = 0; i < 12; ++i) {
    const auto [a, b] = rung(i);
    const auto [c, d] = rung(i + 1);
    drawing.add({a, b, d});
    drawing.add({a, d, c});
  }
  const auto barks = polygons(drawing.outlines, job);
  EXPECT_THAT(barks, SizeIs(2));
  EXPECT_THAT(defects_of(barks), IsEmpty());
}

TEST(Polygons, TakeAnotherLayerWhereAnEdgeIsUsedUp) {
  Job job = job_of();
  Drawing drawing(job);
  for (const glm::vec3 tip : {glm::vec3{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, {1, 0, 1}}) {
    drawing.add({{0, 0, 0}, {0, 1, 0}, tip});
  }
  const auto barks = polygons(drawing.outlines, job);
  ASSERT_THAT(barks, SizeIs(3));
  EXPECT_EQ(barks[2].layer, 2);
  EXPECT_THAT(defects_of(barks), IsEmpty());
}

TEST(Polygons, HaveNoDefectOnRandomDrawings) {
  Job job = job_of();
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Rng rng(seed);
    Drawing drawing(job);
    const std::uint32_t grid = 2 + rng.below(6);
    for (std::uint32_t i = 0; i < 1 + rng.below(30); ++i) {
      std::vector<glm::vec3> points;
      const std::uint32_t count = 3 + rng.below(9);
      for (std::uint32_t k = 0; k < count; ++k) {
        glm::vec3 point{0};
        point.x = static_cast<float>(rng.below(grid));
        point.y = static_cast<float>(rng.below(grid));
        if (rng.below(2)) point.z = static_cast<float>(rng.below(grid));
        points.push_back(point);
      }
      drawing.add(points, static_cast<std::int16_t>(rng.below(2)));
    }
    std::map<int, std::vector<const Mesh*>> layers;
    const auto barks = polygons(drawing.outlines, job);
    for (const Bark& bark : barks) layers[bark.layer].push_back(&bark.mesh);
    for (const auto& [layer, meshes] : layers) {
      const MeshMeasures m = measure(meshes);
      EXPECT_EQ(m.over_used_edges, 0U) << "seed " << seed << " layer " << layer;
      EXPECT_EQ(m.inconsistent_edges, 0U) << "seed " << seed << " layer " << layer;
      const std::string place = "seed " + std::to_string(seed) + " layer " + std::to_string(layer);
      EXPECT_EQ(m.zero_area, 0U) << place;
      EXPECT_EQ(m.unused, 0U) << place;
      EXPECT_EQ(m.not_unit, 0U) << place;
      EXPECT_EQ(m.duplicates, 0U) << place;
      EXPECT_EQ(m.duplicate_faces, 0U) << place;
      EXPECT_EQ(m.not_finite + m.negative_zeros, 0U) << place;
    }
  }
}

TEST(Triangulate, FillsTenThousandCorners) {
  Rng rng(9);
  std::vector<glm::dvec2> star;
  double twice_area = 0;
  constexpr int corners = 10'000;
  for (int i = 0; i < corners; ++i) {
    const math::SinCos at = math::sincos(2 * math::pi * i / corners);
    const double radius = rng.uniform(0.2, 1);
    star.emplace_back(radius * at.cos, radius * at.sin);
  }
  for (int i = 0; i < corners; ++i) {
    const glm::dvec2 a = star[static_cast<std::size_t>(i)],
                     b = star[static_cast<std::size_t>((i + 1) % corners)];
    twice_area += a.x * b.y - a.y * b.x;
  }
  Triangulator triangulator;
  const auto triangles = triangulator.run(star, 1e-15);
  double filled = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    const glm::dvec2 a = star[triangles[t]], b = star[triangles[t + 1]], c = star[triangles[t + 2]];
    filled += (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }
  EXPECT_EQ(triangles.size(), 3U * (corners - 2));
  EXPECT_NEAR(filled, twice_area, 1e-9);
}

}  // namespace
}  // namespace seedmesh
