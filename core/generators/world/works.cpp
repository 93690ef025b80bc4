/// Earthworks of roads, and where houses stand.
#include <algorithm>
#include <cmath>

#include "core/generators/world/houses.h"
#include "core/generators/world/roads.h"

namespace seedmesh::world {
namespace {

constexpr double works_reach = 56;  ///< metres from the middle of a road to untouched ground

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

}  // namespace

Ground Ground::with_roads(const World& world, const Rectangle& box, Job& job) {
  Ground ground(world, box, job);
  for (const auto& road : roads_near(world, box, works_reach + 16, job)) {
    for (std::size_t k = 1; k < road->points.size(); ++k) {
      const RoadPoint &a = road->points[k - 1], &b = road->points[k];
      const double reach = works_reach + 16;
      if (std::min(a.east, b.east) > box.east + reach || std::max(a.east, b.east) < box.west - reach ||
          std::min(a.north, b.north) > box.north + reach || std::max(a.north, b.north) < box.south - reach) {
        continue;
      }
      ground.pieces_.push_back(
          {a.east, a.north, a.height, b.east, b.north, b.height, road->width, a.is_bridge || b.is_bridge});
    }
  }
  return ground;
}

Ground Ground::with_works(const World& world, const Rectangle& box, Job& job) {
  Ground ground = with_roads(world, box, job);
  for (const House& house : houses_near(world, box, 2 * house_reach, job)) {
    ground.houses_.push_back({house.east, house.north, std::max(house.length, house.depth)});
  }
  return ground;
}

void Ground::add_works(GroundSample& sample, double east, double north) const {
  double weight = 0, level = 0, half = 0, nearest = 1e12;
  for (const RoadPiece& piece : pieces_) {
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
  sample.height += share * (height - sample.height);
}

}  // namespace seedmesh::world
