#include "core/texture/pair_palette.h"

#include <algorithm>
#include <functional>
#include <tuple>

namespace seedmesh::texture {
namespace {

constexpr std::size_t most_colors = 256;

/// The pixels in a square of pairs: sums of their number, their bytes, and the squares of these.
struct Sums {
  std::uint64_t count = 0, first = 0, second = 0, squares = 0;
  std::uint32_t colors = 0;  ///< that the square needs

  void add(const Sums& other) {
    count += other.count;
    first += other.first;
    second += other.second;
    squares += other.squares;
    colors += other.colors;
  }
  /// The sum of squared distances from the mean.
  double error() const {
    const auto a = static_cast<double>(first), b = static_cast<double>(second);
    return static_cast<double>(squares) - (a * a + b * b) / static_cast<double>(count);
  }
  glm::u8vec2 mean() const {
    return {static_cast<std::uint8_t>((first + count / 2) / count),
            static_cast<std::uint8_t>((second + count / 2) / count)};
  }
};

/// The squares of one size, in rows.
struct Layer {
  explicit Layer(std::uint32_t squares) : side(squares), sums(std::size_t{squares} * squares) {}
  Sums& at(std::uint32_t x, std::uint32_t y) { return sums[std::size_t{y} * side + x]; }
  std::uint32_t side;
  std::vector<Sums> sums;
};

/// From single pairs to the square of all.
std::vector<Layer> layers_of(const std::array<std::uint32_t, pair_count>& counts) {
  std::vector<Layer> layers{Layer(pair_levels)};
  for (std::uint32_t i = 0; i < pair_count; ++i) {
    const std::uint64_t a = byte_of_level(i % pair_levels), b = byte_of_level(i / pair_levels), n = counts[i];
    layers[0].sums[i] = {n, n * a, n * b, n * (a * a + b * b), n > 0 ? 1U : 0U};
  }
  while (layers.back().side > 1) {
    Layer next(layers.back().side / 2);
    for (std::uint32_t y = 0; y < layers.back().side; ++y) {
      for (std::uint32_t x = 0; x < layers.back().side; ++x)
        next.at(x / 2, y / 2).add(layers.back().at(x, y));
    }
    layers.push_back(std::move(next));
  }
  return layers;
}

/// A square that can become one colour, because each of its quarters has at most one.
struct Merge {
  double error;
  std::uint32_t layer, x, y;
  bool operator>(const Merge& other) const {
    return std::tie(error, layer, y, x) > std::tie(other.error, other.layer, other.y, other.x);
  }
};

/// Merges squares until there are few enough colours.
void merge(std::vector<Layer>& layers) {
  if (layers.back().sums[0].colors <= most_colors) return;
  std::vector<Merge> offers;
  const auto offer = [&](std::uint32_t layer, std::uint32_t x, std::uint32_t y) {
    const Sums& square = layers[layer].at(x, y);
    std::uint32_t most = 0;
    for (std::uint32_t i = 0; i < 4; ++i)
      most = std::max(most, layers[layer - 1].at(2 * x + i % 2, 2 * y + i / 2).colors);
    if (square.colors == 0 || most > 1) return;
    offers.push_back({square.error(), layer, x, y});
  };
  for (std::uint32_t y = 0; y < layers[1].side; ++y) {
    for (std::uint32_t x = 0; x < layers[1].side; ++x) offer(1, x, y);
  }
  std::make_heap(offers.begin(), offers.end(), std::greater<>());
  while (layers.back().sums[0].colors > most_colors) {
    std::pop_heap(offers.begin(), offers.end(), std::greater<>());
    const auto [error, layer, x, y] = offers.back();
    offers.pop_back();
    const std::uint32_t saved = layers[layer].at(x, y).colors - 1;
    for (std::uint32_t i = layer; i < layers.size(); ++i)
      layers[i].at(x >> (i - layer), y >> (i - layer)).colors -= saved;
    const std::size_t before = offers.size();
    if (layer + 1 < layers.size()) offer(layer + 1, x / 2, y / 2);
    if (offers.size() > before) std::push_heap(offers.begin(), offers.end(), std::greater<>());
  }
}

/// Gives the pairs of a square their colours.
void assign(std::vector<Layer>& layers, std::uint32_t layer, glm::uvec2 at, PairPalette& palette) {
  const Sums& square = layers[layer].at(at.x, at.y);
  if (square.count == 0) return;
  if (square.colors > 1) {
    for (std::uint32_t i = 0; i < 4; ++i)
      assign(layers, layer - 1, {2 * at.x + i % 2, 2 * at.y + i / 2}, palette);
    return;
  }
  const auto color = static_cast<std::uint8_t>(palette.colors.size());
  palette.colors.push_back(square.mean());
  const std::uint32_t side = 1U << layer;
  for (std::uint32_t y = at.y * side; y < (at.y + 1) * side; ++y) {
    for (std::uint32_t x = at.x * side; x < (at.x + 1) * side; ++x) palette.of[y * pair_levels + x] = color;
  }
}

}  // namespace

PairPalette pair_palette(const std::array<std::uint32_t, pair_count>& counts) {
  std::vector<Layer> layers = layers_of(counts);
  merge(layers);
  PairPalette palette;
  assign(layers, static_cast<std::uint32_t>(layers.size() - 1), {0, 0}, palette);
  return palette;
}

}  // namespace seedmesh::texture
