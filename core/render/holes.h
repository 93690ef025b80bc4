#pragma once
/// The samples of a triangle where its cut-out texture is empty. For core/render only.
#include <algorithm>
#include <cmath>

#include "core/render/bins.h"
#include "core/render/fragment.h"

namespace seedmesh::render {

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

  /// Returns a flag for each of eight samples: whether the texture is not empty there.
  Flags filled(Floats depth, Floats across, float down) const {
    Floats u = u_.of(across, down), v = v_.of(across, down);
    if (is_perspective_) {
      const Floats distance = 1.0F / depth;
      u *= distance;
      v *= distance;
    }
    const Flags at =
        placed(v, level_->height) * static_cast<std::int32_t>(level_->width) + placed(u, level_->width);
    const std::uint8_t* const filled = level_->filled.data();
    const Flags found = {filled[at[0]], filled[at[1]], filled[at[2]], filled[at[3]],
                         filled[at[4]], filled[at[5]], filled[at[6]], filled[at[7]]};
    return found != all_lanes(0);
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

  Flags placed(Floats at, std::uint32_t size) const {
    constexpr float farthest = 1 << 24;
    const auto most = static_cast<std::int32_t>(size) - 1;
    at = chosen(at > all_lanes(0.0F), at, all_lanes(0.0F));
    at = chosen(at < all_lanes(farthest), at, all_lanes(farthest));
    const Flags whole = __builtin_convertvector(at, Flags);
    if (!repeat_) return chosen(whole < all_lanes(most), whole, all_lanes(most));
    if (is_power_) return whole & all_lanes(most);
    Flags out{};
    for (int lane = 0; lane < lanes; ++lane) out[lane] = whole[lane] % (most + 1);
    return out;
  }

  const texture::Texels::Level* level_;
  Plane u_, v_;
  bool is_perspective_, repeat_, is_power_;
};

}  // namespace seedmesh::render
