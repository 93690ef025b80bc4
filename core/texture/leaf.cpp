#include "core/texture/leaf.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/texture/coverage.h"
#include "core/texture/noise.h"

namespace seedmesh::texture {
namespace {

using glm::dvec2;
using glm::vec2;

// Blossoms and shoots of needles have fewer, narrow leaves more, so that all twigs have similar gaps.
constexpr int leaves_of_a_twig = 31, blossoms_of_a_spray = 9, narrow_leaves_of_a_twig = 91;
constexpr int shoots_of_a_spruce = 13, shoots_of_a_pine = 7;
// Rows between two checks of the deadline.
constexpr int rows_a_look = 32;
// The share of the accent colour in the heart of a blossom, and where on the petals it ends.
constexpr float heart = 0.85F, heart_end = 0.3F;

/// The map from the frame of the leaf to texels; y is reversed, because images begin at the top.
class View {
 public:
  View(const LeafDrawing& drawing, int size) : low_(drawing.low), high_(drawing.high), size_(size) {
    scale_ = static_cast<double>(size) / (high_ - low_);
    by_scale_ = 1.0 / scale_;
  }
  dvec2 texel(dvec2 p) const { return {(p.x - low_.x) * scale_.x, (high_.y - p.y) * scale_.y}; }
  vec2 leaf(int x, int y) const {
    return vec2(low_.x + (x + 0.5) * by_scale_.x, high_.y - (y + 0.5) * by_scale_.y);
  }
  /// The longer side of a texel in the frame of the leaf.
  float texel_size() const { return static_cast<float>(1 / std::min(scale_.x, scale_.y)); }
  Window around(dvec2 low, dvec2 high) const {
    const dvec2 a = texel({low.x, high.y}), b = texel({high.x, low.y});
    const auto bound = [&](double v) {
      return static_cast<int>(std::clamp(std::floor(v), 0.0, double(size_)));
    };
    return {bound(a.x - 1), bound(a.y - 1), bound(b.x + 2), bound(b.y + 2)};
  }

 private:
  dvec2 low_, high_;
  dvec2 scale_{1}, by_scale_{1};
  int size_;
};

class Painter {
 public:
  /// `has_hearts`: blades have the accent colour at their base. Leaves of twigs differ more, and are darker at their
  /// base, where others shade them.
  Painter(const LeafDrawing& drawing, Relief& relief, Rng rng, bool has_hearts, bool is_twig, const Job& job)
      : view_(drawing, relief.height.size()),
        relief_(relief),
        rng_(rng),
        has_hearts_(has_hearts),
        is_twig_(is_twig),
        job_(job) {}

  /// `woody` lines have the accent colour.
  void paint_line(const LeafLine& line, std::uint64_t number, float woody) {
    Rng own = rng_.at("line").at(number);
    const auto tone = static_cast<float>(own.uniform(0.35, 0.65));
    each_texel_of(line, 1, [&](int x, int y, float cover, float across) {
      float& there = relief_.cover.at(x, y);
      const float height = 0.8F - 0.5F * across * across;
      if (height > relief_.height.at(x, y) || there < 0.5F) {
        mix(relief_.height.at(x, y), height, cover);
        mix(relief_.tone.at(x, y), tone + 0.15F * (1 - across), cover);
        mix(relief_.accent.at(x, y), woody, cover);
      }
      there = std::max(there, cover);
    });
  }

  void paint_blade(const LeafBlade& blade, std::uint64_t number) {
    job_.check();
    std::vector<dvec2> outline;
    dvec2 low = blade.base, high = blade.base;
    const auto add = [&](dvec2 p) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      outline.push_back(view_.texel(p));
    };
    for (const dvec2& p : blade.right) add(p);
    for (std::size_t i = blade.left.size(); i-- > 0;) add(blade.left[i]);
    const Window window = view_.around(low, high);
    if (window.empty()) return;
    fill(blade, Coverage(outline, window), window, number);
    for (const LeafLine& vein : blade.veins) {
      // Wide enough to be visible in the distance, even in small images.
      const float least = std::max(1.0F, 1.2F * view_.texel_size() / static_cast<float>(vein.width));
      each_texel_of(vein, least, [&](int x, int y, float cover, float) {
        const float strength = cover * relief_.cover.at(x, y) / least;
        float& tone = relief_.tone.at(x, y);
        tone += (0.95F - tone) * 0.6F * strength;
        relief_.height.at(x, y) += 0.16F * strength;
      });
    }
  }

 private:
  static void mix(float& value, float to, float share) { value += (to - value) * share; }

  void fill(const LeafBlade& blade, const Coverage& coverage, const Window& window, std::uint64_t number) {
    Rng own = rng_.at("blade").at(number);
    const auto own_tone = static_cast<float>(own.uniform(-1, 1)) * (is_twig_ ? 0.16F : 0.1F);
    const float rise = is_twig_ ? 0.24F : 0.1F;
    const vec2 base(blade.base), along = vec2(blade.tip - blade.base);
    const float by_length = 1 / glm::dot(along, along);
    const vec2 across =
        vec2(along.y, -along.x) * std::sqrt(by_length) / static_cast<float>(std::max(blade.half_width, 1e-6));
    std::vector<float> covers(static_cast<std::size_t>(window.width()));
    for (int y = window.y0; y < window.y1; ++y) {
      if (y % rows_a_look == 0) job_.check();
      coverage.read(y, covers);
      for (int x = window.x0; x < window.x1; ++x) {
        const float cover = covers[static_cast<std::size_t>(x - window.x0)];
        if (cover <= 0) continue;
        const vec2 p = view_.leaf(x, y) - base;
        const float t = clamp_share(glm::dot(p, along) * by_length), side = glm::dot(p, across);
        const float tone = 0.47F - 0.5F * rise + own_tone + 0.05F * (side > 0 ? 1.0F : -1.0F) + rise * t;
        mix(relief_.tone.at(x, y), tone, cover);
        mix(relief_.height.at(x, y), 0.62F - 0.25F * side * side, cover);
        mix(relief_.accent.at(x, y), has_hearts_ ? heart * step_between(heart_end, 0, t) : 0, cover);
        relief_.cover.at(x, y) = std::max(relief_.cover.at(x, y), cover);
      }
    }
  }

  /// Calls body(x, y, cover, |across| 0..1) for the texels of a line, `widen` times its width.
  template <class Body>
  void each_texel_of(const LeafLine& line, float widen, Body&& body) {
    const double reach = 0.5 * std::max(line.width, line.end_width) * widen + view_.texel_size();
    const dvec2 low{std::min(line.from.x, line.to.x), std::min(line.from.y, line.to.y)};
    const dvec2 high{std::max(line.from.x, line.to.x), std::max(line.from.y, line.to.y)};
    const Window window = view_.around(low - reach, high + reach);
    const vec2 from(line.from), along = vec2(line.to - line.from);
    const float squared = glm::dot(along, along);
    if (squared <= 0) return;
    const float by_texel = 1 / view_.texel_size(), by_squared = 1 / squared;
    const float least_half = 0.35F * view_.texel_size(),
                half_begin = 0.5F * static_cast<float>(line.width) * widen;
    const float half_change = 0.5F * static_cast<float>(line.end_width - line.width) * widen;
    for (int y = window.y0; y < window.y1; ++y) {
      if (y % rows_a_look == 0) job_.check();
      const auto [x0, x1] = near_texels(line, reach, window, y);
      for (int x = x0; x < x1; ++x) {
        const vec2 p = view_.leaf(x, y) - from;
        const float t = clamp_share(glm::dot(p, along) * by_squared);
        const vec2 off = p - along * t;
        const float apart = glm::dot(off, off);
        const float half = std::max(half_begin + half_change * t, least_half);
        const float distance = std::sqrt(apart);
        const float cover = clamp_share((half - distance) * by_texel + 0.5F);
        if (cover > 0) body(x, y, cover, std::min(1.0F, distance / half));
      }
    }
  }

  /// The texels of a row that are no farther than `reach` from the infinite line through both ends.
  std::pair<int, int> near_texels(const LeafLine& line, double reach, const Window& window, int y) const {
    const dvec2 along = line.to - line.from;
    if (along.y == 0) return {window.x0, window.x1};
    const double height = static_cast<double>(view_.leaf(0, y).y) - line.from.y;
    const double middle = line.from.x + along.x * (height / along.y);
    const double half = reach * std::sqrt(glm::dot(along, along)) / std::abs(along.y);
    const Window near = view_.around({middle - half, line.from.y}, {middle + half, line.from.y});
    return {std::max(window.x0, near.x0), std::min(window.x1, near.x1)};
  }

  View view_;
  Relief& relief_;
  Rng rng_;
  bool has_hearts_, is_twig_;
  const Job& job_;
};

struct Colors {
  glm::vec3 main;    ///< sRGB bytes
  glm::vec3 accent;  ///< of woody stalks, or of the base of a petal
};

Colors colors_of(LeafShape shape) {
  switch (shape) {
    case LeafShape::willow:
      return {{122, 146, 86}, {168, 148, 92}};
    case LeafShape::birch:
      return {{106, 146, 62}, {96, 66, 48}};
    case LeafShape::cordate:
      return {{98, 144, 70}, {104, 96, 60}};
    case LeafShape::lobed:
      return {{86, 122, 52}, {100, 84, 62}};
    case LeafShape::maple:
      return {{104, 140, 60}, {130, 70, 56}};
    case LeafShape::ginkgo:
      return {{138, 162, 74}, {128, 112, 80}};
    case LeafShape::compound:
      return {{92, 132, 62}, {108, 110, 66}};
    case LeafShape::palmate:
      return {{80, 122, 56}, {106, 108, 62}};
    case LeafShape::needles:
      return {{58, 94, 66}, {104, 78, 54}};
    case LeafShape::pine_needles:
      return {{72, 100, 62}, {116, 84, 56}};
    case LeafShape::palm:
      return {{98, 136, 66}, {138, 140, 84}};
    case LeafShape::petal:
      return {{238, 178, 200}, {240, 214, 110}};
    case LeafShape::simple:
    case LeafShape::kite:
      return {{92, 134, 60}, {104, 92, 58}};
  }
  return {{92, 134, 60}, {104, 92, 58}};
}

constexpr bool makes_twigs(LeafShape shape) {
  return shape != LeafShape::palm && shape != LeafShape::kite && shape != LeafShape::compound &&
         shape != LeafShape::palmate;
}

int count_of(LeafShape shape) {
  if (shape == LeafShape::petal) return blossoms_of_a_spray;
  if (shape == LeafShape::needles) return shoots_of_a_spruce;
  if (shape == LeafShape::pine_needles) return shoots_of_a_pine;
  return shape == LeafShape::willow ? narrow_leaves_of_a_twig : leaves_of_a_twig;
}

struct Kind {
  std::string name;
  LeafPicture picture;
};

/// One leaf of each shape, then the twigs.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> made = [] {
    std::vector<Kind> list;
    for (int i = 0; i < leaf_shape_count; ++i) {
      const auto shape = static_cast<LeafShape>(i);
      const std::string name(leaf_shape_names()[static_cast<std::size_t>(i)]);
      const bool is_whole = shape == LeafShape::petal || has_needles(shape);
      list.push_back({is_whole ? name : name + "_leaf", {shape, 1}});
    }
    for (int i = 0; i < leaf_shape_count; ++i) {
      const auto shape = static_cast<LeafShape>(i);
      const std::string name(leaf_shape_names()[static_cast<std::size_t>(i)]);
      if (makes_twigs(shape)) list.push_back({name + "_twig", {shape, count_of(shape)}});
    }
    return list;
  }();
  return made;
}

const Kind& kind_named(std::string_view name) {
  const auto found =
      std::find_if(kinds().begin(), kinds().end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds().end() ? kinds().front() : *found;
}

void add_grain(Relief& relief, const LeafPicture& picture, Rng rng, const Job& job) {
  const int size = relief.tone.size();
  const Noise blotches(size, {5, 5}, {5, 0.6F}, 0.5F, rng.at("blotches"));
  const bool is_petal = picture.shape == LeafShape::petal && picture.count == 1;
  for_rows(job, size, [&](int begin, int end) {
    NoiseRows rows(blotches);
    for (int y = begin; y < end; ++y) {
      const float* blotch = rows.row(y);
      float *tone = relief.tone.row(y), *height = relief.height.row(y);
      for (int x = 0; x < size; ++x) {
        tone[x] = clamp_share(tone[x] + 0.22F * blotch[x]);
        height[x] = clamp_share(height[x] + 0.05F * blotch[x]);
      }
      if (!is_petal) continue;
      const float eye = 0.9F * step_between(0.68F, 1, static_cast<float>(y) / static_cast<float>(size));
      std::fill_n(relief.accent.row(y), size, eye);
    }
  });
}

}  // namespace

std::span<const std::string_view> leaf_kinds() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Kind& kind : kinds()) list.push_back(kind.name);
    return list;
  }();
  return names;
}

LeafPicture leaf_picture(std::string_view kind) { return kind_named(kind).picture; }

std::string_view leaf_kind(LeafShape shape, bool is_twig) {
  std::string_view leaf;
  for (const Kind& kind : kinds()) {
    if (kind.picture.shape != shape) continue;
    if ((kind.picture.count > 1) == is_twig) return kind.name;
    leaf = kind.name;
  }
  return leaf;
}

void let_light_through(Material& material, LeafShape shape) {
  constexpr float through_blade = 0.4F, through_needle = 0.25F, leaf_specular = 0.4F;
  // Chlorophyll takes blue light twice: the proportions of 1.25, 1.2 and 0.55, at most 1 as glTF demands.
  constexpr glm::vec3 through_green{1, 0.96F, 0.44F};
  material.transmission = has_needles(shape) ? through_needle : through_blade;
  material.transmission_color = shape == LeafShape::petal ? glm::vec3(1) : through_green;
  material.specular = leaf_specular;
}

// Mip levels are means of alpha. With a lower cutoff, dense textures of fine parts close in the distance. With a higher
// one, twigs of spruces vanish at the sixth level, because their needles are thin and their mean alpha is 0.29. Those of
// willows are sparse too.
float leaf_cutoff(std::string_view kind) {
  const LeafPicture picture = leaf_picture(kind);
  if (picture.count == 1 || picture.shape == LeafShape::needles) return 0.45F;
  return picture.shape == LeafShape::willow ? 0.43F : 0.5F;
}

Finish leaf_finish(std::string_view kind, const Tint& tint) {
  const Colors colors = colors_of(leaf_picture(kind).shape);
  Finish finish;
  finish.ramp = ramp_round(colors.main * (1 / 255.0F), 0.6F, 1.3F, colors.accent * (1 / 255.0F), tint);
  finish.depth = 0.05F;
  finish.rough_low = 0.75F;
  finish.rough_high = 0.55F;
  finish.rough_accent = 0.85F;
  finish.shade = 0;  // occlusion by other leaves is in the vertex colours
  return finish;
}

Relief leaf_relief(std::string_view kind, int size, std::uint64_t seed, const Job& job) {
  const LeafPicture picture = leaf_picture(kind);
  const Rng rng = Rng::of_seed(seed).at(kind);
  Relief relief{Field(job, size, 0.4F), Field(job, size, 0.45F), Field(job, size, 0), Field(job, size, 0)};
  const LeafDrawing drawing = draw_leaf(picture.shape, {}, picture.count);
  const bool is_spray = picture.shape == LeafShape::petal && picture.count > 1;
  const bool is_twig = picture.count > 1 && !is_spray;
  Painter painter(drawing, relief, rng, is_spray, is_twig, job);
  const bool is_woody = picture.count > 1 || has_needles(picture.shape);
  for (std::size_t i = 0; i < drawing.stalks.size(); ++i) {
    painter.paint_line(drawing.stalks[i], i, i < drawing.woody && is_woody ? 0.9F : 0.15F);
  }
  for (std::size_t i = 0; i < drawing.blades.size(); ++i) painter.paint_blade(drawing.blades[i], i);
  add_grain(relief, picture, rng, job);
  return relief;
}

}  // namespace seedmesh::texture
