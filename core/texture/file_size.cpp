#include "core/texture/file_size.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "core/base/math.h"

namespace seedmesh::texture {
namespace {

/// The bytes of the three PNG files of a kind for each texel of the colour image, measured at 512 texels.
struct KindSize {
  std::string_view kind;
  float color, normal, surface;
};
constexpr KindSize kind_sizes[] = {KindSize{"oak_bark", 0.53F, 0.62F, 0.13F},
                                   {"pine_bark", 0.58F, 0.61F, 0.13F},
                                   {"spruce_bark", 0.73F, 0.85F, 0.17F},
                                   {"willow_bark", 0.50F, 0.59F, 0.13F},
                                   {"birch_bark", 1.24F, 0.55F, 0.11F},
                                   {"beech_bark", 0.68F, 0.66F, 0.08F},
                                   {"cherry_bark", 1.11F, 0.59F, 0.13F},
                                   {"palm_bark", 0.41F, 0.47F, 0.13F},
                                   {"cedar_bark", 0.37F, 0.35F, 0.08F},
                                   {"simple_leaf", 0.23F, 0.13F, 0.01F},
                                   {"willow_leaf", 0.25F, 0.13F, 0.01F},
                                   {"birch_leaf", 0.24F, 0.12F, 0.01F},
                                   {"cordate_leaf", 0.24F, 0.12F, 0.01F},
                                   {"lobed_leaf", 0.23F, 0.13F, 0.01F},
                                   {"maple_leaf", 0.23F, 0.12F, 0.01F},
                                   {"ginkgo_leaf", 0.26F, 0.13F, 0.01F},
                                   {"compound_leaf", 0.30F, 0.16F, 0.02F},
                                   {"palmate_leaf", 0.26F, 0.14F, 0.01F},
                                   {"needles", 0.36F, 0.18F, 0.02F},
                                   {"pine_needles", 0.33F, 0.16F, 0.02F},
                                   {"palm_leaf", 0.37F, 0.19F, 0.02F},
                                   {"kite_leaf", 0.19F, 0.10F, 0.01F},
                                   {"petal", 0.29F, 0.13F, 0.01F},
                                   {"simple_twig", 0.91F, 0.49F, 0.05F},
                                   {"willow_twig", 1.20F, 0.55F, 0.05F},
                                   {"birch_twig", 0.91F, 0.47F, 0.04F},
                                   {"cordate_twig", 0.97F, 0.51F, 0.04F},
                                   {"lobed_twig", 0.88F, 0.49F, 0.05F},
                                   {"maple_twig", 1.00F, 0.52F, 0.05F},
                                   {"ginkgo_twig", 1.09F, 0.60F, 0.04F},
                                   {"needles_twig", 1.32F, 0.63F, 0.07F},
                                   {"pine_needles_twig", 1.33F, 0.64F, 0.07F},
                                   {"petal_twig", 1.19F, 0.59F, 0.04F},
                                   {"brick", 0.26F, 0.61F, 0.06F},
                                   {"plaster", 0.12F, 0.74F, 0.04F},
                                   {"roof_tile", 0.18F, 0.46F, 0.03F},
                                   {"slate", 0.18F, 0.43F, 0.04F},
                                   {"planks", 0.20F, 0.60F, 0.05F},
                                   {"ashlar", 0.17F, 0.54F, 0.03F},
                                   {"concrete", 0.15F, 0.53F, 0.03F},
                                   {"sheet", 0.04F, 0.01F, 0.00F},
                                   {"panels", 0.03F, 0.01F, 0.00F},
                                   {"dressed_stone", 0.14F, 0.37F, 0.03F},
                                   {"paint", 0.04F, 0.03F, 0.02F},
                                   {"rooms", 0.05F, 0.01F, 0.00F},
                                   {"joinery", 0.16F, 0.23F, 0.05F},
                                   {"grime", 0.14F, 0.00F, 0.00F},
                                   {"brick_bay", 0.21F, 0.57F, 0.02F},
                                   {"plaster_bay", 0.10F, 0.66F, 0.04F},
                                   {"planks_bay", 0.18F, 0.35F, 0.01F},
                                   {"ashlar_bay", 0.12F, 0.40F, 0.01F},
                                   {"grass_ground", 0.58F, 0.98F, 0.13F},
                                   {"soil_ground", 0.37F, 0.81F, 0.11F},
                                   {"rock_ground", 0.43F, 0.86F, 0.12F},
                                   {"scree_ground", 0.38F, 0.82F, 0.11F},
                                   {"sand_ground", 0.30F, 0.76F, 0.07F},
                                   {"snow_ground", 0.23F, 0.89F, 0.07F},
                                   {"litter_ground", 0.44F, 0.93F, 0.13F},
                                   {"asphalt_ground", 0.45F, 0.97F, 0.08F},
                                   {"setts_ground", 0.25F, 0.69F, 0.10F}};
constexpr double measured_size = 512;
constexpr double fall = 0.4;  ///< larger images need fewer bytes a texel: their exponent

const KindSize& size_of(std::string_view kind) {
  constexpr static KindSize other{"", 0.4F, 1.0F, 0.1F};
  const auto* found = std::ranges::find(kind_sizes, kind, &KindSize::kind);
  return found == std::end(kind_sizes) ? other : *found;
}

}  // namespace

bool has_normals(const TextureRecipe& recipe) { return !recipe.kind.empty() && !recipe.has_own_sides; }

void TextureSizes::add(const Material& material) {
  const TextureRecipe& recipe = material.recipe;
  if (recipe.kind.empty()) return;
  const auto color = recipe.color.value_or(std::array<std::uint8_t, 3>{});
  colors_.emplace(recipe.kind, std::uint32_t{color[0]} << 16U | std::uint32_t{color[1]} << 8U | color[2]);
  has_normals_[recipe.kind] |= has_normals(recipe);
}

std::map<std::string, std::uint64_t> TextureSizes::images(int size) const {
  std::map<std::string, std::uint64_t> all;
  if (size <= 0) return all;
  const double texels = math::pow(measured_size / size, fall) * size * size;
  const auto add = [&](const std::string& name, float a_texel) {
    all.emplace(name, static_cast<std::uint64_t>(math::to_int64(static_cast<double>(a_texel) * texels)));
  };
  for (const auto& [kind, color] : colors_)
    add(kind + " color " + std::to_string(color), size_of(kind).color);
  for (const auto& [kind, has_normal] : has_normals_) {
    add(kind + " surface", size_of(kind).surface);
    if (has_normal) add(kind + " normal", size_of(kind).normal);
  }
  return all;
}

}  // namespace seedmesh::texture
