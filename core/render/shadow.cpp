#include "core/render/shadow.h"

#include <algorithm>
#include <limits>

#include "core/render/samples.h"

namespace seedmesh::render {
namespace {

constexpr float darkest = std::numeric_limits<float>::lowest();
constexpr double edge = 4;    // texels around the model
constexpr double lifted = 1;  // texels towards the sun, so that a surface does not darken itself

ShadowMap::Range joined(const ShadowMap::Range& a, const ShadowMap::Range& b) {
  return {std::min(a.least, b.least), std::max(a.greatest, b.greatest)};
}

/// The ranges of all blocks, each with those of its neighbours.
Array<ShadowMap::Range> ranges_of(const ShadowMap& map, const Job& job) {
  static_assert(ShadowMap::reach <= ShadowMap::block);
  const std::size_t blocks = map.blocks;
  Array<ShadowMap::Range> own(job, blocks * blocks, {std::numeric_limits<float>::max(), darkest});
  for (std::size_t y = 0; y < map.size; ++y) {
    const float* const row = &map.depth[y * map.stride];
    ShadowMap::Range* const to = &own[y / ShadowMap::block * blocks];
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::size_t begin = i * ShadowMap::block,
                        end = std::min<std::size_t>(begin + ShadowMap::block, map.size);
      for (std::size_t x = begin; x < end; ++x) to[i] = joined(to[i], {row[x], row[x]});
    }
  }
  Array<ShadowMap::Range> around(job, own.size());
  for (std::size_t y = 0; y < blocks; ++y) {
    for (std::size_t x = 0; x < blocks; ++x) {
      ShadowMap::Range range = own[y * blocks + x];
      for (std::size_t row = y - (y > 0 ? 1 : 0); row <= std::min(y + 1, blocks - 1); ++row) {
        for (std::size_t column = x - (x > 0 ? 1 : 0); column <= std::min(x + 1, blocks - 1); ++column)
          range = joined(range, own[row * blocks + column]);
      }
      around[y * blocks + x] = range;
    }
  }
  return around;
}

}  // namespace

ShadowMap draw_shadows(const Scene& scene, const Frame& sun, std::uint32_t size, const Job& job) {
  ShadowMap map;
  map.frame = sun;
  map.size = size;
  map.side = static_cast<float>(size);
  map.stride = stride_of(size);
  map.blocks = (size + ShadowMap::block - 1) / ShadowMap::block;
  glm::dvec2 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner_of(scene.items.box, corner));
    const glm::dvec2 at(glm::dot(p, map.frame.right), glm::dot(p, map.frame.up));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const double across = std::max({high.x - low.x, high.y - low.y, 1e-6});
  map.step = across / (size - 2 * edge);
  map.low = 0.5 * (low + high) - 0.5 * map.step * size;
  map.bias = static_cast<float>(lifted * map.step);
  const Eye eye(map.frame, map.low, map.step, size);
  map.lens = eye.lens_at(glm::mat4(1));
  map.depth = draw_depths(project(scene, eye, job), darkest, job);
  map.around = ranges_of(map, job);
  return map;
}

}  // namespace seedmesh::render
