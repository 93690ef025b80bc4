#pragma once
/// Convex bodies around the trunk and thick limbs of trees and L-systems, for physics engines.
#include <vector>

#include "core/generators/api.h"
#include "core/geom/plant/limbs.h"
#include "core/model/model.h"

namespace seedmesh {

/// A straight piece of a limb, with its radii at both ends.
struct LimbBody {
  glm::vec3 from{0}, to{0};
  float base = 0, end = 0;
};

/// Whether limbs that begin below the ground, such as roots of trees, count or are left out.
enum class BelowGround { counted, left_out };

/// Returns the pieces of limbs with at least a third of the radius of the trunk, at most 32. Cost: linear.
std::vector<LimbBody> limb_bodies(const Limbs& limbs, BelowGround below, Job& job);

/// Adds a node and a mesh for each body: a closed prism with eight sides. context.demand.collision
/// selects the form of the names; with CollisionNames::none nothing is added.
void add_limb_bodies(Model& model, const std::vector<LimbBody>& bodies, const GenerateContext& context);

}  // namespace seedmesh
