#pragma once
/// Limbs that graft() leaves to skin(): which they are, and their bark.
#include <vector>

#include "core/geom/plant/graft/bark_buffers.h"
#include "core/geom/plant/graft/graft_input.h"

namespace seedmesh {

/// Sets JoinMode::none for limbs that only skin() can draw: those with contours, and where the options ask
/// for it, those that begin or pass through a point, and those that lie on another limb.
void leave_to_skin(const Limbs& limbs, const Chains& chains, const Scale& scale, const GraftOptions& options,
                   Job& job, std::vector<JoinMode>& join);

/// Appends the bark of all limbs with JoinMode::none, trunks first. Throws Stop, or sets
/// GraftOptions::has_no_surface, where a limb bends so sharply that even skin() makes it face inward.
void append_skinned(const GraftInput& in, JoinedBark& bark, Job& job);

/// Reports bark that is no surface: sets GraftOptions::has_no_surface where given, else throws Stop.
void refuse_bark(const GraftOptions& options, const char* reason, const Job& job);

}  // namespace seedmesh
