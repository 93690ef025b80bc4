#include "core/generators/world/area.h"

namespace seedmesh::world {
namespace {

/// The roughness of the samples first to last of a row.
Roughness rough_of(const LandRow& land, std::size_t first, std::size_t last) {
  const auto greatest = [&](const std::vector<float>& all) {
    float most = 0;
    for (std::size_t k = first; k <= last; ++k) most = std::max(most, all[k]);
    return static_cast<double>(most);
  };
  Roughness rough;
  rough.ruggedness = greatest(land.ruggedness);
  for (std::size_t n = 0; n < land.ridges.size(); ++n) rough.ridges[n] = greatest(land.ridges[n]);
  for (std::size_t k = first; k <= last; ++k)
    rough.has_sea_floor |= static_cast<double>(land.coast[k]) < sea_floor_coast;
  return rough;
}

}  // namespace

void Area::add(const GroundSample& sample, const std::array<bool, 4>& is_border) {
  low = std::min(low, sample.height);
  high = std::max(high, sample.height);
  rough.add(sample);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!is_border[k]) continue;
    borders[k] = std::min(borders[k], sample.height);
    border_rough[k].add(sample);
  }
}

void Area::add(const Area& row, bool is_south_border, bool is_north_border) {
  low = std::min(low, row.low);
  high = std::max(high, row.high);
  rough.add(row.rough);
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}}) {
    borders[k] = std::min(borders[k], row.borders[k]);
    border_rough[k].add(row.border_rough[k]);
  }
  if (is_south_border) {
    borders[1] = row.low;
    border_rough[1].add(row.rough);
  }
  if (is_north_border) {
    borders[3] = row.low;
    border_rough[3].add(row.rough);
  }
}

Roughness Area::rough_border() const {
  Roughness all;
  for (const Roughness& border : border_rough) all.add(border);
  all.works = std::max(all.works, rough.works);
  if (!has_valleys) {
    all.slope = rough.slope;
    all.valley = rough.valley;
  }
  return all;
}

Area area_of_row(const LandRow& land, std::size_t first, std::size_t last) {
  Area row;
  const auto at = [&](std::size_t k) { return land.height.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto [low, high] = std::minmax_element(at(first), at(last + 1));
  row.low = static_cast<double>(*low);
  row.high = static_cast<double>(*high);
  row.borders[0] = static_cast<double>(land.height[first]);
  row.borders[2] = static_cast<double>(land.height[last]);
  row.rough = rough_of(land, first, last);
  row.border_rough[0] = rough_of(land, first, first);
  row.border_rough[2] = rough_of(land, last, last);
  return row;
}

Area joined(const Area& sw, const Area& se, const Area& nw, const Area& ne) {
  Area all = sw;
  all.rough.mesh_deviation = {};
  for (const Area* area : {&se, &nw, &ne}) {
    all.low = std::min(all.low, area->low);
    all.high = std::max(all.high, area->high);
    all.lowest = std::min(all.lowest, area->lowest);
    all.rough.add(area->rough);
    all.plant_height = std::max(all.plant_height, area->plant_height);
    all.plant_top = std::max(all.plant_top, area->plant_top);
  }
  const std::array<std::array<const Area*, 2>, 4> beside{{{&sw, &nw}, {&sw, &se}, {&se, &ne}, {&nw, &ne}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& [a, b] = beside[k];
    all.borders[k] = std::min(a->borders[k], b->borders[k]);
    all.border_cuts[k] = std::min(a->border_cuts[k], b->border_cuts[k]);
    all.border_rough[k] = a->border_rough[k];
    all.border_rough[k].add(b->border_rough[k]);
  }
  return all;
}

}  // namespace seedmesh::world
