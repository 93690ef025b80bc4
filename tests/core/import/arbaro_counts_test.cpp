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
     376.3, 3017.3},
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
     348.1, 677.3},
    {"Shape=0 Levels=2 Scale=5 BaseSize=.05 Ratio=.02 Leaves=-8 0Branches=4 0BranchDist=.4 0CurveRes=4 "
     "1Branches=12 1Length=.5 1CurveRes=3",
     52.0, 289.5},
    {"Shape=5 Levels=3 Scale=11 BaseSize=.1 Ratio=.02 Leaves=6 PruneRatio=.5 PruneWidth=.3 PruneWidthPeak=.5 "
     "0CurveRes=6 1Branches=30 1Length=.5 1CurveRes=5 2Branches=10 2Length=.4 2CurveRes=2",
     188.8, 702.2},
    {"Shape=7 Levels=3 Scale=16 BaseSize=.4 Ratio=.02 Leaves=12 0CurveRes=4 0BaseSplits=1 0SegSplits=.5 "
     "0SplitAngle=12 1Branches=18 1Length=.4 1CurveRes=4 1BranchDist=.5 2Branches=9 2Length=.4 2CurveRes=2 "
     "2BranchDist=.3",
     147.6, 1047.3},
    {"Shape=4 Levels=3 Scale=8 BaseSize=.2 Ratio=.025 Leaves=3 0CurveRes=5 1Branches=35 1Length=.45 "
     "1CurveRes=10 1SegSplits=.1 1SplitAngle=30 2Branches=25 2Length=.2 2CurveRes=3",
     788.6, 1540.0},
};

/// Species as users of Arbaro have them: four of the paper, and others of all kinds. The numbers are those of the second
/// count with Arbaro's geometry (its random numbers, bends, attraction and envelope) and 24 seeds.
constexpr Counted species_of_users[] = {
    {"Shape=3 Levels=4 Scale=15 ScaleV=5 BaseSize=.05 Ratio=.03 RatioPower=2 Flare=.75 Leaves=10 "
     "LeafDistrib=3 AttractionUp=-2 PruneRatio=1 PrunePowerLow=.001 PrunePowerHigh=.5 "
     "PruneWidth=.4 PruneWidthPeak=.6 0BaseSplits=2 0Length=.8 0SegSplits=.1 0SplitAngle=3 "
     "0CurveRes=8 0CurveBack=20 0CurveV=120 1DownAngle=20 1DownAngleV=10 1Rotate=-120 1RotateV=30 "
     "1Branches=25 1Length=.5 1LengthV=.1 1SegSplits=.2 1SplitAngle=30 1SplitAngleV=10 "
     "1CurveRes=16 1Curve=40 1CurveBack=80 1CurveV=90 2DownAngle=30 2DownAngleV=10 2Rotate=-120 "
     "2RotateV=30 2Branches=10 2Length=1.5 2SegSplits=.2 2SplitAngle=45 2SplitAngleV=20 "
     "2CurveRes=12 3DownAngle=20 3DownAngleV=10 3Rotate=140 3Branches=150 3Length=.1",
     23041.3, 213182.1},  // weeping willow
    {"Shape=7 Levels=3 Scale=13 ScaleV=3 BaseSize=.4 Ratio=.015 RatioPower=1.2 Flare=.6 Leaves=25 "
     "AttractionUp=.5 0CurveV=20 1DownAngle=60 1DownAngleV=-50 1Rotate=140 1Branches=50 1Length=.3 "
     "1CurveRes=5 1Curve=-40 1CurveV=50 2DownAngle=45 2DownAngleV=10 2Rotate=140 2Branches=30 "
     "2Length=.6 2CurveRes=3 2Curve=-40 2CurveV=75 3DownAngle=45 3DownAngleV=10 3Rotate=77",
     1223.8, 22013.7},  // quaking aspen
    {"Shape=4 BaseSize=.2 Scale=23 ScaleV=5 Levels=4 Ratio=.015 RatioPower=1.3 Flare=1 Leaves=6 "
     "AttractionUp=.5 0Taper=1.1 0CurveRes=10 0CurveV=40 1DownAngle=60 1DownAngleV=-40 1Rotate=140 "
     "1Branches=50 1Length=.3 1LengthV=.05 1CurveRes=10 1CurveV=90 2DownAngle=30 2DownAngleV=10 "
     "2Rotate=140 2Branches=25 2Length=.6 2LengthV=.1 2CurveRes=10 2Curve=-10 2CurveV=150 "
     "3DownAngle=45 3DownAngleV=10 3Rotate=140 3Branches=12 3Length=.4",
     9304.0, 37163.8},  // black tupelo
    {"Shape=2 BaseSize=.05 Scale=10 ScaleV=10 Levels=3 Ratio=.018 RatioPower=1.3 Flare=1.2 "
     "Leaves=25 AttractionUp=.8 0BaseSplits=2 0Taper=.95 0SegSplits=.4 0SplitAngle=10 0CurveRes=8 "
     "0CurveV=90 1DownAngle=30 1DownAngleV=-30 1Rotate=80 1Branches=40 1Length=.8 1LengthV=.1 "
     "1SegSplits=.2 1SplitAngle=10 1SplitAngleV=10 1CurveRes=10 1Curve=40 1CurveV=150 "
     "1CurveBack=-70 2DownAngle=45 2DownAngleV=10 2Rotate=140 2Branches=120 2Length=.2 "
     "2LengthV=.05 2Taper=.05 2SegSplits=.1 2SplitAngle=10 2SplitAngleV=10 2CurveRes=3 2Curve=-40 "
     "2CurveV=30 3DownAngle=45 3DownAngleV=10 3Rotate=140",
     4469.2, 70675.4},  // ca black oak
    {"Shape=3 Levels=2 Scale=.6 ScaleV=.1 BaseSize=.85 Ratio=.002 RatioPower=.5 Flare=0 Leaves=-1 "
     "LeafDistrib=3 0DownAngleV=40 0RotateV=80 0Branches=19 0BranchDist=.1 0Taper=.5 0CurveRes=49 "
     "0Curve=20 0CurveBack=80 0CurveV=40 1DownAngle=10 1DownAngleV=-5 1Rotate=-90 1RotateV=20 "
     "1Branches=35 1Length=.2 1CurveRes=1 2DownAngle=10 2Rotate=0",
     684.0, 665.0},  // barley
    {"Shape=0 Levels=3 Scale=3 ScaleV=1 BaseSize=.1 Ratio=.03 RatioPower=1 Flare=.2 Leaves=10 "
     "AttractionUp=2 0SegSplits=.05 0SplitAngle=3 0CurveRes=17 0Curve=10 0CurveBack=-90 "
     "0CurveV=360 1DownAngle=60 1DownAngleV=30 1Rotate=-90 1RotateV=30 1Branches=9 1Length=.8 "
     "1LengthV=.4 1Taper=1.03 1SegSplits=.25 1SplitAngle=5 1SplitAngleV=10 1CurveRes=17 1Curve=30 "
     "1CurveBack=-20 1CurveV=480 2DownAngle=40 2DownAngleV=-60 2Rotate=-90 2RotateV=30 "
     "2Branches=40 2Length=.3 2LengthV=.2 2SegSplits=.2 2SplitAngle=10 2SplitAngleV=10 "
     "2CurveRes=12 2CurveV=480 3DownAngle=20 3DownAngleV=10 3Rotate=140",
     1418.1, 4089.2},  // desert bush
    {"Shape=3 BaseSize=.2 Scale=25 ScaleV=5 Levels=3 Ratio=.02 RatioPower=1.3 Flare=.6 Leaves=40 "
     "AttractionUp=.5 0BaseSplits=3 0Taper=.95 0SplitAngle=20 0SplitAngleV=5 0CurveRes=8 0Curve=15 "
     "0CurveV=90 1DownAngle=45 1DownAngleV=-35 1Rotate=140 1Branches=40 1Length=.3 1SplitAngle=15 "
     "1SplitAngleV=30 1CurveRes=10 1Curve=-10 1CurveV=200 2DownAngle=45 2DownAngleV=10 2Rotate=140 "
     "2Branches=30 2Length=.7 2CurveRes=2 2CurveV=200 3DownAngle=45 3DownAngleV=10 3Rotate=140",
     1244.0, 36034.1},  // eastern cottonwood
    {"Shape=0 Levels=3 Scale=15 ScaleV=7 BaseSize=.25 Ratio=.015 RatioPower=1.3 Flare=.3 "
     "Leaves=100 LeafQuality=.5 LeafDistrib=3 AttractionUp=-2 0CurveRes=20 0CurveV=20 "
     "1DownAngle=60 1DownAngleV=-50 1Rotate=70 1RotateV=30 1Branches=60 1BranchDist=.5 1Length=.25 "
     "1LengthV=.15 1CurveRes=17 1Curve=20 1CurveBack=-100 1CurveV=120 2DownAngle=70 2DownAngleV=30 "
     "2Rotate=70 2RotateV=30 2Branches=50 2Length=.3 2LengthV=.1 2SegSplits=.15 2SplitAngle=40 "
     "2SplitAngleV=10 2CurveRes=7 3DownAngle=30 3Rotate=120",
     4538.3, 159894.0},  // european larch
    {"Shape=3 Levels=2 Scale=5 ScaleV=2 BaseSize=.8 Ratio=.05 RatioPower=1.8 Flare=0 Leaves=-80 "
     "0Taper=2.1 0CurveRes=6 0Curve=10 0CurveV=40 1DownAngle=40 1DownAngleV=-50 1Rotate=160 "
     "1RotateV=40 1Branches=27 1Length=.3 1LengthV=.15 1Taper=1.4 1CurveRes=9 1Curve=50 "
     "1CurveBack=-5 1CurveV=30 2DownAngle=-10 2DownAngleV=5 2Rotate=170 2RotateV=10",
     28.0, 2052.7},  // fanpalm
    {"Shape=2 Levels=3 Scale=25 ScaleV=5 BaseSize=0 Ratio=.015 RatioPower=1.3 Flare=.8 Leaves=12 "
     "AttractionUp=.5 0Scale=.8 0CurveRes=1 0CurveV=15 1DownAngle=30 1Rotate=77 1Branches=40 "
     "1Length=.3 1CurveRes=3 1Curve=-20 2DownAngle=30 2DownAngleV=10 2Rotate=77 2Branches=30 "
     "2Length=.4 2CurveRes=3 2Curve=-20 2CurveV=40 3DownAngle=30 3DownAngleV=10 3Rotate=77",
     940.7, 8122.9},  // lombardy poplar
    {"Shape=4 Levels=2 Scale=12 ScaleV=10 BaseSize=.95 Ratio=.015 RatioPower=2 Flare=0 Leaves=250 "
     "0Taper=2.1 0CurveRes=12 0Curve=20 0CurveBack=-5 0CurveV=10 1DownAngle=70 1DownAngleV=-80 "
     "1Rotate=120 1RotateV=60 1Branches=33 1Length=.4 1LengthV=.05 1CurveRes=9 1Curve=50 "
     "1CurveV=20 2DownAngle=50 2DownAngleV=-50 2Rotate=-120 2RotateV=20",
     34.0, 8147.0},  // palm
    {"Shape=2 Levels=4 Scale=23 ScaleV=7 BaseSize=.2 Ratio=.02 RatioPower=1.3 Flare=.5 Leaves=15 "
     "AttractionUp=.5 0Taper=1.05 0SplitAngle=20 0SplitAngleV=5 0CurveRes=16 0CurveV=60 1Length=.4 "
     "1DownAngle=90 1DownAngleV=-10 1Rotate=140 1Branches=15 1CurveRes=15 1CurveBack=30 1Curve=-60 "
     "1CurveV=200 2Length=.7 2DownAngle=50 2DownAngleV=10 2Rotate=140 2Branches=20 2CurveRes=8 "
     "2Curve=-40 2CurveV=300 3Length=.4 3DownAngle=45 3DownAngleV=10 3Rotate=140 3Branches=30 "
     "3CurveRes=3 3CurveV=200",
     5112.8, 54707.3},  // sassafras
    {"Shape=0 BaseSize=.1 Scale=22 ScaleV=3 Levels=3 Ratio=.015 RatioPower=1.3 Flare=.4 Leaves=50 "
     "AttractionUp=.5 0Taper=.9 0CurveRes=8 1DownAngle=55 1DownAngleV=-45 1Rotate=140 1Branches=75 "
     "1Length=.4 1CurveRes=8 1Curve=-30 1CurveV=120 2DownAngle=45 2DownAngleV=10 2Rotate=140 "
     "2Branches=50 2Length=.2 2CurveRes=8 2CurveV=180 3DownAngle=45 3DownAngleV=10 3Rotate=140",
     2272.2, 82294.7},  // tamarack
    {"Shape=3 Levels=2 Scale=.6 ScaleV=.1 BaseSize=.85 Ratio=.002 RatioPower=0 Flare=0 Leaves=-1 "
     "LeafDistrib=3 0DownAngleV=40 0RotateV=80 0Branches=49 0BranchDist=.1 0Taper=.5 0CurveRes=13 "
     "0CurveBack=30 0CurveV=20 1DownAngle=25 1DownAngleV=-5 1Rotate=120 1RotateV=10 1Branches=35 "
     "1Length=.025 1Taper=.5 1CurveRes=3 1CurveBack=20 2DownAngle=0 2Rotate=0",
     1764.0, 1715.0},  // wheat
    {"Shape=0 Levels=3 Scale=22 ScaleV=3 BaseSize=.3 Ratio=.015 RatioPower=1.3 Flare=.4 Leaves=50 "
     "AttractionUp=.5 0Taper=.9 0CurveRes=8 1DownAngle=55 1DownAngleV=-45 1Rotate=140 1Branches=75 "
     "1Length=.4 1SegSplits=.1 1SplitAngle=.1 1SplitAngleV=.1 1CurveRes=8 1Curve=30 1CurveV=120 "
     "2DownAngle=45 2DownAngleV=10 2Rotate=140 2Branches=50 2Length=.2 2CurveRes=8 2CurveV=180 "
     "3DownAngle=45 3DownAngleV=10 3Rotate=140",
     2347.0, 82327.0},  // conifer 1
    {"Shape=4 Levels=4 Scale=15 ScaleV=5 BaseSize=.2 Ratio=.03 RatioPower=1.3 Flare=1 Leaves=6 "
     "AttractionUp=.5 0Taper=1.1 0SplitAngle=30 0CurveRes=10 0CurveV=40 1DownAngle=60 "
     "1DownAngleV=-40 1Rotate=140 1Branches=50 1Length=.4 1LengthV=.05 1SegSplits=.2 "
     "1SplitAngle=40 1SplitAngleV=20 1CurveRes=10 1CurveV=90 2DownAngle=30 2DownAngleV=10 "
     "2Rotate=140 2Branches=25 2Length=.6 2LengthV=.1 2CurveRes=10 2Curve=-10 2CurveV=150 "
     "3DownAngle=45 3DownAngleV=10 3Rotate=140 3Branches=12 3Length=.4",
     9488.5, 37143.1},  // oak 1
    {"Shape=4 Levels=4 Scale=15 ScaleV=5 BaseSize=.6 Ratio=.03 RatioPower=1.3 Flare=.5 Leaves=6 "
     "AttractionUp=-.5 0Taper=1.1 0SplitAngle=30 0CurveRes=10 0CurveV=40 1DownAngle=60 "
     "1DownAngleV=-40 1Rotate=140 1Branches=50 1Length=.4 1LengthV=.05 1SplitAngle=40 "
     "1SplitAngleV=20 1CurveRes=10 1CurveV=90 2DownAngle=30 2DownAngleV=10 2Rotate=140 "
     "2Branches=25 2Length=.6 2LengthV=.1 2CurveRes=10 2Curve=-10 2CurveV=150 3DownAngle=45 "
     "3DownAngleV=10 3Rotate=140 3Branches=12 3Length=.4",
     9316.8, 37258.3},  // rain 1
    {"Shape=4 Levels=2 Scale=10 BaseSize=.5 Ratio=.005 RatioPower=.8 Flare=0 0Rotate=135 "
     "0Branches=2 0BranchDist=.2 0Taper=2 0CurveRes=20 0CurveV=-40 1DownAngle=90 1DownAngleV=8 "
     "1Rotate=130 1Branches=140 1BranchDist=.2 1Length=.2 1Taper=2 1CurveRes=1",
     282.0, 0.0},  // bottle brush
    {"Shape=4 Levels=2 Scale=.37 ScaleV=.2 BaseSize=.2 Ratio=.015 RatioPower=1 Flare=-.8 "
     "0Taper=1.1 0CurveRes=13 0Curve=10 1DownAngle=70 1DownAngleV=-60 1Rotate=180 1Branches=250 "
     "1Length=.2 1CurveRes=5 1Curve=-30",
     251.0, 0.0},  // feather
    {"Shape=0 Levels=3 Scale=22 ScaleV=3 BaseSize=.3 Ratio=.015 RatioPower=1.3 Flare=.4 Leaves=50 "
     "AttractionUp=.5 0Taper=.9 0SegSplits=.3 0SplitAngle=10 0SplitAngleV=3 0CurveRes=8 "
     "1DownAngle=55 1DownAngleV=-45 1Rotate=140 1Branches=75 1Length=.4 1SegSplits=.1 "
     "1SplitAngle=.1 1SplitAngleV=.1 1CurveRes=8 1Curve=30 1CurveV=120 2DownAngle=45 "
     "2DownAngleV=10 2Rotate=140 2Branches=50 2Length=.2 2CurveRes=8 2CurveV=180 3DownAngle=45 "
     "3DownAngleV=10 3Rotate=140",
     2348.3, 82118.3},  // conifer 2
    {"Shape=2 Levels=4 Scale=23 ScaleV=7 BaseSize=.2 Ratio=.02 RatioPower=1.3 Flare=.5 Leaves=15 "
     "AttractionUp=.1 0Taper=1.05 0SplitAngle=20 0SplitAngleV=5 0CurveRes=16 0Curve=20 0CurveV=60 "
     "1Length=.4 1DownAngle=90 1DownAngleV=-10 1Rotate=140 1Branches=15 1CurveRes=15 1CurveBack=30 "
     "1Curve=-60 1CurveV=200 2Length=.7 2DownAngle=50 2DownAngleV=10 2Rotate=140 2Branches=20 "
     "2CurveRes=8 2Curve=-40 2CurveV=300 3Length=.4 3DownAngle=45 3DownAngleV=10 3Rotate=140 "
     "3Branches=30 3CurveRes=3 3CurveV=200",
     5112.8, 54707.3},  // sassafras 2
};

struct Mean {
  double stems = 0, leaves = 0;
};

Mean mean_of(const Counted& each, int seeds) {
  Mean mean;
  const auto result = imported("arbaro", species(each.parameters));
  EXPECT_TRUE(result) << each.parameters << reports(result)[0];
  if (!result) return mean;
  nlohmann::json request = nlohmann::json::parse(result->request.canonical());
  for (int seed = 1; seed <= seeds; ++seed) {
    request["seed"] = 77 * seed;
    const Result<Request> read = read_request(request.dump(), Limits{});
    EXPECT_TRUE(read);
    const Result<std::string> answer = derive(*read, {});
    EXPECT_TRUE(answer);
    const nlohmann::json tree = nlohmann::json::parse(*answer);
    for (const nlohmann::json& level : tree.at("levels"))
      mean.stems += level.at("count").get<double>() / seeds;
    mean.leaves += tree.at("leaves").get<double>() / seeds;
  }
  return mean;
}

TEST(Arbaro, HasAsManyLimbsAndLeavesAsArbaro) {
  for (const Counted& each : counted) {
    const Mean mean = mean_of(each, 6);
    EXPECT_NEAR(mean.stems, each.stems, 0.08 * each.stems) << each.parameters;
    EXPECT_NEAR(mean.leaves, each.leaves, 0.12 * each.leaves) << each.parameters;
  }
}

TEST(Arbaro, HasAsManyLimbsAndLeavesForSpeciesOfUsers) {
  for (const Counted& each : species_of_users) {
    const Mean mean = mean_of(each, 6);
    EXPECT_NEAR(mean.stems, each.stems, 0.06 * each.stems) << each.parameters;
    EXPECT_NEAR(mean.leaves, each.leaves, 0.06 * each.leaves) << each.parameters;
  }
}

TEST(Arbaro, MakesFewerAndLargerLeavesOfALowerQuality) {
  const auto result = imported("arbaro", species("Leaves=200 LeafQuality=.25 LeafScale=.3"));
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result).value("Leaves", 0), 50);
  EXPECT_NEAR(parameters_of(result).value("LeafScale", 0.0), 0.6, 1e-12)
      << "the area of all leaves is the same";
  EXPECT_THAT(reports(imported("arbaro", species("Leaves=3 LeafQuality=.5"))),
              testing::Contains(testing::HasSubstr("rounded to a whole number")));
  EXPECT_THAT(reports(imported("arbaro", species("Leaves=3 LeafQuality=0"))),
              testing::Contains(testing::HasSubstr("expected a number above 0 and at most 1")));
}

}  // namespace
}  // namespace seedmesh
