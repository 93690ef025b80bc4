#pragma once
/// Names of generated textures, so that a model can refer to them by URL instead of containing their bytes.
///
/// A name contains all that the bytes depend on, except the engine: kind, seed, size, colour and channel, as in
/// `oak_bark.17.512.color` or `brick.3.512.a0b1c2.normal`. Every service with the same engine makes the same
/// bytes from a name, so no service has to store it.
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/model/model.h"
#include "core/texture/texture_store.h"

namespace seedmesh {
class Job;
}

namespace seedmesh::texture {

/// The images of one recipe: base colour; normals; occlusion, roughness and metallic.
enum class Channel { color, normal, surface };

struct Link {
  TextureRecipe recipe;  ///< recipe without the factor, which belongs to a material
  int size = 512;        ///< texels of a side
  Channel channel = Channel::color;
};

/// Returns the name of a texture; 100 characters at most.
std::string name_of(const Link& link);

/// Reads a name. Returns nullopt for a text that name_of() cannot have made: an unknown kind or channel, a size that
/// is no power of two from 16 to 4096, a number with leading zeros.
std::optional<Link> read_link(std::string_view name);

/// Returns the image of a link, from `store` or made now. `store` may be null. Cost: about 60 ns a texel,
/// because the three images of a recipe are made together, from one relief.
std::shared_ptr<const Image> image_of(const Link& link, TextureStore* store, const Job& job);

}  // namespace seedmesh::texture
