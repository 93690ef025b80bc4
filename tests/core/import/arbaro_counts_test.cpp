/// Numbers of limbs and leaves of Arbaro's species, against a second count by Arbaro's rules (its StemImpl.java: segments,
/// error values of a level, clones) written in another language; the mean of six seeds of each.
#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

struct Counted {
  const char* parameters;  ///< name=value, with blanks between
  double stems, leaves;
};

std::string species(std::string_view parameters) {
  std::string out = "<arbaro><species name='x'>";
  for (std::size_t at = 0; at < parameters.size();) {
    const std::size_t end = std::min(parameters.find(' ', at), parameters.size());
    const std::string_view each = parameters.substr(at, end - at);
    const std::size_t sign = each.find('=');
    out += "<param name='" + std::string(each.substr(0, sign)) + "' value='" +
           std::string(each.substr(sign + 1)) + "'/>";
    at = end + 1;
  }
  return out + "</species></arbaro>";
}

constexpr Counted counted[] = {
    {"Shape=7 Levels=3 Scale=13 ScaleV=3 BaseSize=.4 Ratio=.015 RatioPower=1.2 Leaves=5 0CurveRes=3 "
     "0CurveV=20 1DownAngle=60 1DownAngleV=-50 1Branches=50 1Length=.3 1CurveRes=5 1Curve=-40 1CurveV=50 "
     "2Branches=30 2Length=.6 2CurveRes=3",
     1223.5, 4403.0},
    {"Shape=4 Levels=4 Scale=23 ScaleV=5 BaseSize=.2 Ratio=.015 RatioPower=1.3 Leaves=3 0CurveRes=10 "
     "1DownAngle=60 1DownAngleV=-40 1Branches=25 1Length=.3 1LengthV=.05 1CurveRes=10 2Branches=12 "
     "2Length=.6 2LengthV=.1 2CurveRes=10 3Branches=6 3Length=.4",
     1162.0, 2014.2},
    {"Shape=4 Levels=2 Scale=3 ScaleV=.5 BaseSize=.9 Ratio=.04 Leaves=-12 0CurveRes=5 1Branches=18 "
     "1Length=.3 1DownAngle=70 1CurveRes=4",
     19.0, 213.0},
    {"Shape=2 Levels=3 Scale=25 ScaleV=3 BaseSize=.2 Ratio=.02 RatioPower=1.5 Leaves=6 0SegSplits=.3 "
     "0SplitAngle=20 0CurveRes=8 1Branches=15 1Length=.5 1LengthV=.1 1SegSplits=.3 1SplitAngle=25 "
     "1CurveRes=6 2Branches=12 2Length=.4 2CurveRes=4",
     198.6, 588.0},
    {"Shape=0 Levels=3 Scale=18 BaseSize=.1 Ratio=.015 RatioPower=1.2 Leaves=9 LeafDistrib=3 0CurveRes=10 "
     "1Branches=40 1BranchDist=.2 1Length=.25 1CurveRes=6 2Branches=14 2Length=.3 2CurveRes=3",
     404.5, 3271.5},
    {"Shape=1 Levels=3 Scale=2 ScaleV=.3 BaseSize=.02 Ratio=.03 RatioPower=1.3 Leaves=4 LeafDistrib=6 "
     "0Branches=3 0BaseSplits=2 0SegSplits=.4 0SplitAngle=25 0CurveRes=5 1Branches=10 1Length=.4 1CurveRes=4 "
     "1SegSplits=.3 1SplitAngle=20 2Branches=6 2Length=.4 2CurveRes=2",
     212.3, 305.9},
    {"Shape=1 Levels=2 Scale=3 BaseSize=.2 Ratio=.03 Leaves=9 0CurveRes=4 1Branches=9 1Length=.5 1CurveRes=4",
     10.0, 65.0},
    {"Shape=7 Levels=4 Scale=12 BaseSize=.15 Ratio=.02 RatioPower=1.4 Leaves=4 0CurveRes=8 1Branches=30 "
     "1Length=.35 1CurveRes=6 2Branches=9 2Length=.5 2CurveRes=4 3Branches=5 3Length=.5 3CurveRes=2",
     876.3, 1901.2},
    {"Shape=3 Levels=3 Scale=15 ScaleV=5 BaseSize=.05 Ratio=.03 RatioPower=2 Leaves=8 LeafDistrib=3 "
     "PruneRatio=1 PrunePowerLow=.001 PrunePowerHigh=.5 PruneWidth=.4 PruneWidthPeak=.6 0BaseSplits=2 "
     "0Length=.8 0CurveRes=8 0SplitAngle=3 1Branches=20 1Length=.5 1LengthV=.1 1CurveRes=8 1Curve=40 "
     "1CurveBack=80 1DownAngle=20 2Branches=10 2Length=.8 2CurveRes=4",
     210.2, 1497.6},
    {"Shape=5 Levels=3 Scale=9 BaseSize=.3 Ratio=.02 Leaves=20 LeafDistrib=5 0CurveRes=6 1Branches=24 "
     "1Length=.4 1CurveRes=5 2Branches=8 2Length=.5 2CurveRes=1",
     128.2, 1091.3},
    {"Shape=6 Levels=3 Scale=7 BaseSize=.15 Ratio=.02 Leaves=7 LeafDistrib=1 0CurveRes=5 0BaseSplits=1 "
     "0SplitAngle=30 1Branches=16 1Length=.6 1CurveRes=6 2Branches=20 2Length=.25 2CurveRes=2",
     222.6, 1027.4},
    {"Shape=4 Levels=3 Scale=20 BaseSize=.1 Ratio=.02 Leaves=2 LeafDistrib=2 0CurveRes=12 1Branches=90 "
     "1Length=.15 1CurveRes=3 2Branches=5 2Length=.4 2CurveRes=2",
     406.0, 461.3},
    {"Shape=7 Levels=3 Scale=14 BaseSize=.35 Ratio=.02 Leaves=11 0CurveRes=5 0SegSplits=.2 0SplitAngle=15 "
     "1Branches=20 1Length=.35 1CurveRes=5 2Branches=15 2Length=.4 2CurveRes=3 2SegSplits=.2 2SplitAngle=20",
     366.9, 2533.9},
    {"Shape=2 Levels=2 Scale=6 BaseSize=.25 Ratio=.03 Leaves=40 LeafDistrib=7 0CurveRes=6 0BaseSplits=3 "
     "0SplitAngle=20 1Branches=25 1Length=.3 1CurveRes=5 1SegSplits=.5 1SplitAngle=15",
     106.0, 1637.7},
    {"Shape=3 Levels=3 Scale=30 ScaleV=4 BaseSize=.5 Ratio=.012 Leaves=15 0CurveRes=8 1Branches=22 "
     "1Length=.2 1LengthV=.05 1CurveRes=4 2Branches=18 2Length=.5 2CurveRes=3",
     419.0, 4419.8},
    {"Shape=1 Levels=4 Scale=10 BaseSize=.2 Ratio=.02 RatioPower=1.3 Leaves=5 LeafDistrib=0 0CurveRes=5 "
     "1Branches=12 1Length=.4 1CurveRes=4 2Branches=8 2Length=.5 2CurveRes=3 3Branches=6 3Length=.4",
     352.7, 822.2},
    {"Shape=0 Levels=2 Scale=5 BaseSize=.05 Ratio=.02 Leaves=-8 0Branches=4 0BranchDist=.4 0CurveRes=4 "
     "1Branches=12 1Length=.5 1CurveRes=3",
     52.0, 289.5},
    {"Shape=5 Levels=3 Scale=11 BaseSize=.1 Ratio=.02 Leaves=6 PruneRatio=.5 PruneWidth=.3 PruneWidthPeak=.5 "
     "0CurveRes=6 1Branches=30 1Length=.5 1CurveRes=5 2Branches=10 2Length=.4 2CurveRes=2",
     188.8, 712.3},
    {"Shape=7 Levels=3 Scale=16 BaseSize=.4 Ratio=.02 Leaves=12 0CurveRes=4 0BaseSplits=1 0SegSplits=.5 "
     "0SplitAngle=12 1Branches=18 1Length=.4 1CurveRes=4 1BranchDist=.5 2Branches=9 2Length=.4 2CurveRes=2 "
     "2BranchDist=.3",
     147.6, 1047.3},
    {"Shape=4 Levels=3 Scale=8 BaseSize=.2 Ratio=.025 Leaves=3 0CurveRes=5 1Branches=35 1Length=.45 "
     "1CurveRes=10 1SegSplits=.1 1SplitAngle=30 2Branches=25 2Length=.2 2CurveRes=3",
     788.6, 1540.0},
};

TEST(Arbaro, HasAsManyLimbsAndLeavesAsArbaro) {
  for (const Counted& each : counted) {
    const auto result = imported("arbaro", species(each.parameters));
    ASSERT_TRUE(result) << reports(result)[0];
    nlohmann::json request = nlohmann::json::parse(result->request.canonical());
    double stems = 0, leaves = 0;
    for (int seed = 1; seed <= 6; ++seed) {
      request["seed"] = 77 * seed;
      const Result<Request> read = read_request(request.dump(), Limits{});
      ASSERT_TRUE(read);
      const Result<std::string> answer = derive(*read, {});
      ASSERT_TRUE(answer);
      const nlohmann::json tree = nlohmann::json::parse(*answer);
      for (const nlohmann::json& level : tree.at("levels")) stems += level.at("count").get<double>() / 6;
      leaves += tree.at("leaves").get<double>() / 6;
    }
    EXPECT_NEAR(stems, each.stems, 0.1 * each.stems) << each.parameters;
    EXPECT_NEAR(leaves, each.leaves, 0.1 * each.leaves) << each.parameters;
  }
}

}  // namespace
}  // namespace seedmesh
