#pragma once
/// Bark textures by seed, of nine kinds. They tile seamlessly in both directions. v grows along the limb, so that the
/// direction of growth is down in the image. An image covers about two thirds of a metre of a trunk, or the whole
/// girth of a thinner limb. Strips from the left edge of the image with 1/2, 1/4 and so on of its width, down to
/// `least_bark_strip`, tile as well. Thin limbs can therefore show them at the same scale.
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/texture/relief.h"

namespace seedmesh::texture {

/// The narrowest strip that tiles, as a share of the width.
constexpr float least_bark_strip = 1.0F / 64;

/// The names of all kinds: "oak_bark", ...
std::span<const std::string_view> bark_kinds();

/// A colour in sRGB bytes that replaces the main colour of a kind. The other colours follow it.
using Tint = std::optional<std::array<std::uint8_t, 3>>;

struct Painting {
  Relief relief;
  Finish finish;
};

/// Returns the dark, main and light colours around `main`, or around `tint` if it is given.
Ramp ramp_round(glm::vec3 main, float dark, float light, glm::vec3 accent, const Tint& tint);

/// Returns the relief of a bark. `kind` is one of bark_kinds(). Cost: about 20 ns a texel for cracked kinds, 10 ns for
/// smooth ones.
Relief bark_relief(std::string_view kind, int size, std::uint64_t seed, const Job& job);
/// Returns how the relief becomes images.
Finish bark_finish(std::string_view kind, const Tint& tint);

}  // namespace seedmesh::texture
