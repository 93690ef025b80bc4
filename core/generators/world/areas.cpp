#include "core/generators/world/areas.h"

#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/height_grid.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/land_rows.h"
#include "core/generators/world/lanes.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/tile_frame.h"

namespace seedmesh::world {
namespace {

constexpr double highest_lift = 2.5;           ///< metres that rivers lie above their water
constexpr double widest_measured_works = 512;  ///< metres; wider tiles allow for roads without finding them
constexpr double works_reach = 56;             ///< metres from a road to untouched ground
constexpr double plant_spacing = 400;          ///< metres
constexpr double narrowest_valley = 500;       ///< metres from water

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
    grid_ = {count_ * cells_ + 1, spacing_, frame_.west, frame_.south,
             std::vector<double>(samples * samples)};
    if (spacing_ >= coarse_spacing) ruggedness_.resize(samples * samples);
    plant_stride_ = std::clamp(static_cast<int>(plant_spacing / spacing_), 1, cells_);
  }

  Areas areas() {
    const bool is_coarse = spacing_ >= coarse_spacing;
    if (is_coarse) {
      add_land();
    } else {
      add_samples();
      add_deviations();
    }
    if (side_ <= widest_known_rivers) {
      add_water();
    } else {
      guess_water();
    }
    if (spacing_ == coarse_spacing && side_ <= widest_known_rivers) look_at_bends();
    const bool has_sites = world_.params.settlements.density > 0;
    if (has_sites && side_ <= widest_measured_works) {
      add_roads();
      add_houses();
    } else if (has_sites) {
      guess_works();
    }
    leave_out_absent_plants();
    for (Area& area : areas_) area.has_valleys = !is_coarse;
    Areas found{std::move(areas_), spacing_, {}, !is_coarse || side_ <= widest_known_rivers, !is_coarse};
    for (int d = 0; (1 << d) <= count_; ++d)
      found.deviations.push_back(deviations_of_tiles(grid_, 1 << d, job_));
    return found;
  }

 private:
  Area& at(int column, int row) { return areas_[static_cast<std::size_t>(row * count_ + column)]; }
  Rectangle box() const {
    return {frame_.west, frame_.south, frame_.west + frame_.side, frame_.south + frame_.side};
  }
  Rectangle box_of(int column, int row) const {
    const double west = frame_.west + column * side_, south = frame_.south + row * side_;
    return {west, south, west + side_, south + side_};
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

  /// Notes that the ground around a rectangle is cut, within `reach` of it. `height(away)`: the lowest height at a
  /// distance.
  template <class Height>
  void cut(const Rectangle& r, double reach, const Height& height) {
    for_areas(r, reach, [&](Area& area) {
      const auto place = static_cast<int>(&area - areas_.data());
      const Rectangle own = box_of(place % count_, place / count_);
      const std::array<double, 4> beside{r.west - own.east, r.south - own.north, own.west - r.east,
                                         own.south - r.north};
      area.lowest =
          std::min(area.lowest, height(std::max(0.0, *std::max_element(beside.begin(), beside.end()))));
      const std::array<double, 4> inside{r.west - own.west, r.south - own.south, own.east - r.east,
                                         own.north - r.north};
      for (std::size_t k = 0; k < 4; ++k) {
        if (inside[k] <= reach)
          area.border_cuts[k] = std::min(area.border_cuts[k], height(std::max(0.0, inside[k])));
      }
    });
  }

  void add_samples() {
    const int last = count_ * cells_;
    const bool has_works = side_ <= widest_measured_works;
    const int step = std::clamp(static_cast<int>(2048 / spacing_), 1, last + 1);
    for (int row = 0; row <= last; row += step) {
      job_.check();
      for (int column = 0; column <= last; column += step) {
        const int last_row = std::min(row + step - 1, last), last_column = std::min(column + step - 1, last);
        const Rectangle part{frame_.west + column * spacing_, frame_.south + row * spacing_,
                             frame_.west + last_column * spacing_, frame_.south + last_row * spacing_};
        const Ground ground = has_works ? Ground::with_roads(world_, part, job_) : Ground(world_, part, job_);
        for (int j = row; j <= last_row; ++j) {
          job_.check();
          for (int i = column; i <= last_column; ++i)
            add_sample(ground.at(frame_.west + i * spacing_, frame_.south + j * spacing_), i, j);
        }
      }
    }
  }

  /// Calls `visit` with the areas that have a sample, and with the column and the row of each.
  template <class Visit>
  void for_areas_of(int i, int j, const Visit& visit) {
    const auto tile = [&](int k) { return std::min(k / cells_, count_ - 1); };
    const auto first = [&](int k) {
      return std::max(0, tile(k) - (k % cells_ == 0 && k < count_ * cells_ ? 1 : 0));
    };
    for (int row = first(j); row <= tile(j); ++row) {
      for (int column = first(i); column <= tile(i); ++column) visit(at(column, row), column, row);
    }
  }

  void add_sample(const GroundSample& sample, int i, int j) {
    grid_.heights[grid_.index_of(i, j)] = sample.height;
    for_areas_of(i, j, [&](Area& area, int column, int row) {
      const std::array<bool, 4> is_border{i == column * cells_, j == row * cells_, i == (column + 1) * cells_,
                                          j == (row + 1) * cells_};
      area.add(sample, is_border);
    });
    add_plants(sample, i, j);
  }

  /// Finds which plants may grow, at the samples that are at most `plant_spacing` apart.
  void add_plants(const GroundSample& sample, int i, int j) {
    if (!world_.has(Layer::plants) || i % plant_stride_ != 0 || j % plant_stride_ != 0) return;
    double tallest = -1;
    for_areas_of(i, j, [&](Area& area, int, int) {
      if (area.plant_height >= tallest_class_) return;
      const double east = frame_.west + i * spacing_, north = frame_.south + j * spacing_;
      if (tallest < 0) tallest = tallest_growing(world_, sample, east, north, plant_stride_ * spacing_);
      area.plant_height = std::max(area.plant_height, tallest);
    });
  }

  /// Samples of the land alone.
  void add_land() {
    const int last = count_ * cells_;
    LandRow land;
    for (int j = 0; j <= last; ++j) {
      if (j % 16 == 0) job_.check();
      land_of_row(world_,
                  {frame_.west, frame_.south + j * spacing_, spacing_, static_cast<std::size_t>(last + 1)},
                  land);
      const std::size_t first = grid_.index_of(0, j);
      for (std::size_t k = 0; k < land.height.size(); ++k) {
        grid_.heights[first + k] = static_cast<double>(land.height[k]);
        ruggedness_[first + k] = land.ruggedness[k];
      }
      for (int column = 0; column < count_; ++column) {
        const auto west = static_cast<std::size_t>(column * cells_);
        add_to_areas(area_of_row(land, west, west + static_cast<std::size_t>(cells_)), column, j);
      }
      for (int i = 0; j % plant_stride_ == 0 && i <= last; i += plant_stride_) {
        GroundSample sample;
        sample.height = grid_.at(i, j);
        add_plants(sample, i, j);
      }
    }
    for (int row = 0; row < count_; ++row) {
      for (int column = 0; column < count_; ++column)
        at(column, row).rough.slope = greatest_slope(grid_, column * cells_, row * cells_, cells_);
    }
  }

  void add_to_areas(const Area& part, int column, int j) {
    const int last_row = std::min(j / cells_, count_ - 1);
    for (int row = std::max(0, last_row - (j % cells_ == 0 ? 1 : 0)); row <= last_row; ++row) {
      if (j > (row + 1) * cells_) continue;
      at(column, row).add(part, j == row * cells_, j == (row + 1) * cells_);
    }
  }

  /// Measures how far samples are from triangles through every other of them.
  void add_deviations() {
    for (int j = 0; j + 1 < grid_.samples; j += 2) {
      for (int i = 0; i + 1 < grid_.samples; i += 2) {
        Roughness& rough = at(i / cells_, j / cells_).rough;
        rough.measured = std::max(rough.measured, deviation_over_cells(grid_, i, j));
        rough.measured_spacing = 2 * spacing_;
      }
    }
  }

  /// Compares the ground itself with triangles, in the cells of each area where the land bends most.
  void look_at_bends() {
    for (int k = 0; k < count_ * count_; ++k) {
      job_.check();
      const int row = k / count_, column = k % count_;
      const Ground ground(world_, box_of(column, row), job_);
      Roughness& rough = at(column, row).rough;
      rough.measured_spacing = spacing_;
      for (const auto& [i, j] : most_bent_cells(grid_, column * cells_, row * cells_, cells_))
        rough.measured = std::max(rough.measured, deviation_of_ground(grid_, ground, i, j));
    }
  }

  /// Of the classes that may grow by climate, others exclude heights, and small tiles often have no plant of rare ones.
  void leave_out_absent_plants() {
    const std::vector<double> tops = plant_tops(world_);
    for (int k = 0; k < count_ * count_; ++k) {
      job_.check();
      Area& area = at(k % count_, k / count_);
      // between samples, the ground differs by less than their distance
      const Growth growth{std::min(area.low, area.lowest) - spacing_,
                          std::max(area.high, area.highest) + spacing_, area.plant_height,
                          spacing_ >= coarse_spacing && area.rough.river > 0};
      const auto [height, top] = plants_present(world_, growth, tops, box_of(k % count_, k / count_));
      area.plant_height = height, area.plant_top = top;
    }
  }

  /// How deep valleys are cut into the land of each area.
  void add_cuts(const std::vector<double>& land) {
    for (int row = 0; row < count_; ++row) {
      for (int column = 0; column < count_; ++column) {
        double most = 0;
        for (int j = row * cells_; j <= (row + 1) * cells_; ++j) {
          for (int i = column * cells_; i <= (column + 1) * cells_; ++i)
            most = std::max(most, land[grid_.index_of(i, j)] - grid_.at(i, j));
        }
        double& valley = at(column, row).rough.valley;
        if (most > 0) valley = std::max(valley, most + 3);
      }
    }
  }

  void add_water() {
    const Ground water(world_, box(), job_, valley_reach);
    const bool is_coarse = spacing_ >= coarse_spacing;
    const std::vector<double> heights = is_coarse ? grid_.heights : std::vector<double>{};
    const UncutLand land{heights, ruggedness_};
    for (const Reach& reach : water.reaches()) {
      const RiverPoint &a = reach.from, &b = reach.to;
      const Rectangle around{std::min(a.east, b.east), std::min(a.north, b.north), std::max(a.east, b.east),
                             std::max(a.north, b.north)};
      const double bed = 0.5 + 0.045 * std::max(a.width, b.width);
      // a valley that is cut deeper is wider
      const double wide = std::clamp(60 + 5 * std::max(a.cut, b.cut), narrowest_valley, valley_reach);
      const double half = std::max(a.width, b.width) / 2;
      cut(around, is_coarse ? valley_reach : b.width, [&](double away) {
        return away <= wide ? b.water - bed : lowest_side({away, half, b.water});
      });
      if (is_coarse) {
        // farther away, valleys cut only land that is higher than this
        const double least = lowest_side({wide, half, b.water});
        bool is_high = false;
        for_areas(around, valley_reach, [&](const Area& area) { is_high |= area.high > least; });
        carve(grid_, land, reach, {wide, is_high ? valley_reach : wide, least});
      }
      for_areas(around, b.width, [&](Area& area) {
        area.highest = std::max(area.highest, a.water + highest_lift);
        area.rough.valley = std::max(area.rough.valley, std::max(a.cut, b.cut) + 3);
        area.rough.river = std::max(area.rough.river, std::max(a.width, b.width) / 2);
      });
    }
    for (const Lake& lake : water.lakes()) {
      const double far = 1.3 * lake.radius;
      const Rectangle around{lake.east - far, lake.north - far, lake.east + far, lake.north + far};
      cut(around, is_coarse ? valley_reach : 0, [&](double away) {
        return away <= narrowest_valley ? lake.level - lake.depth : lowest_side({away, 5, lake.level});
      });
      if (is_coarse) carve(grid_, land, lake);
      for_areas(around, 0, [&](Area& area) {
        area.highest = std::max(area.highest, lake.level + 0.5);
        area.rough.valley = std::max(area.rough.valley, lake.depth);
      });
    }
    if (is_coarse) add_cuts(heights);
  }

  /// Water of wide areas is not below the sea, or not below the lowest land nearby.
  void guess_water() {
    const WorldRelief& relief = world_.params.relief;
    if (relief.sea && world_.params.water.rivers <= 0) return;
    const std::vector<Area> found = areas_;
    for (int row = 0; row < count_; ++row) {
      for (int column = 0; column < count_; ++column) {
        Area& area = at(column, row);
        double low = area.low, high = area.high;  // of the squares around
        for (int j = std::max(0, row - 1); j <= std::min(count_ - 1, row + 1); ++j) {
          for (int i = std::max(0, column - 1); i <= std::min(count_ - 1, column + 1); ++i) {
            low = std::min(low, found[static_cast<std::size_t>(j * count_ + i)].low);
            high = std::max(high, found[static_cast<std::size_t>(j * count_ + i)].high);
          }
        }
        const double floor = (relief.sea ? relief.sea_level : low) - 16;
        area.rough.valley = guessed_valley(area.high - area.low);
        area.lowest = std::max(floor, area.low - area.rough.valley);
        area.border_cuts.fill(std::max(floor, area.low - guessed_valley(high - low)));
      }
    }
  }

  void add_roads() {
    const Ground ground = Ground::with_roads(world_, box(), job_);
    for (const RoadPiece& p : ground.road_pieces()) {
      const Rectangle around{std::min(p.from_east, p.to_east), std::min(p.from_north, p.to_north),
                             std::max(p.from_east, p.to_east), std::max(p.from_north, p.to_north)};
      cut(around, works_reach, [&](double) { return std::min(p.from_height, p.to_height) - 0.5; });
      for_areas(around, works_reach, [&](Area& area) {
        area.highest = std::max({area.highest, p.from_height + 1, p.to_height + 1});
        area.rough.works = std::max(area.rough.works, 1.3 * std::max(p.from_works, p.to_works) + 0.5);
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
    const auto sink = [](Area& area, double by) {
      area.lowest = std::min(area.lowest, area.low - by);
      for (std::size_t k = 0; k < 4; ++k)
        area.border_cuts[k] = std::min(area.border_cuts[k], area.borders[k] - by);
    };
    const HouseExtent houses = house_extent(world_);  // also covers the ground of streets and yards
    if (knows_sites) {
      for (const auto& site : sites_near(world_, box(), farm_reach * greatest_radius(world_), job_)) {
        const double reach = farm_reach * site->radius;
        for_areas({site->east, site->north, site->east, site->north}, reach, [&](Area& area) {
          sink(area, most_cellar);
          area.highest = std::max(area.highest, area.high + houses.up);
        });
      }
    }
    for (Area& area : areas_) {
      const double works = std::min(most_works, 0.2 * (area.high - area.low) + 0.5);
      if (spacing_ < coarse_spacing) area.rough.works = std::max(area.rough.works, works);
      sink(area, knows_sites ? works : std::max(works, most_cellar));
      area.highest = std::max(area.highest, area.high + (knows_sites ? works : std::max(works, houses.up)));
    }
  }

  const World& world_;
  Job& job_;
  TileFrame frame_;
  int count_, cells_ = 0;  ///< links along a side, cells along a link
  double side_ = 0, spacing_ = 0;
  int plant_stride_ = 1;  ///< samples between two at which plants are searched
  double tallest_class_ = 0;
  std::vector<Area> areas_;
  HeightGrid grid_;                ///< all samples
  std::vector<float> ruggedness_;  ///< ruggedness of coarse samples, in the same order
};

}  // namespace

double spacing_of_areas(const World& world, int level) {
  const int root = level == 0 ? 0 : (level - 1) / levels_a_block * levels_a_block;
  const int links = std::min(root + levels_a_block, world.levels - 1);
  return world.extent / static_cast<double>(std::int64_t{1} << links) / cells_a_link(world, root);
}

Areas areas_below(const World& world, const TileKey& root, int depth, Job& job) {
  return AreaFinder(world, root, depth, job).areas();
}

}  // namespace seedmesh::world
