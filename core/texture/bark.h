#pragma once
/// Bark by seed: heights, tones and colours of nine kinds. Each repeats in both directions without a seam; up
/// the limb is down the picture, as v grows. A picture stands for about a metre of a trunk, or once round a
/// thinner limb.
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "core/texture/relief.h"

namespace seedmesh::texture {

/// "oak_bark", ...
std::span<const std::string_view> bark_kinds();

/// A colour in sRGB bytes that takes the place of the kind's main colour; the others follow it.
using Tint = std::optional<std::array<std::uint8_t, 3>>;

struct Painting {
  Relief relief;
  Finish finish;
};

/// The dark, main and light colour round `main`, or round `tint` where there is one.
Ramp ramp_round(glm::vec3 main, float dark, float light, glm::vec3 accent, const Tint& tint);

/// `kind` is one of bark_kinds(). About 40 ns a texel for the kinds that crack, 15 for smooth ones.
Painting paint_bark(std::string_view kind, int size, std::uint64_t seed, const Tint& tint, const Job& job);

}  // namespace seedmesh::texture
