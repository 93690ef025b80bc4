#pragma once
/// Makes the textures that the recipes of materials (Material::recipe) name.
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/model/model.h"
#include "core/texture/bark.h"
#include "core/texture/relief.h"
#include "core/texture/texture_store.h"
#include "core/texture/webp_write.h"

namespace seedmesh::texture {

/// Returns all kinds that a recipe can name: bark, leaves, twigs, petals, walls and roofs.
std::span<const std::string_view> texture_kinds();

/// Whether a kind tiles; bark and walls do.
bool is_repeating_kind(std::string_view name);

/// Returns the width and height in texels at which a kind is painted for textures of `size`. For single leaves
/// and petals, which cover few pixels, and for grime, which has no sharp edges, this is half of `size`, but not below
/// 64.
int painted_size(std::string_view kind, int size);

/// Paints a texture. `kind` is one of texture_kinds(). Its tint changes nothing but the finish.
Painting paint_kind(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job);

/// Returns the images of a recipe as PNG, from `store` or made now, at least those of `parts`. `store` may be null.
std::shared_ptr<const Maps> maps_of(const TextureRecipe& recipe, int size, MapParts parts,
                                    TextureStore* store, const Job& job);

/// How generated images are written: as PNG, as WebP, or as both, where the WebP is Image::webp.
enum class ImageForm { png, webp, both };

/// How a model contains its generated textures. Either it contains their bytes in one of the forms, or it links them
/// by the address `prefix`, name (core/texture/link.h) and ".png".
struct ImageStyle {
  ImageForm form = ImageForm::png;
  bool is_linked = false;
  std::string prefix = {};
};

/// Writes all generated images of a model that are still PNG in another form: impostors, and maps of terrains.
/// Images of the request stay as they are. In parallel. Cost: about 60 ns a pixel.
void form_images(Model& model, ImageForm form, const Job& job);

/// Makes the textures of all recipes, `size` texels wide and high (a power of two from 16 to 4096), once for
/// equal recipes. Sets them in the materials: base colour, normals, occlusion and roughness. Materials of
/// leaves and petals get the alpha mode `mask`, with the cutoff of their kind unless they have that mode
/// already. They become double-sided and get the normal map unless TextureRecipe::has_own_sides is set.
/// `store` may be null. Size 0 removes all textures of the model instead, and keeps the colours. Linked
/// images are not drawn: they get a uri and no bytes.
void paint(Model& model, int size, const ImageStyle& style, TextureStore* store, const Job& job);

}  // namespace seedmesh::texture
