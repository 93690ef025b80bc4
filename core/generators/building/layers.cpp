#include "core/generators/building/layers.h"

#include <algorithm>
#include <bit>

#include "core/base/rng.h"

namespace seedmesh::building {
namespace {

constexpr std::uint32_t most_layers = 64;

bool is_asset(const Shape& shape) { return (shape.geometry & asset_bit) != 0; }

struct CornerMask {
  std::uint64_t key = 0, layers = 0;
};

/// Which layers have a corner at a place already. Open addressing; keys are never 0.
class CornerBook {
 public:
  CornerBook(const Job& job, std::size_t corners)
      : slots_(job, std::bit_ceil(corners * 2 + 64), CornerMask{}) {}
  std::uint64_t& layers(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = mix(key) & mask;; i = (i + 1) & mask) {
      if (slots_[i].key == key) return slots_[i].layers;
      if (slots_[i].key == 0) {
        slots_[i].key = key;
        return slots_[i].layers;
      }
    }
  }

 private:
  Array<CornerMask> slots_;
};

std::uint64_t key_of(const glm::dvec3& point, const glm::dvec3& low, double diagonal) {
  const glm::dvec3 cell = (point - low) / (1e-5 * diagonal) + 2.5;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key = key << 21U | static_cast<std::uint64_t>(std::clamp(cell[axis], 0.0, 2e6));
  return key + 1;
}

void corners_of(const Shapes& shapes, const Shape& shape, const glm::dvec3& low, double diagonal,
                std::vector<std::uint64_t>& keys) {
  keys.clear();
  const glm::dmat3& axes = shapes.axes[shape.axes];
  const auto add = [&](const glm::dvec3& unit) {
    keys.push_back(key_of(shape.origin + axes * (unit * shape.size), low, diagonal));
  };
  if (shape.geometry == box_geometry || is_asset(shape)) {
    const int x = shape.size.x != 0 ? 2 : 1, y = shape.size.y != 0 ? 2 : 1, z = shape.size.z != 0 ? 2 : 1;
    for (int i = 0; i < x; ++i) {
      for (int j = 0; j < y; ++j) {
        for (int k = 0; k < z; ++k) add({i, j, k});
      }
    }
  } else {
    for (const glm::dvec3& p : shapes.solid_of(shape.geometry).points) add(p);
  }
}

}  // namespace

std::vector<std::uint8_t> layers_of(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                    const glm::dvec3& low, double diagonal, Job& job) {
  std::size_t corners = 0;
  for (const std::uint32_t index : drawn) {
    const Shape& shape = shapes.shapes[index];
    corners +=
        shape.geometry == box_geometry || is_asset(shape) ? 8 : shapes.solid_of(shape.geometry).points.size();
  }
  CornerBook book(job, corners);
  std::vector<std::uint8_t> layers;
  layers.reserve(drawn.size());
  std::vector<std::uint64_t> keys;
  std::vector<std::uint64_t*> masks;
  for (const std::uint32_t index : drawn) {
    corners_of(shapes, shapes.shapes[index], low, diagonal, keys);
    std::uint64_t taken = 0;
    masks.clear();
    for (const std::uint64_t key : keys) {
      masks.push_back(&book.layers(key));
      taken |= *masks.back();
    }
    const auto layer =
        std::min<std::uint32_t>(static_cast<std::uint32_t>(std::countr_one(taken)), most_layers - 1);
    for (std::uint64_t* mask : masks) *mask |= std::uint64_t{1} << layer;
    layers.push_back(static_cast<std::uint8_t>(layer));
    if ((layers.size() & 4095U) == 0) job.check();
  }
  return layers;
}

std::uint32_t spread(std::vector<std::uint8_t>& layers, std::size_t least) {
  std::vector<std::size_t> count;
  for (const std::uint8_t layer : layers) {
    count.resize(std::max<std::size_t>(count.size(), layer + 1U), 0);
    ++count[layer];
  }
  for (std::uint8_t& layer : layers) {
    if (count.size() >= std::min<std::size_t>(least, most_layers)) break;
    if (count[layer] < 2) continue;
    --count[layer];
    layer = static_cast<std::uint8_t>(count.size());
    count.push_back(1);
  }
  return static_cast<std::uint32_t>(count.size());
}

}  // namespace seedmesh::building
