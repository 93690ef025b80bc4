#pragma once
/// The derived shapes of a blueprint.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "generated/params/building.h"
#include "tests/support/context.h"

namespace seedmesh::building {

/// Returns the list of shapes that `derive` answers for these parameters.
inline Json shapes_of(const Json& json, std::uint64_t seed) {
  IssueList faults;
  const BuildingParams params = read_building(json, "", faults);
  EXPECT_TRUE(faults.empty());
  Job job(seed, Job::Options{});
  Result<Json> derived = derive(params, context_of(job));
  EXPECT_TRUE(derived);
  return (*derived)["shapes"];
}

}  // namespace seedmesh::building
