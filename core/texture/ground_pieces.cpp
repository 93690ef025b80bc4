#include "core/texture/ground_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/quick_math.h"
#include "core/base/wide.h"

namespace seedmesh::texture {
namespace {

constexpr int pieces_a_look = 256;

/// A piece that lies on the ground: an ellipse about `at`, in shares of the image.
struct Patch {
  glm::vec2 at{0}, along{1, 0};  ///< `along`: unit direction of the long axis
  float half_length = 0.01F, half_width = 0.01F;
};

/// The texels of the rows of a long narrow patch: those within `half` of a middle that moves with the row.
class Strip {
 public:
  /// |slope * x + across * y| <= most. Texels beyond the strip may be included.
  Strip(float slope, float across, float most) {
    constexpr float level = 1e-3F;  // smaller slopes would lose the digits
    if (std::abs(slope) < level) return;
    shift_ = -across / slope;
    half_ = std::abs(most / slope);
  }
  float low(float y) const { return shift_ * y - half_; }
  float high(float y) const { return shift_ * y + half_; }

 private:
  float shift_ = 0, half_ = 1e9F;
};

/// The floor of a coordinate in texels. std::floor is a call where the processor may lack the instruction.
int floor_of(float v) {
  constexpr float below = 8192;  // patches begin less than an image before it
  return static_cast<int>(v + below) - static_cast<int>(below);
}

constexpr int lanes = 8;  ///< texels of a row that are computed together

constexpr float absent = -1;  ///< the height of a piece outside of it

/// Texels of a row, from `x` on. `off_y`: from the middle of the patch.
struct RowPart {
  int x, count;
  float middle_x, off_y;
};

/// The image at the texels of a part.
struct Lanes {
  float height[lanes], tone[lanes];
};

/// Draws texels where the piece is higher than what is there. `at(a, b, height, tone)` computes both by the coordinates
/// -1 .. 1 along both axes.
template <class At>
void draw_lanes(const RowPart& part, const glm::vec2& along, const glm::vec2& across, const At& at,
                Lanes& there) {
  for (int k = 0; k < lanes; ++k) {
    const float off_x = static_cast<float>(part.x + k) + 0.5F - part.middle_x;
    const float a = off_x * along.x + part.off_y * along.y, b = off_x * across.x + part.off_y * across.y;
    // Without branches, which the processor could not predict.
    float own = absent, own_tone = 0;
    at(a, b, own, own_tone);
    own = std::abs(a) <= 1 ? own : absent;
    own = std::abs(b) <= 1 ? own : absent;
    own = k < part.count ? own : absent;
    there.tone[k] = own > there.height[k] ? own_tone : there.tone[k];
    there.height[k] = own > there.height[k] ? own : there.height[k];
  }
}

/// Draws the texels of a patch, none of which is higher than `most`. The image repeats in both directions.
template <class At>
void draw_patch(const Patch& patch, float most, Relief& relief, const At& at) {
  const int size = relief.height.size(), last = size - 1;
  const auto scale = static_cast<float>(size);
  const float length = std::max(patch.half_length * scale, 0.5F),
              width = std::max(patch.half_width * scale, 0.5F);
  const glm::vec2 middle = patch.at * scale, along = patch.along * (1 / length),
                  across = glm::vec2(-patch.along.y, patch.along.x) * (1 / width);
  const float reach_x = std::abs(patch.along.x) * length + std::abs(patch.along.y) * width,
              reach_y = std::abs(patch.along.y) * length + std::abs(patch.along.x) * width;
  const Strip lengthwise(patch.along.x, patch.along.y, length),
      crosswise(-patch.along.y, patch.along.x, width);
  const int last_y = floor_of(middle.y + reach_y);
  for (int y = floor_of(middle.y - reach_y); y <= last_y; ++y) {
    const float off_y = static_cast<float>(y) + 0.5F - middle.y;
    // The middles of texels are half a texel after their numbers; the rest is for rounding.
    const float low = std::max({-reach_x, lengthwise.low(off_y), crosswise.low(off_y)}) - 0.6F,
                high = std::min({reach_x, lengthwise.high(off_y), crosswise.high(off_y)}) - 0.4F;
    const int last_x = floor_of(middle.x + high);
    float *const heights = relief.height.row(y & last), *const tones = relief.tone.row(y & last);
    for (int x = floor_of(middle.x + low); x <= last_x; x += lanes) {
      const int begin = x & last;
      Lanes there;
      if (begin + lanes <= size) {
        std::copy_n(heights + begin, lanes, there.height);
        int lower = 0;
        for (int k = 0; k < lanes; ++k) lower += there.height[k] < most ? 1 : 0;
        if (lower == 0) continue;  // the piece is hidden
        std::copy_n(tones + begin, lanes, there.tone);
      } else {
        for (int k = 0; k < lanes; ++k) there.height[k] = heights[(x + k) & last];
        for (int k = 0; k < lanes; ++k) there.tone[k] = tones[(x + k) & last];
      }
      draw_lanes({x, last_x - x + 1, middle.x, off_y}, along, across, at, there);
      if (begin + lanes <= size) {
        std::copy_n(there.height, lanes, heights + begin);
        std::copy_n(there.tone, lanes, tones + begin);
      } else {
        for (int k = 0; k < lanes; ++k) heights[(x + k) & last] = there.height[k];
        for (int k = 0; k < lanes; ++k) tones[(x + k) & last] = there.tone[k];
      }
    }
  }
}

glm::vec2 direction(float turns) {
  const math::SinCos turn = math::quick_sincos(2 * math::pi * static_cast<double>(turns));
  return {static_cast<float>(turn.cos), static_cast<float>(turn.sin)};
}

float draw(Rng& rng, float low, float high) {
  return static_cast<float>(rng.uniform(static_cast<double>(low), static_cast<double>(high)));
}

/// A patch without a size, at a random position and in a random direction.
Patch placed(Rng& own) {
  Patch patch;
  const float x = draw(own, 0, 1);
  patch.at = {x, draw(own, 0, 1)};
  patch.along = direction(draw(own, 0, 1));
  return patch;
}

/// Makes the pieces by `make(own)` and draws them by `draw(piece)`, from the highest piece to the lowest. Each texel shows
/// its highest piece, so the order changes nothing but the time: most texels of the lower pieces are hidden already.
template <class Make, class Draw>
void draw_pieces(int count, const Rng& rng, const Job& job, const Make& make, const Draw& draw) {
  std::vector<decltype(make(rng))> pieces;
  pieces.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) pieces.push_back(make(rng.at(static_cast<std::uint64_t>(i))));
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.high > b.high; });
  int drawn = 0;
  for (const auto& piece : pieces) {
    if (drawn++ % pieces_a_look == 0) job.check();
    draw(piece);
  }
}

struct Blade {
  Patch patch;
  float high, tone;
};

Blade blade_of(const Pieces& pieces, const Field& clumps, Rng own) {
  Blade blade;
  Patch& patch = blade.patch = placed(own);
  patch.half_length = 0.5F * draw(own, pieces.shortest, pieces.longest);
  patch.half_width = patch.half_length * pieces.width;
  blade.high = draw(own, pieces.low, pieces.high);
  const glm::vec2 there = patch.at * static_cast<float>(clumps.size());
  blade.tone = 0.5F + pieces.differ * draw(own, -0.5F, 0.5F) +
               clumps.at(static_cast<int>(there.x), static_cast<int>(there.y));
  return blade;
}

struct Stone {
  Patch patch;
  std::array<glm::vec3, 5> planes;  ///< that cut the dome: direction and distance
  float high, tone;
};

Stone stone_of(const Pieces& pieces, Rng own) {
  Stone stone;
  Patch& patch = stone.patch = placed(own);
  const float random = draw(own, 0, 1);  // small ones are more frequent
  patch.half_length =
      0.5F * (pieces.shortest + (pieces.longest - pieces.shortest) * random * random * random);
  patch.half_width = patch.half_length * draw(own, pieces.width, 1);
  for (glm::vec3& plane : stone.planes) {
    const glm::vec2 side = direction(draw(own, 0, 1));
    plane = {side.x, side.y, draw(own, 0.35F, 0.75F)};
  }
  const float size_share = patch.half_length / (0.5F * pieces.longest);
  stone.high = pieces.low + (pieces.high - pieces.low) * (0.35F + 0.65F * size_share);
  stone.tone = 0.5F + pieces.differ * draw(own, -0.5F, 0.5F);
  return stone;
}

struct Leaf {
  Patch patch;
  glm::vec2 tilt{0};  ///< rise along both axes
  float curl = 0;     ///< rise of the sides
  float high, tone;
};

Leaf leaf_of(const Pieces& pieces, Rng own) {
  Leaf leaf;
  Patch& patch = leaf.patch = placed(own);
  patch.half_length = 0.5F * draw(own, pieces.shortest, pieces.longest);
  patch.half_width = patch.half_length * pieces.width * draw(own, 0.75F, 1.25F);
  const float tilt_along = draw(own, -0.09F, 0.09F);
  leaf.tilt = {tilt_along, draw(own, -0.09F, 0.09F)};
  leaf.curl = draw(own, -0.04F, 0.12F);
  leaf.high = draw(own, pieces.low, pieces.high);
  leaf.tone = 0.5F + pieces.differ * draw(own, -0.5F, 0.5F);
  return leaf;
}

SEEDMESH_WIDE void draw_blade(const Blade& blade, Relief& relief) {
  const float middle = blade.high;
  draw_patch(blade.patch, middle, relief, [&](float a, float b, float& height, float& tone) {
    const float across = std::abs(b) / std::max(0.25F, 1 - 0.7F * std::max(a, 0.0F));
    const float here = middle * (0.55F + 0.45F * (1 - 0.5F * (1 - a) * (1 - a) * 0.5F)) * (1 - 0.3F * across);
    height = across <= 1 ? here : absent;
    tone = blade.tone + 0.12F * a - 0.08F * across - 0.42F * (1 - middle);
  });
}

SEEDMESH_WIDE void draw_stone(const Stone& stone, float low, Relief& relief) {
  const float rise = stone.high - low;
  draw_patch(stone.patch, stone.high, relief, [&](float a, float b, float& height, float& tone) {
    float up = std::sqrt(std::max(0.0F, 1 - a * a - b * b));
    float facet = 0;
    // Cuts only make a stone lower.
    for (const glm::vec3& plane : stone.planes) {
      const float bound = (plane.z * 1.25F - a * plane.x - b * plane.y) * 1.6F;
      facet = bound < up ? plane.x : facet;
      up = bound < up ? bound : up;
    }
    height = up > 0 ? low + rise * up : absent;
    tone = stone.tone + 0.1F * facet - 0.25F * (1 - std::min(1.0F, 2 * up));
  });
}

SEEDMESH_WIDE void draw_leaf(const Leaf& leaf, Relief& relief) {
  constexpr float highest = 2;  // heights are at most 1
  draw_patch(leaf.patch, highest, relief, [&](float a, float b, float& height, float& tone) {
    // The widest part is nearer to the base than to the tip.
    const float half_width = (1 - a * a) * (1 - 0.35F * a), off = std::abs(b);
    const float rib = off < 0.07F ? 0.05F : 0;
    const float here = clamp_share(leaf.high + leaf.tilt.x * a + leaf.tilt.y * b + leaf.curl * b * b - rib);
    height = off <= half_width ? here : absent;
    tone = leaf.tone + 0.9F * (leaf.tilt.x * a + leaf.tilt.y * b) + (rib > 0 ? 0.1F : 0) -
           0.35F * (1 - leaf.high);
  });
}

}  // namespace

void add_blades(Relief& relief, const Pieces& pieces, const Field& clumps, Rng rng, const Job& job) {
  draw_pieces(
      pieces.count, rng, job, [&](Rng own) { return blade_of(pieces, clumps, own); },
      [&](const Blade& blade) { draw_blade(blade, relief); });
}

void add_stones(Relief& relief, const Pieces& pieces, Rng rng, const Job& job) {
  draw_pieces(
      pieces.count, rng, job, [&](Rng own) { return stone_of(pieces, own); },
      [&](const Stone& stone) { draw_stone(stone, pieces.low, relief); });
}

void add_leaves(Relief& relief, const Pieces& pieces, Rng rng, const Job& job) {
  draw_pieces(
      pieces.count, rng, job, [&](Rng own) { return leaf_of(pieces, own); },
      [&](const Leaf& leaf) { draw_leaf(leaf, relief); });
}

}  // namespace seedmesh::texture
