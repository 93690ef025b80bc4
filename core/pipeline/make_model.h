#pragma once
/// From a request to its model with levels of detail and textures, before it is finished, named and written.
#include "core/base/job.h"
#include "core/model/demand.h"
#include "core/pipeline/body.h"
#include "core/schema/json.h"
#include "core/texture/paint.h"

namespace seedmesh {

/// Beyond this number of copies, the parts of one object are merged by material.
constexpr std::uint64_t most_parts = 400;

/// Whether the output refers to generated textures by URLs instead of containing them.
bool has_links(const OutputParams& output);

/// Returns the form of generated images, with `auto` resolved.
texture::ImageForm image_form_of(const OutputParams& output);

/// Returns the texels of a side of a texture; 0: no textures.
int texture_size(const OutputParams& output);

/// Returns a seed as a number, or as text where JavaScript would round it.
Json seed_json(std::uint64_t seed);

Demand demand_of(const OutputParams& output, const Generator& generator);

/// Makes the model of a request for its output. Throws Stop.
Result<Model> make_model(const Request& request, TextureStore* texture_store, Job& job);

}  // namespace seedmesh
