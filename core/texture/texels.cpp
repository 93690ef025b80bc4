/// The coverage of cut-out images stays the same at every level: Castaño, "Computing alpha mipmaps", 2010.
#include "core/texture/texels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/math.h"
#include "core/model/model.h"

namespace seedmesh::texture {
namespace {

constexpr float whole = 65'535;

std::uint16_t word_of(float share) {
  const float rounded = std::clamp(share, 0.0F, 1.0F) * whole + 0.5F;
  return static_cast<std::uint16_t>(rounded);
}

/// Of channels with 16 bits, only the upper 8 are used.
std::uint8_t byte_at(const Picture& picture, std::size_t index) {
  const std::uint32_t value = picture.channel(index);
  return static_cast<std::uint8_t>(picture.bits == 16 ? value >> 8U : value);
}

/// Linear values of all bytes.
std::array<std::uint16_t, 256> linear_words() {
  std::array<std::uint16_t, 256> words;
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] = word_of(linear_of_srgb(static_cast<std::uint8_t>(i)));
  return words;
}

/// The mean of four texels, with colours weighted by alpha.
glm::u16vec4 mean_of(const std::array<glm::u16vec4, 4>& four) {
  if ((four[0].w & four[1].w & four[2].w & four[3].w) == 65'535) {
    glm::u16vec4 mean(65'535);
    for (int c = 0; c < 3; ++c)
      mean[c] = static_cast<std::uint16_t>((four[0][c] + four[1][c] + four[2][c] + four[3][c]) / 4);
    return mean;
  }
  std::uint64_t weight = 0, plain[3] = {}, weighted[3] = {};
  for (const glm::u16vec4& texel : four) {
    weight += texel.w;
    for (int c = 0; c < 3; ++c) {
      plain[c] += texel[c];
      weighted[c] += std::uint64_t{texel[c]} * texel.w;
    }
  }
  glm::u16vec4 mean;
  for (int c = 0; c < 3; ++c)
    mean[c] = static_cast<std::uint16_t>(weight > 0 ? weighted[c] / weight : plain[c] / 4);
  mean.w = static_cast<std::uint16_t>(weight / 4);
  return mean;
}

/// The greatest threshold that at least `share` of the texels reach.
std::uint16_t limit_for(const Array<glm::u16vec4>& texels, double share) {
  std::vector<std::size_t> count(257, 0);
  for (const glm::u16vec4& texel : texels) ++count[texel.w >> 8U];
  const double wanted = share * static_cast<double>(texels.size());
  std::size_t reached = 0;
  for (std::uint32_t step = 256; step-- > 1;) {
    reached += count[step];
    if (static_cast<double>(reached) >= wanted) return static_cast<std::uint16_t>(step << 8U);
  }
  return 1;
}

}  // namespace

Texels::Texels(const Picture& picture, float cutoff, const Job& job) {
  const std::size_t size = std::size_t{picture.width} * picture.height;
  const auto channels = static_cast<std::size_t>(picture.channels);
  const bool has_alpha = channels == 2 || channels == 4, is_grey = channels < 3;
  Level first{picture.width, picture.height, word_of(cutoff), Array<glm::u16vec4>(job, size),
              Array<std::uint8_t>(job)};
  const std::array<std::uint16_t, 256> words = linear_words();
  std::size_t there = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i % 65'536 == 0) job.check();
    glm::u16vec4& texel = first.texels[i];
    for (std::size_t c = 0; c < 3; ++c) {
      texel[static_cast<int>(c)] = words[byte_at(picture, i * channels + (is_grey ? 0 : c))];
    }
    texel.w = 65'535;
    if (has_alpha) texel.w = static_cast<std::uint16_t>(byte_at(picture, (i + 1) * channels - 1) * 257U);
    there += texel.w >= first.cutoff ? 1 : 0;
    has_holes_ = has_holes_ || texel.w == 0 || texel.w < first.cutoff;
  }
  const double share = static_cast<double>(there) / static_cast<double>(size);
  levels_.push_back(std::move(first));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& finer = levels_.back();
    Level level{std::max(1U, finer.width / 2), std::max(1U, finer.height / 2), 0, Array<glm::u16vec4>(job),
                Array<std::uint8_t>(job)};
    level.texels.resize(std::size_t{level.width} * level.height);
    for (std::uint32_t y = 0; y < level.height; ++y) {
      for (std::uint32_t x = 0; x < level.width; ++x) {
        const std::size_t x0 = std::size_t{x} * finer.width / level.width;
        const std::size_t y0 = std::size_t{y} * finer.height / level.height;
        const std::size_t x1 = std::min<std::size_t>(x0 + 1, finer.width - 1);
        const std::size_t y1 = std::min<std::size_t>(y0 + 1, finer.height - 1);
        level.texels[std::size_t{y} * level.width + x] =
            mean_of({finer.texels[y0 * finer.width + x0], finer.texels[y0 * finer.width + x1],
                     finer.texels[y1 * finer.width + x0], finer.texels[y1 * finer.width + x1]});
      }
    }
    level.cutoff = finer.cutoff == 0 ? std::uint16_t{0} : limit_for(level.texels, share);
    levels_.push_back(std::move(level));
  }
  if (!has_holes_) return;
  for (Level& level : levels_) {
    level.filled.resize(level.texels.size());
    const std::uint16_t least = std::max<std::uint16_t>(level.cutoff, 1);
    for (std::size_t i = 0; i < level.texels.size(); ++i)
      level.filled[i] = level.texels[i].w >= least ? 1 : 0;
  }
}

std::size_t Texels::level_of(double texels) const {
  if (!(texels > 2)) return 0;
  // How often it can be divided by 4 until at most 2 are left. The exponent e: 2^e <= texels < 2^(e + 1).
  const auto bits = std::bit_cast<std::uint64_t>(texels);
  const std::size_t exponent = (bits >> 52U) - 1023;
  const bool is_power = (bits & ((std::uint64_t{1} << 52U) - 1)) == 0;
  return std::min((exponent + (is_power ? 0 : 1)) / 2, levels_.size() - 1);
}

glm::u16vec4 Texels::at(const glm::dvec2& uv, std::size_t level, bool repeat) const {
  const Level& from = levels_[level];
  const auto place = [repeat](double share, std::uint32_t size) {
    const double inside = repeat ? share - std::floor(share) : std::clamp(share, 0.0, 1.0);
    return std::min(math::to_uint32(inside * size), size - 1);
  };
  glm::u16vec4 texel =
      from.texels[std::size_t{place(uv.y, from.height)} * from.width + place(uv.x, from.width)];
  if (texel.w < from.cutoff) texel.w = 0;
  return texel;
}

}  // namespace seedmesh::texture
