#pragma once
/// Palettes for images whose colours depend on two channels, such as normals of unit length: one byte a pixel is written
/// instead of three.
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace seedmesh::texture {

/// Channels have 6 bits. A pair of levels has the number first + pair_levels * second.
constexpr std::uint32_t pair_levels = 64, pair_count = pair_levels * pair_levels;

/// Returns the byte of a level. The first and the last level are 0 and 255, and level 32 is 128.
constexpr std::uint32_t byte_of_level(std::uint32_t level) {
  return level + 1 == pair_levels ? 255 : level * (256 / pair_levels);
}

/// How often each pair occurs.
class PairCounts {
 public:
  void add(std::span<const std::uint32_t> pairs) {
    for (std::size_t i = 0; i + tables <= pairs.size(); i += tables) {
      for (std::size_t k = 0; k < tables; ++k) ++counts_[k * pair_count + pairs[i + k]];
    }
    for (std::size_t i = pairs.size() / tables * tables; i < pairs.size(); ++i) ++counts_[pairs[i]];
  }
  std::array<std::uint32_t, pair_count> sums() const {
    std::array<std::uint32_t, pair_count> all{};
    for (std::size_t i = 0; i < counts_.size(); ++i) all[i % pair_count] += counts_[i];
    return all;
  }

 private:
  static constexpr std::size_t tables = 4;  ///< adding to one number twice in a row makes the processor wait
  std::vector<std::uint32_t> counts_ = std::vector<std::uint32_t>(tables * pair_count, 0);
};

struct PairPalette {
  std::vector<glm::u8vec2> colors;            ///< at most 256; bytes of both channels
  std::array<std::uint8_t, pair_count> of{};  ///< the colour of each pair that occurs
};

/// Returns the palette of an image in which pairs occur as often as `counts` says. Up to 256 pairs are exact. Of more, those in
/// a square of a quadtree are replaced by their mean, least squared error first (after Gervautz and Purgathofer, A simple
/// method for color quantization: octree quantization, 1988). Cost: less than 0.1 ms.
PairPalette pair_palette(const std::array<std::uint32_t, pair_count>& counts);

}  // namespace seedmesh::texture
