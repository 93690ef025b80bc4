#include "core/geom/polygon/planar_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

Job job() { return Job(0, Job::Options{}); }

CmPoint random_point(Rng& rng, double extent) {
  return {math::to_int32(rng.uniform(0, extent)), math::to_int32(rng.uniform(0, extent))};
}

/// A graph of random segments, some of which share ends, lie on one line, or pass near to a node.
PlanarGraph random_graph(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  // Small extents make crossings within a centimetre of each other frequent.
  const double extent = seed % 3 == 0 ? 12 : seed % 3 == 1 ? 300 : 100'000;
  PlanarGraph graph(math::to_int32(extent / 4) + 1);
  std::vector<CmPoint> ends;
  const std::uint32_t count = 3 + rng.below(20);
  for (std::uint32_t i = 0; i < count; ++i) {
    const CmPoint a = !ends.empty() && rng.unit() < 0.4
                          ? ends[rng.below(static_cast<std::uint32_t>(ends.size()))]
                          : random_point(rng, extent);
    const CmPoint b = random_point(rng, extent);
    graph.add(a, b, i);
    ends.push_back(a);
    ends.push_back(b);
  }
  return graph;
}

std::vector<PlanarEdge> present(const PlanarGraph& graph) {
  std::vector<PlanarEdge> edges;
  for (const PlanarEdge& edge : graph.edges()) {
    if (!edge.is_removed()) edges.push_back(edge);
  }
  return edges;
}

/// Whether two edges have a common point that is no common end.
bool meet_without_node(const PlanarGraph& graph, const PlanarEdge& e, const PlanarEdge& f) {
  const CmPoint &a = graph.nodes()[e.from], &b = graph.nodes()[e.to];
  const CmPoint &c = graph.nodes()[f.from], &d = graph.nodes()[f.to];
  if (cross_properly(a, b, c, d)) return true;
  const auto lies_inside = [](const CmPoint& p, const CmPoint& u, const CmPoint& v) {
    return p != u && p != v && segments_meet(p, p, u, v);
  };
  return lies_inside(a, c, d) || lies_inside(b, c, d) || lies_inside(c, a, b) || lies_inside(d, a, b);
}

TEST(PlanarGraph, HasANodeWhereverTwoOfItsEdgesMeet) {
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    const PlanarGraph graph = random_graph(seed);
    const std::vector<PlanarEdge> edges = present(graph);
    std::set<std::pair<std::uint32_t, std::uint32_t>> ends;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      ASSERT_NE(edges[i].from, edges[i].to);
      ASSERT_TRUE(ends.insert(std::minmax(edges[i].from, edges[i].to)).second) << "duplicate, seed " << seed;
      for (std::size_t k = i + 1; k < edges.size(); ++k)
        ASSERT_FALSE(meet_without_node(graph, edges[i], edges[k])) << "seed " << seed;
    }
  }
}

TEST(PlanarGraph, KeepsEverySegmentWithinTwoCentimetresOfItsLine) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    Rng rng = Rng::of_seed(seed);
    PlanarGraph graph(200);
    std::vector<std::pair<CmPoint, CmPoint>> given;
    for (std::uint32_t i = 0; i < 12; ++i) {
      given.emplace_back(random_point(rng, 1000), random_point(rng, 1000));
      graph.add(given.back().first, given.back().second, i);
    }
    for (const PlanarEdge& edge : present(graph)) {
      const auto& [a, b] = given[edge.tag];
      for (const std::uint32_t node : {edge.from, edge.to}) {
        ASSERT_LE(distance_to_segment(in_cm(graph.nodes()[node]), in_cm(a), in_cm(b)), 2.0)
            << "seed " << seed;
      }
    }
  }
}

TEST(PlanarGraph, SplitsTheRoadThatATJunctionMeets) {
  PlanarGraph graph;
  graph.add({0, 0}, {10'000, 0}, 1);
  graph.add({5000, 0}, {5000, 4000}, 2);
  EXPECT_EQ(present(graph).size(), 3U);
  EXPECT_EQ(graph.nodes().size(), 4U);
}

TEST(PlanarGraph, TakesASegmentTwiceAsOne) {
  PlanarGraph graph;
  graph.add({0, 0}, {1000, 1000}, 1);
  graph.add({1000, 1000}, {0, 0}, 2);
  ASSERT_EQ(present(graph).size(), 1U);
  EXPECT_EQ(present(graph)[0].tag, 1U);
}

std::uint32_t components(const PlanarGraph& graph, const std::vector<PlanarEdge>& edges) {
  std::vector<std::uint32_t> root(graph.nodes().size());
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  std::set<std::uint32_t> used, found;
  for (const PlanarEdge& edge : edges) {
    root[find(edge.from)] = find(edge.to);
    used.insert(edge.from);
    used.insert(edge.to);
  }
  for (const std::uint32_t node : used) found.insert(find(node));
  return static_cast<std::uint32_t>(found.size());
}

TEST(PlanarFaces, SatisfyEulersFormula) {  // V - E + F = 1 + C, with the outside as a face
  const Job one = job();
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    const PlanarGraph graph = random_graph(seed);
    const std::vector<PlanarEdge> edges = present(graph);
    std::set<std::uint32_t> used;
    for (const PlanarEdge& edge : edges) {
      used.insert(edge.from);
      used.insert(edge.to);
    }
    const PlanarFaces faces = faces_of(graph.nodes(), edges, one);
    ASSERT_EQ(used.size() + faces.faces.size() + 1, edges.size() + 1 + components(graph, edges))
        << "seed " << seed;
    std::int64_t sum = 0;
    std::size_t walked = 0;
    for (const PlanarFaces::Loop& loop : faces.loops) {
      sum += loop.doubled_area;
      walked += loop.count;
    }
    ASSERT_EQ(sum, 0) << "the outer walks cancel the faces, seed " << seed;
    ASSERT_EQ(walked, 2 * edges.size());
  }
}

TEST(PlanarFaces, PutsAnIslandIntoTheSmallestFaceAroundIt) {
  PlanarGraph graph;
  const auto square = [&graph](std::int32_t low, std::int32_t high) {
    graph.add({low, low}, {high, low}, 0);
    graph.add({high, low}, {high, high}, 0);
    graph.add({high, high}, {low, high}, 0);
    graph.add({low, high}, {low, low}, 0);
  };
  square(0, 10'000);
  square(1000, 9000);
  square(4000, 5000);
  const PlanarFaces faces = faces_of(graph.nodes(), graph.edges(), job());
  ASSERT_EQ(faces.faces.size(), 3U);
  for (const PlanarFaces::Face& face : faces.faces) {
    const std::int64_t outer = faces.loops[face.outer].doubled_area;
    const std::size_t holes = outer == 2'000'000 ? 0 : 1;
    ASSERT_EQ(face.holes.size(), holes);
    if (holes == 1) {
      EXPECT_EQ(faces.loops[face.holes[0]].doubled_area, outer == 200'000'000 ? -128'000'000 : -2'000'000);
    }
  }
}

TEST(PlanarFaces, PassADeadEndOnBothSides) {
  PlanarGraph graph;
  graph.add({0, 0}, {1000, 0}, 0);
  graph.add({1000, 0}, {0, 1000}, 0);
  graph.add({0, 1000}, {0, 0}, 0);
  graph.add({0, 0}, {200, 200}, 0);
  const PlanarFaces faces = faces_of(graph.nodes(), graph.edges(), job());
  ASSERT_EQ(faces.faces.size(), 1U);
  EXPECT_EQ(faces.loops[faces.faces[0].outer].count, 5U);
  EXPECT_EQ(faces.loops[faces.faces[0].outer].doubled_area, 1'000'000);
}

TEST(CmPoint, FindsEveryRingThatMeetsItself) {
  std::uint32_t simple = 0;
  for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
    Rng rng = Rng::of_seed(seed);
    CmRing ring;
    const std::uint32_t count = 3 + rng.below(5);
    for (std::uint32_t i = 0; i < count; ++i) ring.push_back(random_point(rng, 40));
    bool meets = false;  // by all pairs and by all corners, without any order
    for (std::size_t i = 0; i < count; ++i) {
      const CmPoint &a = ring[i], &b = ring[(i + 1) % count];
      meets |= a == b;
      for (std::size_t k = 0; k < count; ++k) {
        const CmPoint &c = ring[k], &d = ring[(k + 1) % count];
        meets |= k != i && cross_properly(a, b, c, d);
        meets |= c != a && c != b && segments_meet(c, c, a, b);
        meets |= k != i && c == a;
      }
    }
    simple += meets ? 0U : 1U;
    ASSERT_EQ(is_simple(ring), !meets) << "seed " << seed;
  }
  EXPECT_GT(simple, 1000U);
}

}  // namespace
}  // namespace seedmesh
