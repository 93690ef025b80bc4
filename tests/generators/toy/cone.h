#pragma once
/// A cone on the ground: the smallest complete generator.
/// docs/add-a-generator.md explains it.
///
///   params -> tip (drawn by key) -> mantle and base -> one closed mesh
///
/// Out:    one node "cone", centre of its base at the origin, +Y up, metres; one material.
/// Issues: /lean where the tip can be outside the base.
/// Cost:   2 triangles a side, counted by the job before they are made.
#include <vector>

#include "core/generators/api.h"

namespace seedmesh {
struct ConeParams;
}

namespace seedmesh::cone {

/// Errors that the schema cannot express: rules between parameters.
std::vector<Issue> check(const ConeParams& params);

Result<Model> generate(const ConeParams& params, const GenerateContext& context);

}  // namespace seedmesh::cone
