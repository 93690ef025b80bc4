#pragma once
/// Finds the limbs that graft() leaves to skin(), and makes their bark.
#include <vector>

#include "core/geom/plant/graft/bark_buffers.h"
#include "core/geom/plant/graft/graft_input.h"

namespace seedmesh {

/// Sets JoinMode::none for limbs that only skin() can draw: limbs with contours. With GraftOptions::points these are
/// also limbs whose radius becomes 0. With GraftOptions::overlaps these are also limbs that coincide with others.
void find_fallback_limbs(const Limbs& limbs, const Chains& chains, const Scale& scale,
                         const GraftOptions& options, Job& job, std::vector<JoinMode>& join);

/// Appends the bark of all limbs with JoinMode::none, trunks first. Throws Stop, or sets
/// GraftOptions::has_no_surface, where a limb bends so sharply that even skin() makes it face inward.
void append_skinned(const GraftInput& in, JoinedBark& bark, Job& job);

/// Reports that no closed surface exists: sets GraftOptions::has_no_surface where given, else throws Stop.
void refuse_bark(const GraftOptions& options, const char* reason, const Job& job);

}  // namespace seedmesh
