#include "core/generators/world/areas.h"

#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/lanes.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {
namespace {

constexpr double highest_lift = 2.5;           ///< metres that rivers lie above their water
constexpr double widest_measured_works = 512;  ///< metres; wider tiles allow for roads without knowing them
constexpr double widest_known_rivers = 8192;
constexpr double works_reach = 56;  ///< metres from a road to untouched ground

/// Finds the areas of the links of a block.
class AreaFinder {
 public:
  AreaFinder(const World& world, const TileKey& root, int depth, Job& job)
      : world_(world), job_(job), frame_(frame_of(world, root)), count_(1 << depth) {
    side_ = frame_.side / count_;
    cells_ = cells_a_link(world, root.level);
    spacing_ = side_ / cells_;
    for (const WorldClass& plant : world.params.plants)
      tallest_class_ = std::max(tallest_class_, plant.height);
    areas_.resize(static_cast<std::size_t>(count_) * static_cast<std::size_t>(count_));
    const auto samples = static_cast<std::size_t>(count_ * cells_ + 1);
    heights_.resize(samples * samples);
    if (spacing_ >= coarse_spacing) ruggedness_.resize(samples * samples);
  }

  Areas areas() {
    add_samples();
    if (spacing_ < coarse_spacing) add_deviations();
    if (side_ <= widest_known_rivers) {
      add_water();
    } else {
      guess_water();
    }
    const bool has_sites = world_.params.settlements.density > 0;
    if (has_sites && side_ <= widest_measured_works) {
      add_roads();
      add_houses();
    } else if (has_sites) {
      guess_works();
    }
    const bool is_coarse = spacing_ >= coarse_spacing;
    Areas found{std::move(areas_), spacing_, {}, !is_coarse || side_ <= widest_known_rivers, !is_coarse};
    for (int d = 0; (1 << d) < count_; ++d) found.deviations.push_back(deviations(d));
    return found;
  }

 private:
  Area& at(int column, int row) { return areas_[static_cast<std::size_t>(row * count_ + column)]; }
  Rectangle box() const {
    return {frame_.west, frame_.south, frame_.west + frame_.side, frame_.south + frame_.side};
  }

  /// Calls `visit` with the areas within `reach` of a rectangle.
  template <class Visit>
  void for_areas(const Rectangle& r, double reach, const Visit& visit) {
    const auto index = [&](double v) {
      return math::to_int32(std::clamp(std::floor(v / side_), -1.0, 1.0 * count_));
    };
    const int west = std::max(0, index(r.west - reach - frame_.west)),
              east = std::min(count_ - 1, index(r.east + reach - frame_.west));
    const int south = std::max(0, index(r.south - reach - frame_.south)),
              north = std::min(count_ - 1, index(r.north + reach - frame_.south));
    for (int row = south; row <= north; ++row) {
      for (int column = west; column <= east; ++column) visit(at(column, row));
    }
  }

  void add_samples() {
    const int last = count_ * cells_;
    const bool is_coarse = spacing_ >= coarse_spacing, has_works = side_ <= widest_measured_works;
    const int step = std::clamp(static_cast<int>(2048 / spacing_), 1, last + 1);
    for (int row = 0; row <= last; row += step) {
      job_.check();
      for (int column = 0; column <= last; column += step) {
        const int last_row = std::min(row + step - 1, last), last_column = std::min(column + step - 1, last);
        const Rectangle part{frame_.west + column * spacing_, frame_.south + row * spacing_,
                             frame_.west + last_column * spacing_, frame_.south + last_row * spacing_};
        const Ground ground = is_coarse   ? Ground(world_)
                              : has_works ? Ground::with_roads(world_, part, job_)
                                          : Ground(world_, part, job_);
        for (int j = row; j <= last_row; ++j) {
          job_.check();
          for (int i = column; i <= last_column; ++i) add_sample(ground, i, j);
        }
      }
    }
  }

  void add_sample(const Ground& ground, int i, int j) {
    const double east = frame_.west + i * spacing_, north = frame_.south + j * spacing_;
    GroundSample sample;
    if (spacing_ >= coarse_spacing) {
      sample.land = land_at(world_, east, north);
      sample.height = sample.land.height.value;
      ruggedness_[index_of(i, j)] = static_cast<float>(sample.land.ruggedness);
    } else {
      sample = ground.at(east, north);
    }
    heights_[index_of(i, j)] = sample.height;
    const auto tile = [&](int k) { return std::min(k / cells_, count_ - 1); };
    const auto is_low = [this](int k) { return k % cells_ == 0; };
    const int last = count_ * cells_;
    double tallest = -1;
    for (int row = tile(j); row >= std::max(0, tile(j) - (is_low(j) && j < last ? 1 : 0)); --row) {
      for (int column = tile(i); column >= std::max(0, tile(i) - (is_low(i) && i < last ? 1 : 0)); --column) {
        Area& area = at(column, row);
        area.low = std::min(area.low, sample.height);
        area.high = std::max(area.high, sample.height);
        const std::array<bool, 4> is_border{i == column * cells_, j == row * cells_,
                                            i == (column + 1) * cells_, j == (row + 1) * cells_};
        for (std::size_t k = 0; k < 4; ++k) {
          if (is_border[k]) area.borders[k] = std::min(area.borders[k], sample.height);
        }
        area.rough.add(sample);
        if (!world_.has(Layer::plants) || area.plant_height >= tallest_class_) continue;
        if (tallest < 0) tallest = tallest_growing(sample, east, north);
        area.plant_height = std::max(area.plant_height, tallest);
      }
    }
  }

  double height(int i, int j) const { return heights_[index_of(i, j)]; }

  /// The greatest distances of the samples from the triangles of the tiles at a depth.
  std::vector<double> deviations(int depth) {
    const int tiles = 1 << depth, wide = count_ / tiles * cells_, stride = wide / tile_cells;
    if (stride < 2 || wide % tile_cells != 0) return {};
    std::vector<double> found;
    for (int row = 0; row < tiles; ++row) {
      job_.check();
      for (int column = 0; column < tiles; ++column) {
        double most = 0;
        for (int k = 0; k < tile_cells * tile_cells; ++k) {
          const int i = column * wide + k % tile_cells * stride, j = row * wide + k / tile_cells * stride;
          most = std::max(most, deviation_in_cell(i, j, stride));
        }
        found.push_back(most);
      }
    }
    return found;
  }

  /// The same in a cell of a tile, whose south-west corner is a sample.
  double deviation_in_cell(int i, int j, int stride) const {
    const double sw = height(i, j), se = height(i + stride, j), nw = height(i, j + stride),
                 ne = height(i + stride, j + stride);
    double most = 0;
    for (int y = 0; y <= stride; ++y) {
      for (int x = 0; x <= stride; ++x) {
        const double plane = x >= y ? stride * sw + x * (se - sw) + y * (ne - se)
                                    : stride * sw + x * (ne - nw) + y * (nw - sw);
        most = std::max(most, std::abs(height(i + x, j + y) - plane / stride));
      }
    }
    const double steep = std::max(std::abs(ne - sw), std::abs(se - nw)) / (2.83 * stride * spacing_);
    return most / std::sqrt(1 + steep * steep);
  }

  /// Measures how far samples are from triangles through every other of them.
  void add_deviations() {
    const int last = count_ * cells_;
    for (int j = 0; j < last; j += 2) {
      for (int i = 0; i < last; i += 2) {
        const double sw = height(i, j), se = height(i + 2, j), nw = height(i, j + 2),
                     ne = height(i + 2, j + 2);
        const double off = std::max(
            {std::abs(height(i + 1, j) - (sw + se) / 2), std::abs(height(i, j + 1) - (sw + nw) / 2),
             std::abs(height(i + 1, j + 1) - (sw + ne) / 2), std::abs(height(i + 2, j + 1) - (se + ne) / 2),
             std::abs(height(i + 1, j + 2) - (nw + ne) / 2)});
        Roughness& rough = at(i / cells_, j / cells_).rough;
        const double steep = std::max(std::abs(ne - sw), std::abs(se - nw)) / (2 * 2.83 * spacing_);
        rough.measured = std::max(rough.measured, off / std::sqrt(1 + steep * steep));
        rough.measured_spacing = 2 * spacing_;
      }
    }
  }

  double tallest_growing(const GroundSample& sample, double east, double north) const {
    double tallest = 0;
    for (const WorldClass& plant : world_.params.plants) {
      if (plant.height > tallest && may_grow(world_, plant, sample, east, north, spacing_))
        tallest = plant.height;
    }
    return tallest;
  }

  std::size_t index_of(int i, int j) const { return static_cast<std::size_t>(j * (count_ * cells_ + 1) + i); }

  /// Calls `visit` with the samples within `reach` of a rectangle and with their positions.
  template <class Visit>
  void for_samples(const Rectangle& r, double reach, const Visit& visit) {
    const double last = count_ * cells_;
    const auto index = [&](double v) {
      return math::to_int32(std::clamp(std::floor(v / spacing_), -1.0, last));
    };
    const int west = index(r.west - reach - frame_.west) + 1, east = index(r.east + reach - frame_.west);
    const int south = index(r.south - reach - frame_.south) + 1,
              north = index(r.north + reach - frame_.south);
    for (int j = south; j <= north; ++j) {
      for (int i = west; i <= east; ++i)
        visit(index_of(i, j), frame_.west + i * spacing_, frame_.south + j * spacing_);
    }
  }

  /// Lowers samples of the land to the valleys of rivers and lakes, which reach `wide` metres.
  void carve(const Reach& reach, const Rectangle& around, double wide, const std::vector<double>& land) {
    const RiverPoint &a = reach.from, &b = reach.to;
    for_samples(around, wide, [&](std::size_t n, double east, double north) {
      const double x = east - a.east, y = north - a.north;
      const double share = std::clamp((x * reach.x + y * reach.y) * reach.by, 0.0, 1.0);
      const double dx = x - share * reach.x, dy = y - share * reach.y;
      const Beside beside{std::sqrt(dx * dx + dy * dy), (a.width + share * (b.width - a.width)) / 2,
                          a.water + share * (b.water - a.water)};
      heights_[n] =
          std::min(heights_[n], valley_side(land[n], static_cast<double>(ruggedness_[n]), beside).height);
    });
  }

  void carve(const Lake& lake, const Rectangle& around, const std::vector<double>& land) {
    for_samples(around, valley_reach, [&](std::size_t n, double east, double north) {
      const double x = east - lake.east, y = north - lake.north, away = std::sqrt(x * x + y * y);
      const double shore = shore_distance(lake, east, north, away), t = away / shore;
      const double height =
          t < 1 ? lake.level - lake.depth * (1 - t * t)
                : valley_side(land[n], static_cast<double>(ruggedness_[n]), {away - shore, 5, lake.level})
                      .height;
      heights_[n] = std::min(heights_[n], height);
    });
  }

  /// How deep valleys are cut into the land of each area.
  void add_cuts(const std::vector<double>& land) {
    for (int row = 0; row < count_; ++row) {
      for (int column = 0; column < count_; ++column) {
        double most = 0;
        for (int j = row * cells_; j <= (row + 1) * cells_; ++j) {
          for (int i = column * cells_; i <= (column + 1) * cells_; ++i)
            most = std::max(most, land[index_of(i, j)] - heights_[index_of(i, j)]);
        }
        double& valley = at(column, row).rough.valley;
        if (most > 0) valley = std::max(valley, most + 3);
      }
    }
  }

  void add_water() {
    const Ground water(world_, box(), job_, valley_reach);
    const bool is_coarse = spacing_ >= coarse_spacing;
    const std::vector<double> land = is_coarse ? heights_ : std::vector<double>{};
    for (const Reach& reach : water.reaches()) {
      const RiverPoint &a = reach.from, &b = reach.to;
      const Rectangle around{std::min(a.east, b.east), std::min(a.north, b.north), std::max(a.east, b.east),
                             std::max(a.north, b.north)};
      const double bed = 0.5 + 0.045 * std::max(a.width, b.width);
      // a valley that is cut deeper is wider
      const double wide = std::clamp(60 + 5 * std::max(a.cut, b.cut), 500.0, valley_reach);
      for_areas(around, is_coarse ? wide : b.width,
                [&](Area& area) { area.lowest = std::min(area.lowest, b.water - bed); });
      if (is_coarse) carve(reach, around, wide, land);
      for_areas(around, b.width, [&](Area& area) {
        area.highest = std::max(area.highest, a.water + highest_lift);
        area.rough.valley = std::max(area.rough.valley, std::max(a.cut, b.cut) + 3);
      });
    }
    for (const Lake& lake : water.lakes()) {
      const double far = 1.3 * lake.radius;
      const Rectangle around{lake.east - far, lake.north - far, lake.east + far, lake.north + far};
      for_areas(around, is_coarse ? valley_reach : 0,
                [&](Area& area) { area.lowest = std::min(area.lowest, lake.level - lake.depth); });
      if (is_coarse) carve(lake, around, land);
      for_areas(around, 0, [&](Area& area) {
        area.highest = std::max(area.highest, lake.level + 0.5);
        area.rough.valley = std::max(area.rough.valley, lake.depth);
      });
    }
    if (is_coarse) add_cuts(land);
  }

  /// Water of wide areas is not below the sea, or not below the lowest land nearby.
  void guess_water() {
    const WorldRelief& relief = world_.params.relief;
    if (relief.sea && world_.params.water.rivers <= 0) return;
    const std::vector<Area> found = areas_;
    for (int row = 0; row < count_; ++row) {
      for (int column = 0; column < count_; ++column) {
        Area& area = at(column, row);
        double floor = relief.sea_level;
        if (!relief.sea) {
          floor = area.low;
          for (int j = std::max(0, row - 1); j <= std::min(count_ - 1, row + 1); ++j) {
            for (int i = std::max(0, column - 1); i <= std::min(count_ - 1, column + 1); ++i)
              floor = std::min(floor, found[static_cast<std::size_t>(j * count_ + i)].low);
          }
        }
        area.rough.valley = 20 + 0.4 * (area.high - area.low);
        area.lowest = std::max(floor - 16, area.low - area.rough.valley);
      }
    }
  }

  void add_roads() {
    const Ground ground = Ground::with_roads(world_, box(), job_);
    for (const RoadPiece& p : ground.road_pieces()) {
      const Rectangle around{std::min(p.from_east, p.to_east), std::min(p.from_north, p.to_north),
                             std::max(p.from_east, p.to_east), std::max(p.from_north, p.to_north)};
      for_areas(around, works_reach, [&](Area& area) {
        area.lowest = std::min({area.lowest, p.from_height - 0.5, p.to_height - 0.5});
        area.highest = std::max({area.highest, p.from_height + 1, p.to_height + 1});
      });
      for_areas(around, works_reach, [&](Area& area) {
        const double works = 1.3 * std::max(p.from_works, p.to_works) + 0.5;
        area.rough.works = std::max(area.rough.works, works);
      });
    }
  }

  void add_houses() {
    for (const House& house : houses_near(world_, box(), 0, job_)) {
      for_areas({house.east, house.north, house.east, house.north}, 0, [&](Area& area) {
        area.lowest = std::min(area.lowest, house.low);
        area.highest = std::max(area.highest, house.top);
      });
    }
  }

  /// Roads follow the ground, so their works are small where the ground is level.
  void guess_works() {
    const bool knows_sites = side_ <= widest_known_rivers;
    const HouseExtent houses = house_extent(world_);
    if (knows_sites) {
      for (const auto& site : sites_near(world_, box(), farm_reach * greatest_radius(world_), job_)) {
        const double reach = farm_reach * site->radius;
        for_areas({site->east, site->north, site->east, site->north}, reach, [&](Area& area) {
          area.lowest = std::min(area.lowest, area.low - most_cellar);
          area.highest = std::max(area.highest, area.high + houses.up);
        });
      }
    }
    for (Area& area : areas_) {
      const double works = std::min(most_works, 0.2 * (area.high - area.low) + 0.5);
      if (spacing_ < coarse_spacing) area.rough.works = std::max(area.rough.works, works);
      area.lowest = std::min(area.lowest, area.low - (knows_sites ? works : std::max(works, most_cellar)));
      area.highest = std::max(area.highest, area.high + (knows_sites ? works : std::max(works, houses.up)));
    }
  }

  const World& world_;
  Job& job_;
  TileFrame frame_;
  int count_;      ///< of links along a side
  int cells_ = 0;  ///< along a link
  double side_ = 0, spacing_ = 0;
  double tallest_class_ = 0;
  std::vector<Area> areas_;
  std::vector<double> heights_;    ///< of all samples, rows from the south
  std::vector<float> ruggedness_;  ///< the same, of coarse samples
};

}  // namespace

int cells_a_link(const World& world, int root_level) {
  if (root_level == 0) return world.levels > 12 ? 48 : 16;
  return root_level == levels_a_block ? 32 : 8;
}

Areas areas_below(const World& world, const TileKey& root, int depth, Job& job) {
  return AreaFinder(world, root, depth, job).areas();
}

Area joined(const Area& sw, const Area& se, const Area& nw, const Area& ne) {
  Area all = sw;
  for (const Area* area : {&se, &nw, &ne}) {
    all.low = std::min(all.low, area->low);
    all.high = std::max(all.high, area->high);
    all.lowest = std::min(all.lowest, area->lowest);
    all.rough.add(area->rough);
    all.plant_height = std::max(all.plant_height, area->plant_height);
  }
  all.borders = {std::min(sw.borders[0], nw.borders[0]), std::min(sw.borders[1], se.borders[1]),
                 std::min(se.borders[2], ne.borders[2]), std::min(nw.borders[3], ne.borders[3])};
  return all;
}

}  // namespace seedmesh::world
