#include "core/generators/city/division.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "core/base/math.h"
#include "core/generators/city/shape.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// A block in the shape of a star around the origin, with streets at all sides.
BlockOutline star_block(Rng draw) {
  BlockOutline block;
  const std::uint32_t corners = 3 + draw.below(9);
  const double radius = 2'000 + 8'000 * draw.unit(), spread = 0.5 * draw.unit();
  for (std::uint32_t i = 0; i < corners; ++i) {
    const math::SinCos turn = math::sincos_degrees(360.0 * (i + 0.6 * draw.unit()) / corners);
    const double reach = radius * (1 - spread * draw.unit());
    block.ring.push_back(
        {math::to_int32(std::floor(reach * turn.cos)), math::to_int32(std::floor(reach * turn.sin))});
    block.edges.push_back({i, i});
  }
  return block;
}

/// How often each directed edge occurs, with edges of the opposite direction counted as -1.
using Balance = std::map<std::pair<CmPoint, CmPoint>, int>;

void count_edges(const CmRing& ring, int by, Balance& balance) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (a < b) {
      balance[{a, b}] += by;
    } else {
      balance[{b, a}] -= by;
    }
  }
}

/// The pieces have no corner below 12 degrees, the area of the block with the corners that cuts add to its sides, and each edge inside of it is that of one piece on each side. Returns how many
/// pieces there are.
std::size_t expect_a_partition(std::uint64_t seed, CityDivision method) {
  CityLots lots;
  lots.division = method;
  const BlockOutline block = star_block(Rng(seed));
  Division division(block, lots, seed, Rng(seed).at("lots"));
  if (!division.holds_lots()) return 0;
  Job job(1, Job::Options{});
  division.cut(job);
  Balance balance;
  const CmRing whole = division.outline(division.whole());
  count_edges(whole, 1, balance);
  std::int64_t area = 0;
  for (const Piece& piece : division.pieces()) {
    const CmRing ring = division.outline(piece);
    count_edges(ring, -1, balance);
    EXPECT_GT(doubled_area(ring), 0);
    EXPECT_LT(sharpest_cosine(without_bends(ring, 2)), std::cos(math::radians(11.9))) << "seed " << seed;
    area += doubled_area(ring);
  }
  EXPECT_EQ(area, doubled_area(whole)) << "seed " << seed;
  for (const auto& [edge, count] : balance)
    EXPECT_EQ(count, 0) << "seed " << seed << ": edge from " << edge.first.x << " " << edge.first.y;
  return division.pieces().size();
}

TEST(Division, CutsRandomBlocksIntoAnExactPartition) {
  for (const CityDivision method : {CityDivision::recursive, CityDivision::offset, CityDivision::skeleton,
                                    CityDivision::burgage, CityDivision::none}) {
    std::size_t divided = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed)
      divided += expect_a_partition(seed, method) > 1 ? 1 : 0;
    EXPECT_EQ(divided > 6'000, method != CityDivision::none) << divided << " of 20,000 blocks are divided";
  }
}

}  // namespace
}  // namespace seedmesh::city
