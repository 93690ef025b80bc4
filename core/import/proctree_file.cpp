#include "core/import/proctree_file.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/schema/json.h"

namespace seedmesh {

std::string proctree_file(const TreeParams& p, ProctreeNames names) {
  // The order is that of listing 2.1 of Hutsko's thesis (2022).
  const std::array<std::pair<std::string_view, Json>, 22> members{{
      {"mBranchFactor", p.mBranchFactor},
      {"mClimbRate", p.mClimbRate},
      {"mClumpMax", p.mClumpMax},
      {"mClumpMin", p.mClumpMin},
      {"mDropAmount", p.mDropAmount},
      {"mGrowAmount", p.mGrowAmount},
      {"mInitialBranchLength", p.mInitialBranchLength},
      {"mLengthFalloffFactor", p.mLengthFalloffFactor},
      {"mLengthFalloffPower", p.mLengthFalloffPower},
      {"mLevels", p.mLevels},
      {"mMaxRadius", p.mMaxRadius},
      {"mRadiusFalloffRate", p.mRadiusFalloffRate},
      {"mSeed", p.mSeed},
      {"mSegments", p.mSegments},
      {"mSweepAmount", p.mSweepAmount},
      {"mTaperRate", p.mTaperRate},
      {"mTreeSteps", p.mTreeSteps},
      {"mTrunkKink", p.mTrunkKink},
      {"mTrunkLength", p.mTrunkLength},
      {"mTwigScale", p.mTwigScale},
      {"mTwistRate", p.mTwistRate},
      {"mVMultiplier", p.mVMultiplier},
  }};
  Json file = Json::object();
  for (const auto& [name, value] : members)
    file[names == ProctreeNames::original ? proctree_js_name(name) : std::string(name)] = value;
  return file.dump(2) + "\n";
}

std::string proctree_js_name(std::string_view parameter) {
  if (parameter == "mInitialBranchLength") return "initalBranchLength";
  std::string name(parameter.substr(1));
  if (name[0] >= 'A' && name[0] <= 'Z') name[0] = static_cast<char>(name[0] - 'A' + 'a');
  return name;
}

}  // namespace seedmesh
