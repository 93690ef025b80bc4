#pragma once
/// Triangles on their way to the samples, and where cut-out textures are empty on them. For core/render only.
#include <algorithm>
#include <cmath>

#include "core/render/cover.h"
#include "core/render/fragment.h"

namespace seedmesh::render {

/// A triangle on its way to the samples, with its corners in the order of Cover.
struct Triangle {
  Cover cover;
  std::array<std::uint32_t, 3> vertex;
  std::array<float, 3> depth;
  std::uint32_t number;
};

/// The holes of a cut-out texture on one triangle. Coordinates are in texels, as planes that are linear in the image
/// after they are multiplied by the depth.
class Holes {
 public:
  Holes(const Surface& surface, const Array<glm::vec2>& uv, const Triangle& t, bool is_perspective)
      : is_perspective_(is_perspective), repeat_(surface.repeat) {
    std::array<glm::vec2, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = uv[t.vertex[i]];
    const double per_area = 1 / static_cast<double>(t.cover.area);
    level_ =
        &surface.texels->level(surface.texels->level_of(texels_of_sample(*surface.texels, at, per_area)));
    is_power_ = ((level_->width & (level_->width - 1)) | (level_->height & (level_->height - 1))) == 0;
    u_ = plane_of(t, {at[0].x, at[1].x, at[2].x}, level_->width);
    v_ = plane_of(t, {at[0].y, at[1].y, at[2].y}, level_->height);
  }

  /// Those of the four samples that show the surface.
  FourFlags filled(FourFloats depth, FourFloats across, float down) const {
    FourFloats u = u_.of(across, down), v = v_.of(across, down);
    if (is_perspective_) {
      const FourFloats distance = 1.0F / depth;
      u *= distance;
      v *= distance;
    }
    const FourFlags at =
        placed(v, level_->height) * static_cast<std::int32_t>(level_->width) + placed(u, level_->width);
    const glm::u16vec4* const texels = level_->texels.data();
    const FourFlags alpha = {texels[at[0]].w, texels[at[1]].w, texels[at[2]].w, texels[at[3]].w};
    return alpha >= four_flags(std::max<std::int32_t>(level_->cutoff, 1));
  }

 private:
  Plane plane_of(const Triangle& t, const std::array<float, 3>& share, std::uint32_t size) const {
    // Whole repeats are left out, so that the numbers stay small.
    const float least = repeat_ ? std::floor(std::min({share[0], share[1], share[2]})) : 0;
    std::array<double, 3> q;
    for (std::size_t i = 0; i < 3; ++i) {
      q[i] = static_cast<double>(share[i] - least) * size;
      if (is_perspective_) q[i] *= static_cast<double>(t.depth[i]);
    }
    return t.cover.plane(q[0], q[1], q[2]);
  }

  FourFlags placed(FourFloats at, std::uint32_t size) const {
    constexpr float farthest = 1 << 24;
    const auto most = static_cast<std::int32_t>(size) - 1;
    at = chosen(at > all_lanes(0), at, all_lanes(0));
    at = chosen(at < all_lanes(farthest), at, all_lanes(farthest));
    const FourFlags whole = __builtin_convertvector(at, FourFlags);
    if (!repeat_) return chosen(whole < four_flags(most), whole, four_flags(most));
    if (is_power_) return whole & four_flags(most);
    FourFlags out{};
    for (int lane = 0; lane < 4; ++lane) out[lane] = whole[lane] % (most + 1);
    return out;
  }

  const texture::Texels::Level* level_;
  Plane u_, v_;
  bool is_perspective_, repeat_, is_power_;
};

}  // namespace seedmesh::render
