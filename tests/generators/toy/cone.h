#pragma once
/// A cone on the ground: the smallest generator that does everything a generator has to.
/// docs/add-a-generator.md walks through it.
///
///   params -> tip (drawn by place) -> mantle and base -> one closed mesh
///
/// Out:    one node "cone", centre of its base at the origin, +Y up, metres; one material.
/// Issues: /lean where the tip could come to stand outside the base.
/// Cost:   2 triangles a side, spent from `job` before they are made.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh {
struct ConeParams;
}

namespace seedmesh::cone {

/// What the schema cannot say: rules between parameters.
std::vector<Issue> check(const ConeParams& params);

Result<Model> generate(const ConeParams& params, Job& job);

}  // namespace seedmesh::cone
