/// Courses of rivers: where they flow and how high. The ground beside a river is the valley of the lowest water nearby.
/// A river above the valley of another would therefore lie on a dyke.
#include "core/generators/world/courses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/generators/world/valley.h"

namespace seedmesh::world {
namespace {

constexpr int settling_rounds = 3;
constexpr double settling_pace = 700, most_settling = 70;  ///< metres by slope, and a round
constexpr double bank_margin = 45;                         ///< metres from a bank where land counts
constexpr double dry_radius = 1450;  ///< metres around dry positions, beyond the reach of valleys by a bend
constexpr double lake_grade = 0.03;  ///< grade of a river before a lake
constexpr double lake_uneven = 1.2;  ///< radius of a lake by its mean at most
constexpr int lowering_rounds = 2;   ///< the second includes rivers that the first had not lowered yet

/// The unit vector to the left of a river at a point.
std::pair<double, double> left_of(const std::vector<RiverPoint>& points, std::size_t k) {
  const RiverPoint &a = points[k == 0 ? 0 : k - 1], &b = points[std::min(k + 1, points.size() - 1)];
  const double x = b.east - a.east, y = b.north - a.north, length = std::sqrt(x * x + y * y);
  if (length <= 0) return {0, 0};
  return {-y / length, x / length};
}

struct Bounds {
  double west = 1e12, south = 1e12, east = -1e12, north = -1e12;
  double lowest = 1e12, widest = 0;  ///< water and half of the width
};
Bounds joined(const Bounds& a, const Bounds& b) {
  return {std::min(a.west, b.west),   std::min(a.south, b.south),   std::max(a.east, b.east),
          std::max(a.north, b.north), std::min(a.lowest, b.lowest), std::max(a.widest, b.widest)};
}

constexpr std::size_t points_a_piece = 8;

/// The bounds of a course, and of each piece of it.
struct Extent {
  Bounds whole;
  std::vector<Bounds> pieces;
};
Extent extent_of(const Course& course) {
  Extent extent;
  for (std::size_t k = 0; k < course.points.size(); ++k) {
    if (k % points_a_piece == 0) extent.pieces.emplace_back();
    const RiverPoint& p = course.points[k];
    extent.pieces.back() =
        joined(extent.pieces.back(), {p.east, p.north, p.east, p.north, p.water, p.width / 2});
  }
  for (const Bounds& piece : extent.pieces) extent.whole = joined(extent.whole, piece);
  return extent;
}

/// A position of water, and the land there.
struct Site {
  double east = 0, north = 0, land = 0, ruggedness = 0;
};

/// What the valley of another water allows: land at this height has water below it.
double below_valley(const Site& site, const WatersidePoint& waterside) {
  return std::max(waterside.water, valley_side(site.land, site.ruggedness, waterside).height - shallow);
}

/// Whether no point within bounds has a valley that is lower than `highest` at a position: the side of a valley is
/// higher the farther, the higher and the narrower the water is.
bool are_above(double highest, const Site& site, const Bounds& bounds) {
  const double x = std::max({0.0, bounds.west - site.east, site.east - bounds.east});
  const double y = std::max({0.0, bounds.south - site.north, site.north - bounds.north});
  // a little nearer, so that rounding does not count
  const double away = std::max(0.0, std::sqrt(x * x + y * y) - 1e-3);
  return is_above(highest, site.land, site.ruggedness, {away, bounds.widest, bounds.lowest});
}

/// Lowers the waters of a region.
class Lowering {
 public:
  Lowering(std::vector<Course>& courses, std::vector<Lake>& lakes) : courses_(courses), lakes_(lakes) {
    for (const Course& course : courses_) extents_.push_back(extent_of(course));
  }

  void lower(int n) {
    Course& course = at(n);
    std::vector<RiverPoint>& points = course.points;
    const bool has_river = points.size() > 1;
    if (has_river) find_near(extents_[static_cast<std::size_t>(n)].whole);
    double water = has_river ? end_of(course) : -std::numeric_limits<double>::infinity();
    for (std::size_t k = points.size(); has_river && k-- > 0;) {
      RiverPoint& p = points[k];
      const bool is_end = k + 1 == points.size();
      double most = p.water;
      if (course.into_lake >= 0 && !is_end) most = std::min(most, before_lake(p, lake(course.into_lake)));
      if (!is_end) most = most_at(most, {p.east, p.north, p.water + p.cut, course.ruggedness[k]}, n, k);
      if (course.lake >= 0 && k == 0) most = most_at_shores(most, lake(course.lake), n);
      water = is_end ? std::min(water, p.water) : std::max(water, most);
      p.cut += p.water - water;
      p.water = water;
      Bounds& piece = extents_[static_cast<std::size_t>(n)].pieces[k / points_a_piece];
      piece.lowest = std::min(piece.lowest, water);
    }
    if (course.lake < 0) return;
    Lake& own = lake(course.lake);
    own.level = has_river ? points.front().water : most_at_shores(own.level, own, n);
  }

 private:
  Course& at(int n) { return courses_[static_cast<std::size_t>(n)]; }
  Lake& lake(int n) { return lakes_[static_cast<std::size_t>(n)]; }

  static bool is_near(const Bounds& a, const Bounds& b) {
    return b.east >= a.west - valley_reach && b.west <= a.east + valley_reach &&
           b.north >= a.south - valley_reach && b.south <= a.north + valley_reach;
  }

  void find_near(const Bounds& own) {
    near_.clear();
    for (std::size_t n = 0; n < courses_.size(); ++n) {
      if (courses_[n].points.size() > 1 && is_near(extents_[n].whole, own)) near_.push_back(n);
    }
  }

  /// The level of the water that a course ends in.
  double end_of(const Course& course) {
    if (course.into_lake >= 0) return lake(course.into_lake).level;
    if (course.down >= 0 && course.into.empty() && !at(course.down).points.empty())
      return at(course.down).points.front().water;
    return course.points.back().water;
  }

  static double before_lake(const RiverPoint& p, const Lake& lake) {
    const double east = p.east - lake.east, north = p.north - lake.north;
    const double away = std::sqrt(east * east + north * north);
    return lake.level + lake_grade * std::max(0.0, away - shore_distance(lake, p.east, p.north, away));
  }

  /// Lowers `most` to what the valleys of the points of a course, from `from` on, allow at a position.
  void add_course(double& most, const Site& site, std::size_t n, std::size_t from) const {
    const std::vector<RiverPoint>& points = courses_[n].points;
    const Extent& extent = extents_[n];
    const Bounds own{site.east, site.north, site.east, site.north, 0, 0};
    if (!is_near(extent.whole, own)) return;
    for (std::size_t piece = from / points_a_piece; piece < extent.pieces.size(); ++piece) {
      const Bounds& bounds = extent.pieces[piece];
      if (!is_near(bounds, own) || bounds.lowest >= most) continue;
      if (most + shallow <= site.land && are_above(most + shallow, site, bounds)) continue;
      const std::size_t end = std::min(points.size(), (piece + 1) * points_a_piece);
      for (std::size_t k = std::max(from, piece * points_a_piece); k < end; ++k) {
        const double x = site.east - points[k].east, y = site.north - points[k].north, square = x * x + y * y;
        if (square >= valley_reach * valley_reach || points[k].water >= most) continue;
        const WatersidePoint waterside{std::sqrt(square), points[k].width / 2, points[k].water};
        const double highest = most + shallow;
        if (highest <= site.land && is_above(highest, site.land, site.ruggedness, waterside)) continue;
        most = std::min(most, below_valley(site, waterside));
      }
    }
  }

  /// The level of at most `most` that valleys around a position allow; of the river `own`, those of the points after
  /// `from`.
  double most_at(double most, const Site& site, int own, std::size_t from) const {
    const double east = site.east, north = site.north;
    for (const std::size_t n : near_) add_course(most, site, n, static_cast<int>(n) == own ? from + 1 : 0);
    for (const Lake& near : lakes_) {
      const double x = east - near.east, y = north - near.north, away = std::sqrt(x * x + y * y);
      if (away >= valley_reach + lake_uneven * near.radius || near.level >= most) continue;
      const double beyond = std::max(0.0, away - shore_distance(near, east, north, away));
      if (beyond < valley_reach) most = std::min(most, below_valley(site, {beyond, 5, near.level}));
    }
    return most;
  }

  double most_at_shores(double most, const Lake& own, int n) const {
    constexpr double d = 0.70710678118654752;
    constexpr double turns[8][2] = {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}};
    for (const auto& turn : turns) {
      const double shore = shore_distance(own, own.east + turn[0], own.north + turn[1], 1);
      // the land of the middle is used for that of the shore
      most = most_at_shore(
          most, {own.east + shore * turn[0], own.north + shore * turn[1], own.level + shallow, 0}, n);
    }
    return most;
  }

  /// The same as most_at() without the rivers that flow from or into the lake of a node.
  double most_at_shore(double most, const Site& site, int n) const {
    const int own = courses_[static_cast<std::size_t>(n)].lake;
    for (std::size_t m = 0; m < courses_.size(); ++m) {
      if (static_cast<int>(m) != n && courses_[m].into_lake != own) add_course(most, site, m, 0);
    }
    return most;
  }

  std::vector<Course>& courses_;
  std::vector<Lake>& lakes_;
  std::vector<Extent> extents_;
  std::vector<std::size_t> near_;  ///< rivers with a valley that can reach the one that is lowered
};

}  // namespace

void settle_in_valleys(const World& world, std::vector<RiverPoint>& points) {
  const std::size_t last = points.size() - 1;
  for (int round = 0; round < settling_rounds; ++round) {
    const std::vector<RiverPoint> before = points;
    for (std::size_t k = 1; k < last; ++k) {
      const auto [x, y] = left_of(before, k);
      const Slope land = land_at(world, before[k].east, before[k].north).height;
      const double t = static_cast<double>(k) / static_cast<double>(last);
      const double by =
          4 * t * (1 - t) *
          std::clamp(-settling_pace * (land.east * x + land.north * y), -most_settling, most_settling);
      // the mean with the neighbours keeps bends wide
      points[k].east = 0.6 * before[k].east + 0.2 * (before[k - 1].east + before[k + 1].east) + by * x;
      points[k].north = 0.6 * before[k].north + 0.2 * (before[k - 1].north + before[k + 1].north) + by * y;
    }
  }
}

void keep_away(RiverPoint& p) {
  const double x = p.east - dry_spacing * std::floor(p.east / dry_spacing + 0.5);
  const double y = p.north - dry_spacing * std::floor(p.north / dry_spacing + 0.5);
  const double square = x * x + y * y;
  if (square >= dry_radius * dry_radius || square < 1) return;
  const double by = dry_radius / std::sqrt(square) - 1;
  p.east += by * x;
  p.north += by * y;
}

double lowest_across(const World& world, const std::vector<RiverPoint>& points, std::size_t k,
                     double half_width) {
  const auto [x, y] = left_of(points, k);
  const double by = half_width + bank_margin;
  const RiverPoint& p = points[k];
  return std::min(land_at(world, p.east + by * x, p.north + by * y).height.value,
                  land_at(world, p.east - by * x, p.north - by * y).height.value);
}

void lower_to_valleys(std::vector<Course>& courses, const std::vector<int>& order, std::vector<Lake>& lakes) {
  Lowering lowering(courses, lakes);
  for (int round = 0; round < lowering_rounds; ++round) {
    for (const int n : order) lowering.lower(n);
  }
}

}  // namespace seedmesh::world
