#include "core/generators/building/layers.h"

#include <algorithm>
#include <bit>

#include "core/base/rng.h"

namespace seedmesh::building {
namespace {

constexpr std::uint32_t most_layers = 64;

bool is_asset(const Shape& shape) { return (shape.geometry & asset_bit) != 0; }

bool is_flat(const Shape& shape) { return !is_asset(shape) && dimension(shape.size) < 3; }

struct LayerMask {
  std::uint64_t key = 0, layers = 0;
};

/// The layers that have a corner, an edge or a face, by its key: a hash table with open addressing. Keys are
/// never 0.
class LayerTable {
 public:
  explicit LayerTable(const Job& job) : job_(job), slots_(job, 1024, LayerMask{}) {}

  /// Reserves space for more keys, so that references stay valid.
  void expect(std::size_t keys) {
    if ((used_ + keys) * 2 <= slots_.size()) return;
    Array<LayerMask> old = std::move(slots_);
    slots_ = Array<LayerMask>(job_, std::bit_ceil((used_ + keys) * 4), LayerMask{});
    used_ = 0;
    for (const LayerMask& each : old) {
      if (each.key != 0) layers(each.key) = each.layers;
    }
  }
  /// Begins to fetch the place of a key.
  void fetch(std::uint64_t key) const {
    __builtin_prefetch(slots_.data() + (mix(key) & (slots_.size() - 1)), 1);
  }
  std::uint64_t& layers(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = mix(key) & mask;; i = (i + 1) & mask) {
      if (slots_[i].key == key) return slots_[i].layers;
      if (slots_[i].key == 0) {
        slots_[i].key = key;
        ++used_;
        return slots_[i].layers;
      }
    }
  }

 private:
  const Job& job_;
  Array<LayerMask> slots_;
  std::size_t used_ = 0;
};

/// Computes the keys of shapes.
class KeyMaker {
 public:
  KeyMaker(const Shapes& shapes, const glm::dvec3& low, double diagonal, bool has_edges)
      : shapes_(shapes), low_(low), by_cell_(1 / (1e-5 * diagonal)), has_edges_(has_edges) {}

  std::vector<std::uint64_t>& of_body(const Shape& shape) {
    keys_.clear();
    corners_.clear();
    if (shape.geometry == box_geometry || is_asset(shape)) {
      add_box(shape);
    } else {
      add_solid(shape);
    }
    return keys_;
  }

  /// The keys of a flat face by its ring, or of a flat solid by all its rings.
  std::vector<std::uint64_t>& of_face(const Shape& shape, std::vector<glm::dvec3>& ring) {
    keys_.clear();
    corners_.clear();
    restore_corners(shape, ring);
    for (const glm::dvec3& point : ring) corners_.push_back(corner_at(point));
    if (!ring.empty()) {
      add_ring(corners_.size(), [](std::size_t k) { return k; });
    } else if (shape.geometry == box_geometry) {
      of_body(shape);
    } else {
      add_points(shape);
      add_loops(shape);
    }
    std::uint64_t face = 0;
    for (const std::uint64_t corner : corners_) face += mix(corner);
    keys_.push_back(mix(face) | 1U);
    return keys_;
  }

 private:
  std::uint64_t corner_at(const glm::dvec3& point) const {
    const glm::dvec3 cell = (point - low_) * by_cell_ + 2.5;
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = key << 21U | static_cast<std::uint64_t>(std::clamp(cell[axis], 0.0, 2e6));
    return key + 1;
  }
  glm::dvec3 place(const Shape& shape, const glm::dvec3& unit) const {
    return shape.origin + shapes_.axes[shape.axes] * (unit * shape.size);
  }
  /// Sets the corners of a ring that CoplanarRectangles moved to those of the shape. The cells of bodies beside it, which
  /// have the same corners, could differ otherwise.
  void restore_corners(const Shape& shape, std::vector<glm::dvec3>& ring) const {
    constexpr double moved = 0.2;  // cells
    for (glm::dvec3& point : ring) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at = place(shape, glm::dvec3(corner & 1U, corner >> 1U & 1U, corner >> 2U));
        const glm::dvec3 off = (at - point) * by_cell_;
        if (glm::dot(off, off) < moved * moved) {
          point = at;
          break;
        }
      }
    }
  }
  void add_edge(std::uint64_t from, std::uint64_t to) { keys_.push_back(mix(mix(from) + to) | 1U); }
  template <class Place>
  void add_ring(std::size_t count, Place&& place) {
    for (std::size_t k = 0; k < count; ++k)
      add_edge(corners_[place(k)], corners_[place(k + 1 == count ? 0 : k + 1)]);
  }

  void add_box(const Shape& shape) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const glm::dvec3 unit(corner & 1U, corner >> 1U & 1U, corner >> 2U);
      bool is_new = true;
      for (int axis = 0; axis < 3; ++axis) is_new &= shape.size[axis] != 0 || unit[axis] == 0;
      corners_.push_back(is_new ? corner_at(place(shape, unit)) : 0);
      if (is_new) keys_.push_back(corners_.back());
    }
    if (!has_edges_) return;
    for (unsigned corner = 0; corner < 8; ++corner) {
      for (const unsigned bit : {1U, 2U, 4U}) {
        const std::uint64_t from = corners_[corner], to = corners_[corner ^ bit];
        if (from != 0 && to != 0) add_edge(from, to);
      }
    }
  }

  void add_points(const Shape& shape) {
    for (const glm::dvec3& p : shapes_.solid_of(shape.geometry).points)
      corners_.push_back(corner_at(place(shape, p)));
  }
  void add_loops(const Shape& shape) {
    const Solid& solid = shapes_.solid_of(shape.geometry);
    for (const Loop& loop : solid.loops)
      add_ring(loop.count, [&](std::size_t k) { return solid.corners[loop.first + k]; });
  }
  void add_solid(const Shape& shape) {
    add_points(shape);
    keys_.insert(keys_.end(), corners_.begin(), corners_.end());
    if (has_edges_) add_loops(shape);
  }

  const Shapes& shapes_;
  glm::dvec3 low_;
  double by_cell_;
  bool has_edges_;
  std::vector<std::uint64_t> keys_, corners_;
};

}  // namespace

std::vector<std::uint8_t> layers_of(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                    const CoplanarRectangles& rectangles, const glm::dvec3& low,
                                    double diagonal, Job& job) {
  const bool has_flat =
      std::ranges::any_of(drawn, [&](std::uint32_t index) { return is_flat(shapes.shapes[index]); });
  LayerTable table(job);
  KeyMaker maker(shapes, low, diagonal, has_flat);
  std::vector<std::uint8_t> layers;
  layers.reserve(drawn.size());
  std::vector<glm::dvec3> ring;
  std::vector<std::uint64_t*> masks;
  for (const std::uint32_t index : drawn) {
    const Shape& shape = shapes.shapes[index];
    if (is_flat(shape)) rectangles.outline(layers.size(), ring);
    const std::vector<std::uint64_t>& keys =
        is_flat(shape) ? maker.of_face(shape, ring) : maker.of_body(shape);
    table.expect(keys.size());
    for (const std::uint64_t key : keys) table.fetch(key);
    std::uint64_t taken = 0;
    masks.clear();
    for (const std::uint64_t key : keys) {
      masks.push_back(&table.layers(key));
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
