#include "core/texture/paint.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/texture/leaf.h"
#include "core/texture/link.h"
#include "core/texture/wall.h"

namespace seedmesh::texture {
namespace {

bool is_bark_kind(std::string_view name) {
  return std::find(bark_kinds().begin(), bark_kinds().end(), name) != bark_kinds().end();
}

std::string key_of(const TextureRecipe& recipe, int size) {
  std::string key = recipe.kind + ' ' + std::to_string(recipe.seed) + ' ' + std::to_string(size);
  if (recipe.color) {
    for (const std::uint8_t channel : *recipe.color) key += ' ' + std::to_string(channel);
  }
  return key;
}

/// What distinguishes the stored images of some parts from those of all.
std::string suffix_of(MapParts parts) {
  return std::string(parts.normal ? "" : " no normal") + (parts.surface ? "" : " no surface");
}

/// The recipe of a relief, which is the same in every colour.
TextureRecipe relief_recipe(const TextureRecipe& recipe) {
  TextureRecipe plain = recipe;
  plain.color.reset();
  return plain;
}

Relief relief_of(std::string_view kind, int size, std::uint64_t seed, const Job& job) {
  if (wall_kind(kind) != nullptr) return wall_relief(kind, size, seed, job);
  return is_bark_kind(kind) ? bark_relief(kind, size, seed, job) : leaf_relief(kind, size, seed, job);
}

Relief relief_of(const TextureRecipe& recipe, int size, const Job& job) {
  return relief_of(recipe.kind, painted_size(recipe.kind, size), recipe.seed, job);
}

Finish finish_of(std::string_view kind, const Tint& tint) {
  if (wall_kind(kind) != nullptr) return wall_finish(kind, tint);
  return is_bark_kind(kind) ? bark_finish(kind, tint) : leaf_finish(kind, tint);
}

/// The reliefs that recipes of a model share. Each is kept until the last of these recipes, or to the end if a store has
/// the images of one.
class SharedReliefs {
 public:
  SharedReliefs(int size, const Job& job) : size_(size), job_(job) {}

  /// Announces a recipe, once for each.
  void expect(const TextureRecipe& recipe) { ++reliefs_[key_of(relief_recipe(recipe), size_)].uses; }
  std::shared_ptr<const Relief> take(const TextureRecipe& recipe) {
    Shared& shared = reliefs_[key_of(relief_recipe(recipe), size_)];
    if (!shared.relief) shared.relief = std::make_shared<const Relief>(relief_of(recipe, size_, job_));
    return --shared.uses > 0 ? shared.relief : std::move(shared.relief);
  }

 private:
  struct Shared {
    int uses = 0;  ///< that are still to come
    std::shared_ptr<const Relief> relief;
  };
  int size_;
  const Job& job_;
  std::map<std::string, Shared> reliefs_;
};

/// `reliefs` may be null.
std::shared_ptr<const Maps> make(const TextureRecipe& recipe, int size, MapParts parts,
                                 SharedReliefs* reliefs, const Job& job) {
  const std::shared_ptr<const Relief> relief =
      reliefs ? reliefs->take(recipe) : std::make_shared<const Relief>(relief_of(recipe, size, job));
  return std::make_shared<const Maps>(
      make_maps(*relief, finish_of(recipe.kind, recipe.color), recipe.kind, parts, job));
}

/// What was made before; either may be null.
struct Kept {
  SharedReliefs* reliefs = nullptr;
  TextureStore* store = nullptr;
};

/// The images of a recipe as PNG, from the store or made now.
std::shared_ptr<const Maps> png_maps(const TextureRecipe& recipe, int size, MapParts parts,
                                     const Kept& before, const Job& job) {
  const auto [reliefs, store] = before;
  const std::string all = key_of(recipe, size), key = all + suffix_of(parts);
  if (store) {
    std::shared_ptr<const void> kept = store->find(key);
    if (!kept && key != all) kept = store->find(all);
    if (kept) return std::static_pointer_cast<const Maps>(kept);
  }
  std::shared_ptr<const Maps> maps = make(recipe, size, parts, reliefs, job);
  if (store) store->keep(key, maps, maps->bytes());
  return maps;
}

/// Images that have URLs of generated textures instead of bytes.
std::shared_ptr<const Maps> linked_maps(const TextureRecipe& recipe, int size, MapParts parts,
                                        const std::string& prefix) {
  const auto linked = [&](Channel channel, const char* suffix) {
    auto image = std::make_shared<Image>();
    image->name = recipe.kind + suffix;
    image->uri = prefix + name_of({recipe, size, channel}) + ".png";
    return image;
  };
  return std::make_shared<const Maps>(Maps{linked(Channel::color, "_color"),
                                           parts.normal ? linked(Channel::normal, "_normal") : nullptr,
                                           parts.surface ? linked(Channel::surface, "_surface") : nullptr});
}

/// A generated PNG image in another form.
std::shared_ptr<const Image> in_form(const std::shared_ptr<const Image>& image, ImageForm form,
                                     WebpQuality quality, const Job& job) {
  if (form == ImageForm::png || !image) return image;
  const Result<Picture> picture = decode_png(std::as_bytes(std::span(image->bytes)), {}, job);
  if (!picture) return image;
  const Array<std::uint8_t> file = encode_webp(picture->view(), quality, job);
  auto webp = std::make_shared<Image>();
  webp->name = image->name;
  webp->mime = "image/webp";
  webp->bytes.assign(file.begin(), file.end());
  if (form == ImageForm::webp) return webp;
  // Engines that find images by name would take one form for the other.
  webp->name = (image->name.empty() ? "texture" : image->name) + "_webp";
  auto both = std::make_shared<Image>(*image);
  both->webp = std::move(webp);
  return both;
}

/// The images of a recipe in any form.
std::shared_ptr<const Maps> formed_maps(const TextureRecipe& recipe, int size, MapParts parts, ImageForm form,
                                        const Kept& before, const Job& job) {
  TextureStore* store = before.store;
  if (form == ImageForm::png) return png_maps(recipe, size, parts, before, job);
  const std::string key =
      key_of(recipe, size) + (form == ImageForm::webp ? " webp" : " both") + suffix_of(parts);
  if (store) {
    if (const std::shared_ptr<const void> kept = store->find(key))
      return std::static_pointer_cast<const Maps>(kept);
  }
  const std::shared_ptr<const Maps> plain = png_maps(recipe, size, parts, before, job);
  auto maps = std::make_shared<Maps>();
  parallel_for(job, 3, 1, [&](std::size_t begin, std::size_t, std::size_t) {
    if (begin == 0) maps->color = in_form(plain->color, form, WebpQuality::usual, job);
    if (begin == 1) maps->normal = in_form(plain->normal, form, WebpQuality::fine, job);
    if (begin == 2) maps->surface = in_form(plain->surface, form, WebpQuality::usual, job);
  });
  if (store) store->keep(key, maps, maps->bytes());
  return maps;
}

void strip(Model& model) {
  for (Material& material : model.materials) {
    material.recipe = {};
    for (TextureUse* use :
         {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      use->texture = -1;
    }
  }
  model.textures.clear();
}

/// Positions in Model::textures; -1 for none.
struct Places {
  int color = -1, normal = -1, surface = -1;
};

/// The position of an added texture; -1 for null.
int add_texture(Model& model, const std::shared_ptr<const Image>& image) {
  if (!image) return -1;
  model.textures.push_back(image);
  return static_cast<int>(model.textures.size()) - 1;
}

/// Sets the textures of a material, except those that it has already, for the set of texture coordinates that
/// it names.
void put(TextureUse& use, int texture, bool repeats) {
  if (use.texture < 0 && texture >= 0) use = {texture, use.uv_set, repeats};
}

void dress(Material& material, const Places& places, bool repeats) {
  put(material.base_color_texture, places.color, repeats);
  if (!material.recipe.has_own_sides) put(material.normal_texture, places.normal, repeats);
  put(material.occlusion_texture, places.surface, repeats);
  put(material.metallic_roughness_texture, places.surface, repeats);
  material.base_color = {material.recipe.factor, material.base_color.w};
  material.roughness = 1;
  if (repeats) return;
  if (material.alpha_mode != AlphaMode::mask) material.alpha_cutoff = leaf_cutoff(material.recipe.kind);
  material.alpha_mode = AlphaMode::mask;
  if (material.transmission == 0) let_light_through(material, leaf_picture(material.recipe.kind).shape);
  material.double_sided = material.double_sided || !material.recipe.has_own_sides;
}

}  // namespace

std::span<const std::string_view> texture_kinds() {
  static const std::vector<std::string_view> all = [] {
    std::vector<std::string_view> list(bark_kinds().begin(), bark_kinds().end());
    list.insert(list.end(), leaf_kinds().begin(), leaf_kinds().end());
    for (const WallKind& kind : wall_kinds()) list.push_back(kind.name);
    return list;
  }();
  return all;
}

int painted_size(std::string_view kind, int size) {
  constexpr int least = 64;
  const bool is_single = !is_repeating_kind(kind) && leaf_picture(kind).count == 1;
  return (is_single || kind == "grime") && size > least ? size / 2 : size;
}

bool is_repeating_kind(std::string_view name) { return is_bark_kind(name) || wall_kind(name) != nullptr; }

Painting paint_kind(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job) {
  return {relief_of(kind, size, seed, job), finish_of(kind, tint)};
}

std::shared_ptr<const Maps> maps_of(const TextureRecipe& recipe, int size, MapParts parts,
                                    TextureStore* store, const Job& job) {
  return png_maps(recipe, size, parts, {nullptr, store}, job);
}

void paint(Model& model, int size, const ImageStyle& style, TextureStore* store, const Job& job) {
  if (size == 0) return strip(model);
  std::set<std::string> with_normals;  // keys of reliefs whose normals a material shows
  for (const Material& material : model.materials) {
    if (!material.recipe.has_own_sides) with_normals.insert(key_of(relief_recipe(material.recipe), size));
  }
  SharedReliefs shared(size, job);
  std::set<std::string> recipes;
  for (const Material& material : model.materials) {
    const TextureRecipe& recipe = material.recipe;
    if (!recipe.kind.empty() && recipes.insert(key_of(recipe, size)).second) shared.expect(recipe);
  }
  std::map<std::string, Places> made, reliefs;
  for (Material& material : model.materials) {
    if (material.recipe.kind.empty()) continue;
    const auto [place, is_new] = made.try_emplace(key_of(material.recipe, size));
    if (is_new) {
      const std::string relief = key_of(relief_recipe(material.recipe), size);
      const auto [known, is_first] = reliefs.try_emplace(relief);
      const MapParts parts{is_first && with_normals.count(relief) > 0, is_first};
      const std::shared_ptr<const Maps> maps =
          style.is_linked ? linked_maps(material.recipe, size, parts, style.prefix)
                          : formed_maps(material.recipe, size, parts, style.form, {&shared, store}, job);
      place->second.color = add_texture(model, maps->color);
      if (is_first) {
        known->second.normal = parts.normal ? add_texture(model, maps->normal) : -1;
        known->second.surface = add_texture(model, maps->surface);
      }
      place->second.normal = known->second.normal;
      place->second.surface = known->second.surface;
    }
    dress(material, place->second, is_repeating_kind(material.recipe.kind));
    material.recipe = {};
  }
}

void form_images(Model& model, ImageForm form, const Job& job) {
  if (form == ImageForm::png) return;
  std::vector<bool> is_normal(model.textures.size(), false);
  for (const Material& material : model.materials) {
    if (material.normal_texture.texture >= 0)
      is_normal[static_cast<std::size_t>(material.normal_texture.texture)] = true;
  }
  parallel_for(job, model.textures.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      std::shared_ptr<const Image>& image = model.textures[i];
      const bool is_done =
          image->is_given || image->bytes.empty() || image->mime != "image/png" || image->webp;
      if (!is_done) image = in_form(image, form, is_normal[i] ? WebpQuality::fine : WebpQuality::usual, job);
    }
  });
}

}  // namespace seedmesh::texture
