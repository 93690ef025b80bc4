/// Earthworks of roads, where houses stand, and fields.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/houses.h"
#include "core/generators/world/lanes.h"

namespace seedmesh::world {
namespace {

constexpr double works_reach = 56;  ///< metres from the middle of a road to untouched ground
constexpr double least_bin = 32, most_bins = 64;
constexpr double bin_margin = 48;  ///< metres around a rectangle in which plants compete

/// How far from a position roads are read.
double works_reach_of(const World& world) { return world.reach(LayerInput::works, works_reach + 16); }

/// The share of earthworks that a position allows: none at the samples of coarse tiles.
double away_from_pins(double east, double north) {
  const double x = east - works_spacing * std::floor(east / works_spacing + 0.5);
  const double y = north - works_spacing * std::floor(north / works_spacing + 0.5);
  return smooth_step(std::sqrt(x * x + y * y), 4, 40);
}

double distance_to(const RoadPiece& piece, double east, double north, double& share) {
  const double x = piece.to_east - piece.from_east, y = piece.to_north - piece.from_north;
  const double px = east - piece.from_east, py = north - piece.from_north, square = x * x + y * y;
  share = square > 0 ? std::clamp((px * x + py * y) / square, 0.0, 1.0) : 0;
  const double dx = px - share * x, dy = py - share * y;
  return std::sqrt(dx * dx + dy * dy);
}

constexpr double steepest_field = 0.11, least_field_moisture = 0.24;
constexpr double cleared_reach = 2.6;  ///< radii of a village up to which woods are cut
constexpr double hedge = 2.5;          ///< metres from the border of a field

/// The field around a position: a cell of the Voronoi diagram of one point in each cell of a jittered grid.
struct Field {
  double east = 0, north = 0;  ///< coordinates of its point
  std::uint64_t key = 0;
  double border = 0;  ///< about the distance of the position from the next field
};

Field field_of(const World& world, double east, double north) {
  const double size = world.params.fields.size;
  const auto column = math::to_int64(std::floor(east / size)), row = math::to_int64(std::floor(north / size));
  Field found;
  double nearest = 1e18, second = 1e18;
  for (std::int64_t y = row - 1; y <= row + 1; ++y) {
    for (std::int64_t x = column - 1; x <= column + 1; ++x) {
      Rng rng(cell_key(world.key ^ 0x4649454C44U, x, y));
      const double px = (static_cast<double>(x) + rng.uniform(0.2, 0.8)) * size,
                   py = (static_cast<double>(y) + rng.uniform(0.2, 0.8)) * size;
      const double square = (px - east) * (px - east) + (py - north) * (py - north);
      if (square < nearest) {
        second = nearest;
        nearest = square;
        found = {px, py, rng.key(), 0};
      } else {
        second = std::min(second, square);
      }
    }
  }
  found.border = (std::sqrt(second) - std::sqrt(nearest)) / 2;
  return found;
}

}  // namespace

Ground Ground::with_roads(const World& world, const Rectangle& box, Job& job) {
  Ground ground(world, box, job);
  const WorldFields& fields = world.params.fields;
  const double around = std::max(cleared_reach, fields.reach) * greatest_radius(world) + 2 * fields.size;
  for (const auto& site : sites_near(world, box, world.reach(LayerInput::fields, around), job))
    ground.farmland_.push_back({site->east, site->north, site->radius, site->is_town});
  const double reach = works_reach_of(world);
  for (const auto& road : roads_near(world, box, reach, job))
    ground.add_pieces(box, reach, road->points, road->width);
  for (const auto& lanes : lanes_near(world, box, reach, job)) {
    for (const Lane& lane : lanes->lanes) ground.add_pieces(box, reach, lane.points, lane.width);
  }
  ground.sort_pieces(box);
  return ground;
}

Ground Ground::with_main_roads(const World& world, const Rectangle& box, Job& job) {
  Ground ground(world, box, job);
  const double reach = works_reach_of(world);
  for (const auto& road : roads_near(world, box, reach, job))
    ground.add_pieces(box, reach, road->points, road->width);
  ground.sort_pieces(box);
  return ground;
}

void Ground::add_pieces(const Rectangle& box, double reach, const std::vector<RoadPoint>& points,
                        double width) {
  for (std::size_t k = 1; k < points.size(); ++k) {
    const RoadPoint &a = points[k - 1], &b = points[k];
    if (std::min(a.east, b.east) > box.east + reach || std::max(a.east, b.east) < box.west - reach ||
        std::min(a.north, b.north) > box.north + reach || std::max(a.north, b.north) < box.south - reach) {
      continue;
    }
    pieces_.push_back({a.east, a.north, a.height, b.east, b.north, b.height, width,
                       a.is_bridge || b.is_bridge, a.works, b.works});
  }
}

void Ground::sort_pieces(const Rectangle& box) {
  const double side = std::max(box.east - box.west, box.north - box.south) + 2 * bin_margin;
  bins_.west = box.west - bin_margin;
  bins_.south = box.south - bin_margin;
  bins_.cell = std::max(least_bin, side / most_bins);
  bins_.count = math::to_int32(side / bins_.cell) + 1;
  const auto count = static_cast<std::size_t>(bins_.count);
  bins_.pieces.assign(count * count, {});
  for (std::uint32_t n = 0; n < pieces_.size(); ++n) {
    const RoadPiece& p = pieces_[n];
    const std::size_t west = bins_.cell_of(std::min(p.from_east, p.to_east) - works_reach - bins_.west),
                      east = bins_.cell_of(std::max(p.from_east, p.to_east) + works_reach - bins_.west),
                      south = bins_.cell_of(std::min(p.from_north, p.to_north) - works_reach - bins_.south),
                      north = bins_.cell_of(std::max(p.from_north, p.to_north) + works_reach - bins_.south);
    for (std::size_t row = south; row <= north; ++row) {
      for (std::size_t column = west; column <= east; ++column)
        bins_.pieces[row * count + column].push_back(n);
    }
  }
}

std::size_t Ground::Bins::cell_of(double away) const {
  return static_cast<std::size_t>(math::to_int32(std::clamp(std::floor(away / cell), 0.0, count - 1.0)));
}

const std::vector<std::uint32_t>& Ground::pieces_at(double east, double north) const {
  return bins_.pieces[bins_.cell_of(north - bins_.south) * static_cast<std::size_t>(bins_.count) +
                      bins_.cell_of(east - bins_.west)];
}

Ground Ground::with_works(const World& world, const Rectangle& box, Job& job) {
  Ground ground = with_roads(world, box, job);
  for (const House& house : houses_near(world, box, 2 * house_extent(world).across, job)) {
    ground.houses_.push_back({house.east, house.north, std::max(house.length, house.depth)});
  }
  return ground;
}

void Ground::add_works(GroundSample& sample, double east, double north) const {
  double weight = 0, level = 0, half = 0, nearest = 1e12;
  for (const std::uint32_t n : pieces_at(east, north)) {
    const RoadPiece& piece = pieces_[n];
    double share = 0;
    const double away = distance_to(piece, east, north, share);
    sample.road = std::min(sample.road, away - piece.width / 2);
    if (piece.is_bridge || away >= works_reach) continue;
    nearest = std::min(nearest, away);
    const double left = 1 - away / works_reach, square = away * away + 4;
    const double w = left * left / (square * square);
    weight += w;
    level += w * (piece.from_height + share * (piece.to_height - piece.from_height));
    half += w * piece.width / 2;
  }
  for (const HouseMark& house : houses_) {
    const double x = east - house.east, y = north - house.north;
    sample.house = std::min(sample.house, std::sqrt(x * x + y * y) - house.radius);
  }
  if (weight <= 0) return;
  const double height = level / weight - 0.05, edge = half / weight + 2.5;
  const double shoulder = std::min(works_reach - 1 - edge, 6 + 2.5 * std::abs(height - sample.height));
  const double share = (1 - smooth_step(nearest, edge, edge + shoulder)) * away_from_pins(east, north) *
                       smooth_step(sample.shore, 1, 9);
  sample.works = std::abs(share * (height - sample.height));
  sample.height += share * (height - sample.height);
}

void Ground::add_field(GroundSample& sample, double east, double north) const {
  const WorldFields& fields = world_->params.fields;
  for (const Farmland& farm : farmland_) {
    const double x = east - farm.east, y = north - farm.north, square = x * x + y * y;
    const double most = cleared_reach * farm.radius;
    if (square >= most * most) continue;
    sample.settled = std::max(sample.settled, 1 - smooth_step(std::sqrt(square), 0.4 * most, most));
    sample.is_town |= farm.is_town && square < farm.radius * farm.radius;
  }
  const Slope& h = sample.land.height;
  if (h.east * h.east + h.north * h.north > steepest_field * steepest_field || sample.shore < 15 ||
      sample.road < 3 || sample.house < 6) {
    return;
  }
  if (world_->params.relief.sea && sample.height < world_->params.relief.sea_level + 2.5) return;
  if (fields.share <= 0 || fields.reach <= 0 || sample.is_town) return;
  for (const Farmland& farm : farmland_) {
    const double most = fields.reach * farm.radius;
    const double x = east - farm.east, y = north - farm.north, far = most + 2 * fields.size;
    if (x * x + y * y > far * far) continue;
    const Field field = field_of(*world_, east, north);
    const double dx = field.east - farm.east, dy = field.north - farm.north,
                 away = std::sqrt(dx * dx + dy * dy);
    Rng rng(field.key);
    const double share = fields.share * (1 - smooth_step(away, 0.5 * most, most)) *
                         smooth_step(away, 0.3 * farm.radius, 0.7 * farm.radius);
    if (rng.unit() >= share ||
        climate_at(*world_, field.east, field.north, sample.height).moisture < least_field_moisture)
      continue;
    sample.field = static_cast<int>(rng.unit() * static_cast<double>(fields.colors.size()));
    sample.is_hedge = field.border < hedge;
    return;
  }
}

}  // namespace seedmesh::world
