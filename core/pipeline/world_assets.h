#pragma once
/// Plants and houses of worlds by requests of other generators.
#include "core/base/job.h"
#include "core/generators/world/asset.h"

namespace seedmesh {

/// Returns a function that makes assets within `options`.
/// - near: the model with at most 1,500 triangles, and textures of 128 texels; it has more triangles if it
///   cannot be simplified as far.
/// - far: an impostor of 12 triangles with a texture of 128 texels.
///
/// A request that cannot be made ends the job by Stop.
world::MakeAsset asset_maker(const Job::Options& options);

}  // namespace seedmesh
