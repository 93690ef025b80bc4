#include "core/texture/atlas.h"

#include <algorithm>
#include <vector>

#include "core/base/math.h"
#include "core/texture/png_image.h"
#include "core/texture/srgb.h"

namespace seedmesh::texture {
namespace {

constexpr std::uint8_t middle = 128;  ///< the alpha of Atlas::cutoff
constexpr int widest_spread = 24;     ///< texels; beyond, the mean colour of the picture

struct Texel {
  std::uint32_t count = 0;  ///< of samples that are covered
  glm::u8vec3 color{0};
};

Texel texel_of(const Canvas& canvas, std::uint32_t x, std::uint32_t y, std::uint32_t samples) {
  Texel texel;
  glm::uvec3 sum(0);
  for (std::uint32_t j = 0; j < samples; ++j) {
    for (std::uint32_t i = 0; i < samples; ++i) {
      const Canvas::Sample& sample = canvas.at(x * samples + i, y * samples + j);
      texel.count += sample.is_covered;
      sum += glm::uvec3(sample.color);
    }
  }
  for (int c = 0; c < 3 && texel.count > 0; ++c) texel.color[c] = srgb_of(sum[c] / texel.count);
  return texel;
}

/// The threshold of coverage for which as many texels are drawn as samples.
std::uint32_t limit_of(const std::vector<Texel>& texels, std::uint32_t whole) {
  std::vector<std::size_t> with(whole + 1, 0);
  std::size_t covered = 0;
  for (const Texel& texel : texels) {
    ++with[texel.count];
    covered += texel.count;
  }
  std::size_t there = 0;
  for (std::uint32_t limit = whole; limit > 1; --limit) {
    there += with[limit];
    if (there * whole >= covered) return limit;
  }
  return 1;
}

/// A piecewise linear map: 0 to 0, the limit to the cutoff, and full coverage to 1.
std::uint8_t alpha_of(std::uint32_t count, std::uint32_t limit, std::uint32_t whole) {
  if (count < limit) return static_cast<std::uint8_t>(count * (middle - 1) / limit);
  if (whole == limit) return 255;
  return static_cast<std::uint8_t>(middle + (count - limit) * (255 - middle) / (whole - limit));
}

}  // namespace

Atlas::Atlas(std::uint32_t size, const Job& job)
    : size_(size), texels_(job, std::size_t{size} * size, glm::u8vec4(0)) {}

void Atlas::put(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell) {
  const std::uint32_t inside = canvas.width() / cell.samples, whole = cell.samples * cell.samples;
  std::vector<Texel> texels;
  texels.reserve(std::size_t{inside} * inside);
  for (std::uint32_t y = 0; y < inside; ++y) {
    for (std::uint32_t x = 0; x < inside; ++x) texels.push_back(texel_of(canvas, x, y, cell.samples));
  }
  const std::uint32_t limit = limit_of(texels, whole);
  for (std::uint32_t y = 0; y < inside; ++y) {
    for (std::uint32_t x = 0; x < inside; ++x) {
      const Texel& texel = texels[std::size_t{y} * inside + x];
      at(corner.x + cell.edge + x, corner.y + cell.edge + y) =
          glm::u8vec4(texel.color, alpha_of(texel.count, limit, whole));
    }
  }
  spread(corner, cell.size);
}

void Atlas::put_normals(const Canvas& canvas, const glm::uvec2& corner, const Cell& cell) {
  const std::uint32_t inside = canvas.width() / cell.samples;
  for (std::uint32_t y = 0; y < inside; ++y) {
    for (std::uint32_t x = 0; x < inside; ++x) {
      glm::ivec3 sum(0);
      for (std::uint32_t j = 0; j < cell.samples; ++j) {
        for (std::uint32_t i = 0; i < cell.samples; ++i)
          sum += glm::ivec3(glm::i8vec3(canvas.at(x * cell.samples + i, y * cell.samples + j).normal));
      }
      if (sum == glm::ivec3(0)) continue;
      const glm::dvec3 normal = math::unit(glm::dvec3(sum), glm::dvec3(0, 0, 1)) * 127.5 + 128.0;
      glm::u8vec4& texel = at(corner.x + cell.edge + x, corner.y + cell.edge + y);
      texel.w = 255;
      for (int c = 0; c < 3; ++c)
        texel[c] = static_cast<std::uint8_t>(std::clamp(math::to_int32(normal[c]), 0, 255));
    }
  }
  spread(corner, cell.size);
}

/// Spreads colours outwards, ring by ring: each texel gets the mean of its neighbours with a colour.
void Atlas::spread(const glm::uvec2& corner, std::uint32_t side) {
  std::vector<std::uint8_t> known(std::size_t{side} * side, 0);
  glm::u64vec3 sum(0);
  std::uint64_t colored = 0;
  const auto texel = [&](std::uint32_t x, std::uint32_t y) -> glm::u8vec4& {
    return at(corner.x + x, corner.y + y);
  };
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const glm::u8vec4& color = texel(x, y);
      if (color.w == 0 && glm::u8vec3(color) == glm::u8vec3(0)) continue;
      known[std::size_t{y} * side + x] = 1;
      sum += glm::u64vec3(glm::u8vec3(color));
      ++colored;
    }
  }
  if (colored == 0) return;
  std::vector<std::size_t> ring;
  for (int pass = 1; pass <= widest_spread; ++pass) {
    const auto mark = static_cast<std::uint8_t>(pass + 1);
    ring.clear();
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        if (known[std::size_t{y} * side + x] != 0) continue;
        glm::uvec3 mean(0);
        std::uint32_t count = 0;
        for (std::uint32_t v = y > 0 ? y - 1 : 0; v <= std::min(y + 1, side - 1); ++v) {
          for (std::uint32_t u = x > 0 ? x - 1 : 0; u <= std::min(x + 1, side - 1); ++u) {
            const std::uint8_t of = known[std::size_t{v} * side + u];
            if (of == 0 || of >= mark) continue;
            mean += glm::uvec3(glm::u8vec3(texel(u, v)));
            ++count;
          }
        }
        if (count == 0) continue;
        texel(x, y) = glm::u8vec4(glm::u8vec3(mean / count), 0);
        ring.push_back(std::size_t{y} * side + x);
      }
    }
    for (const std::size_t place : ring) known[place] = mark;
  }
  const glm::u8vec3 mean(sum / colored);
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      if (known[std::size_t{y} * side + x] == 0) texel(x, y) = glm::u8vec4(mean, 0);
    }
  }
}

std::shared_ptr<const Image> Atlas::image(const std::string& name, const Job& job) const {
  return png_image(name, {size_, size_, 4, 8, std::as_bytes(texels_.span())}, PngEffort::small, job);
}

std::shared_ptr<const Image> Atlas::normal_image(const std::string& name, const Job& job) const {
  Array<std::uint8_t> channels(job);
  channels.reserve(3 * texels_.size());
  for (const glm::u8vec4& texel : texels_) {
    // Texels far from any image have a neutral normal.
    const bool is_level = glm::u8vec3(texel) == glm::u8vec3(0);
    for (int c = 0; c < 3; ++c)
      channels.push_back(is_level ? (c == 2 ? std::uint8_t{255} : middle) : texel[c]);
  }
  return png_image(name, {size_, size_, 3, 8, std::as_bytes(channels.span())}, PngEffort::small, job);
}

}  // namespace seedmesh::texture
