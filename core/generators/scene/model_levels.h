#pragma once
/// Converts a model for a scene: one mesh for each level, and materials that can be shared.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::scene {

enum class Seeds { must_agree, may_differ };

/// Returns true for equal materials, without regard to names. With Seeds::may_differ the seeds of recipes are
/// ignored too.
bool is_same(const Material& a, const Material& b, Seeds seeds);

/// How a file stores positions: in single precision, or on a grid of 16 bits.
enum class Vertices { exact, quantized };

/// Separates touching bodies, such as the parts of a building, by less than 0.0002 of the size of the model, or by some
/// steps of the grid that quantized vertices get. Neighbours move in different directions. Without this, the mesh that
/// joins the bodies would have edges with four faces, and duplicate faces.
void separate_bodies(Model& model, Vertices vertices);

/// Takes the meshes out of a model and returns one list of primitives for each level. Material indices are
/// those of that model.
std::vector<std::vector<Primitive>> extract_levels(Model& model, Job& job);

}  // namespace seedmesh::scene
