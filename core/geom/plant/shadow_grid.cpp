#include "core/geom/plant/shadow_grid.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

// Whole numbers in a shade of 1. A cell can store 65,535 times that.
constexpr double whole = 65536;
// Cells beyond these count as the outermost ones, so that the number of cells fits into 64 bits.
constexpr double farthest = 1e5;
// The grid grows by at least this number of cells, and by this share of its size.
constexpr std::int32_t least_growth = 8, growth_share = 4;

}  // namespace

ShadowGrid::ShadowGrid(const ShadowOptions& options, const Job& job) : cell_(options.cell), shade_(job) {
  double amount = options.shade;
  for (int layer = 0; layer <= options.layers; ++layer, amount /= options.falloff)
    amounts_.push_back(amount * whole);
}

ShadowGrid::Cell ShadowGrid::cell_of(const glm::dvec3& point) const {
  // The floor of a number in this range, without a call; 0 if it is no number.
  const auto along = [&](double x) {
    const double at = std::clamp(x / cell_, -farthest, farthest);
    const std::int32_t towards_zero = at == at ? static_cast<std::int32_t>(at) : 0;
    return towards_zero - (at < towards_zero ? 1 : 0);
  };
  return {along(point.x), along(point.y), along(point.z)};
}

bool ShadowGrid::contains(const Cell& low, const Cell& high) const {
  const auto inside = [](std::int32_t from, std::int32_t until, std::int32_t first, std::int32_t size) {
    return from >= first && until - first < size;
  };
  return inside(low.x, high.x, range_.low.x, range_.size.x) &&
         inside(low.y, high.y, range_.low.y, range_.size.y) &&
         inside(low.z, high.z, range_.low.z, range_.size.z);
}

std::size_t ShadowGrid::index_of(const Cell& cell) const {
  const auto x = static_cast<std::size_t>(cell.x - range_.low.x);
  const auto y = static_cast<std::size_t>(cell.y - range_.low.y);
  const auto z = static_cast<std::size_t>(cell.z - range_.low.z);
  return (x * static_cast<std::size_t>(range_.size.y) + y) * static_cast<std::size_t>(range_.size.z) + z;
}

void ShadowGrid::extend(const Cell& low, const Cell& high) {
  const Range before = range_;
  const auto widen = [&](std::int32_t& first, std::int32_t& size, std::int32_t from, std::int32_t until) {
    const std::int32_t margin = std::max(least_growth, size / growth_share);
    const std::int32_t last = size == 0 ? until + margin : first + size - 1;
    const std::int32_t start = size == 0 ? from - margin : first;
    first = from < start ? from - margin : start;
    size = (until > last ? until + margin : last) - first + 1;
  };
  widen(range_.low.x, range_.size.x, low.x, high.x);
  widen(range_.low.y, range_.size.y, low.y, high.y);
  widen(range_.low.z, range_.size.z, low.z, high.z);
  const auto cells = [](const Cell& size) {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  };
  Array<std::uint32_t> wider = shade_.empty_array_of<std::uint32_t>();
  wider.resize(cells(range_.size));
  std::fill(wider.begin(), wider.end(), 0U);
  for (std::int32_t x = 0; x < before.size.x; ++x) {
    for (std::int32_t y = 0; y < before.size.y; ++y) {
      const auto row = (static_cast<std::size_t>(x) * static_cast<std::size_t>(before.size.y) +
                        static_cast<std::size_t>(y)) *
                       static_cast<std::size_t>(before.size.z);
      std::copy_n(shade_.begin() + row, before.size.z,
                  wider.begin() + index_of({before.low.x + x, before.low.y + y, before.low.z}));
    }
  }
  shade_ = std::move(wider);
}

void ShadowGrid::cast(const Cell& cell, double weight, std::uint32_t sign) {
  const auto depth = static_cast<std::int32_t>(amounts_.size()) - 1;
  const Cell low{cell.x - depth, cell.y - depth, cell.z - depth};
  const Cell high{cell.x + depth, cell.y, cell.z + depth};
  if (!contains(low, high)) extend(low, high);
  for (std::int32_t layer = 0; layer <= depth; ++layer) {
    const double wanted = std::floor(amounts_[static_cast<std::size_t>(layer)] * weight + 0.5);
    const std::uint32_t amount = sign * static_cast<std::uint32_t>(math::to_int32(wanted));
    for (std::int32_t x = cell.x - layer; x <= cell.x + layer; ++x) {
      std::uint32_t* row = shade_.data() + index_of({x, cell.y - layer, cell.z - layer});
      for (std::int32_t i = 0; i <= 2 * layer; ++i) row[i] += amount;
    }
  }
}

void ShadowGrid::add(const glm::dvec3& point, double weight) { cast(cell_of(point), weight, 1); }

void ShadowGrid::remove(const glm::dvec3& point, double weight) {
  cast(cell_of(point), weight, ~std::uint32_t{0});
}

double ShadowGrid::shade_at(const glm::dvec3& point) const {
  const Cell cell = cell_of(point);
  return contains(cell, cell) ? shade_[index_of(cell)] / whole : 0;
}

}  // namespace seedmesh
