#pragma once
/// Normals of limbs with ribs, from their faces.
#include "core/geom/plant/graft/bark_buffers.h"

namespace seedmesh {

/// True where the limb has rings with ribs.
bool has_rib_seams(const BarkBuffers& bark, std::size_t limb);

/// Replaces the normals of a limb with ribs, except on loops, by the means of the normals of adjacent faces, weighted
/// by angle. Then turns them until none faces away from its faces, as relax_normals() does. Used if normals by
/// formula face away from faces of the limb. With few corners for a ring, the faces of deep ribs or of a flare are
/// steeper than the ribs themselves.
void smooth_rib_normals(BarkBuffers& bark, std::size_t limb);

}  // namespace seedmesh
