#include "core/import/proctree_file.h"

#include "core/schema/json.h"

namespace seedmesh {

std::string proctree_file(const TreeParams& p) {
  const Json file = {{"seed", p.mSeed},
                     {"segments", p.mSegments},
                     {"levels", p.mLevels},
                     {"vMultiplier", p.mVMultiplier},
                     {"twigScale", p.mTwigScale},
                     {"initalBranchLength", p.mInitialBranchLength},  // as proctree.js spells it
                     {"lengthFalloffFactor", p.mLengthFalloffFactor},
                     {"lengthFalloffPower", p.mLengthFalloffPower},
                     {"clumpMax", p.mClumpMax},
                     {"clumpMin", p.mClumpMin},
                     {"branchFactor", p.mBranchFactor},
                     {"dropAmount", p.mDropAmount},
                     {"growAmount", p.mGrowAmount},
                     {"sweepAmount", p.mSweepAmount},
                     {"maxRadius", p.mMaxRadius},
                     {"climbRate", p.mClimbRate},
                     {"trunkKink", p.mTrunkKink},
                     {"treeSteps", p.mTreeSteps},
                     {"taperRate", p.mTaperRate},
                     {"radiusFalloffRate", p.mRadiusFalloffRate},
                     {"twistRate", p.mTwistRate},
                     {"trunkLength", p.mTrunkLength}};
  return file.dump(2) + "\n";
}

}  // namespace seedmesh
