#include "core/generators/world/roads.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/base/math.h"

namespace seedmesh::world {
namespace {

constexpr double grid = 128;         ///< metres between nodes, which lie at odd multiples of 64 m
constexpr double detour = 1.3;       ///< the ellipse of a road, by the distance of its ends
constexpr double easy_grade = 0.05;  ///< a road twice as steep costs five times as much
constexpr double bridge_cost = 600;  ///< metres that a node on a river costs
constexpr double bridge_shore = 8;   ///< metres from a bank over which a road is a bridge
/// How far a road can leave the rectangle of its ends.
double reach_of(double length) { return std::ceil(((detour - 1) * length / 2 + 2 * grid) / grid + 1) * grid; }

/// How far from a position of a road of this length at most the settlements are that decide about it. By the ellipse, the
/// nearer end is at most half of the detour away; from there, what is nearer to both ends is at most a length away. Four
/// nodes more, for the ellipse and for pieces that are tested by their rectangles.
double reach_of_sites(double length) { return (detour / 2 + 1) * length + 4 * grid; }

struct Node {
  double cost = 1e18, height = 0;
  int from = -1;
  enum State : std::uint8_t { unseen, open, blocked } state = unseen;
  bool is_wet = false;
};

/// The cheapest path between two sites.
class PathFinder {
 public:
  PathFinder(const World& world, const Site& a, const Site& b, Job& job)
      : world_(world),
        a_(a),
        b_(b),
        job_(job),
        length_(distance(a.east, a.north, b.east, b.north)),
        most_(detour * length_ + 4 * grid),
        box_(bounds()),
        ground_(world, box_, job) {
    columns_ = math::to_int32((box_.east - box_.west) / grid) + 1;
    rows_ = math::to_int32((box_.north - box_.south) / grid) + 1;
    nodes_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  const Ground& ground() const { return ground_; }

  std::vector<RoadPoint> find() {
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const int start = index_of(a_.east, a_.north), end = index_of(b_.east, b_.north);
    visit(start);
    at(start).cost = 0;
    queue.emplace(length_, start);
    std::uint32_t steps = 0;
    while (!queue.empty() && queue.top().second != end) {
      const auto [estimate, here] = queue.top();
      queue.pop();
      if (estimate > at(here).cost + ahead(here) + 1e-9) continue;
      if ((++steps & 255U) == 0) job_.check();
      expand(here, queue);
    }
    std::vector<RoadPoint> path;
    if (queue.empty()) return path;
    for (int n = end; n >= 0; n = at(n).from) path.push_back({east_of(n), north_of(n), 0, false, 0});
    std::reverse(path.begin(), path.end());
    return path;
  }

 private:
  static double distance(double ax, double ay, double bx, double by) {
    return std::sqrt((ax - bx) * (ax - bx) + (ay - by) * (ay - by));
  }
  Rectangle bounds() const {
    const double around = reach_of(length_);
    return {std::min(a_.east, b_.east) - around, std::min(a_.north, b_.north) - around,
            std::max(a_.east, b_.east) + around, std::max(a_.north, b_.north) + around};
  }
  Node& at(int n) { return nodes_[static_cast<std::size_t>(n)]; }
  int index_of(double east, double north) const {
    return math::to_int32((north - box_.south) / grid) * columns_ + math::to_int32((east - box_.west) / grid);
  }
  double east_of(int n) const { return box_.west + grid * (n % columns_); }
  double north_of(int n) const {
    const int row = n / columns_;
    return box_.south + grid * row;
  }
  double ahead(int n) const { return distance(east_of(n), north_of(n), b_.east, b_.north); }

  void visit(int n) {
    Node& node = at(n);
    if (node.state != Node::unseen) return;
    const double east = east_of(n), north = north_of(n);
    const bool is_far = distance(east, north, a_.east, a_.north) + ahead(n) > most_;
    node.state = is_far ? Node::blocked : Node::open;
    if (is_far) return;
    const GroundSample sample = ground_.at(east, north);
    node.height = sample.height;
    node.is_wet = sample.shore < 4;
    if (world_.params.relief.sea && sample.height < world_.params.relief.sea_level + 1.5)
      node.state = Node::blocked;
    for (const Lake& lake : ground_.lakes()) {
      const double away = distance(east, north, lake.east, lake.north);
      if (away < shore_distance(lake, east, north, away) + 12) node.state = Node::blocked;
    }
  }

  /// A diagonal that would pass a position without earthworks.
  bool meets_pin(int n, int dx, int dy) const {
    if (dx == 0 || dy == 0) return false;
    const double x = (east_of(n) + dx * grid / 2) / works_spacing,
                 y = (north_of(n) + dy * grid / 2) / works_spacing;
    return x == std::floor(x) && y == std::floor(y);
  }

  template <class Queue>
  void expand(int n, Queue& queue) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int column = n % columns_ + dx, row = n / columns_ + dy;
        if ((dx == 0 && dy == 0) || column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
        if (meets_pin(n, dx, dy)) continue;
        const int next = row * columns_ + column;
        visit(next);
        if (at(next).state == Node::blocked) continue;
        const double run = grid * (dx != 0 && dy != 0 ? 1.4142135623730951 : 1);
        const double grade = (at(next).height - at(n).height) / run / easy_grade;
        const double cost = at(n).cost + run * (1 + grade * grade) + (at(next).is_wet ? bridge_cost : 0);
        if (cost >= at(next).cost) continue;
        at(next).cost = cost;
        at(next).from = n;
        queue.emplace(cost + ahead(next), next);
      }
    }
  }

  const World& world_;
  const Site &a_, &b_;
  Job& job_;
  double length_, most_;
  Rectangle box_;
  Ground ground_;
  int columns_ = 0, rows_ = 0;
  std::vector<Node> nodes_;
};

/// Corner cutting (Chaikin 1974); the ends stay.
std::vector<RoadPoint> smoothed(const std::vector<RoadPoint>& path) {
  std::vector<RoadPoint> out{path.front()};
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const RoadPoint &a = path[k], &b = path[k + 1];
    const auto between = [&](double t) {
      return RoadPoint{a.east + t * (b.east - a.east), a.north + t * (b.north - a.north), 0, false, 0};
    };
    if (k > 0) out.push_back(between(0.25));
    if (k + 2 < path.size()) out.push_back(between(0.75));
  }
  out.push_back(path.back());
  return out;
}

/// Sets the heights of a road; bridges span water from bank to bank.
bool set_heights(std::vector<RoadPoint>& points, const Ground& ground) {
  std::vector<double> along{0}, heights;
  for (std::size_t k = 0; k < points.size(); ++k) {
    RoadPoint& p = points[k];
    const GroundSample sample = ground.at(p.east, p.north);
    p.is_bridge = sample.shore < bridge_shore && k > 0 && k + 1 < points.size();
    heights.push_back(sample.height);
    if (k == 0) continue;
    const double x = p.east - points[k - 1].east, y = p.north - points[k - 1].north;
    along.push_back(along.back() + std::sqrt(x * x + y * y));
  }
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    if (!points[k].is_bridge) continue;
    std::size_t end = k;
    while (end + 1 < points.size() && points[end].is_bridge) ++end;
    for (std::size_t n = k; n < end; ++n) {
      const double t = (along[n] - along[k - 1]) / (along[end] - along[k - 1]);
      heights[n] = heights[k - 1] + t * (heights[end] - heights[k - 1]) + 0.8;
    }
    k = end;
  }
  const std::vector<double> levels = graded(along, heights);
  bool is_buildable = !levels.empty();
  for (std::size_t k = 0; k < levels.size(); ++k) {
    points[k].height = levels[k];
    points[k].works = std::abs(levels[k] - heights[k]);
    is_buildable &= points[k].works <= most_works;
  }
  return is_buildable;
}

std::shared_ptr<const Road> make_road(const World& world, const Site& a, const Site& b, Job& job) {
  auto road = std::make_shared<Road>();
  road->id = "w" + name_of(a) + "_" + name_of(b);
  road->width = world.params.roads.width;
  PathFinder finder(world, a, b, job);
  std::vector<RoadPoint> path = finder.find();
  if (path.size() < 2) return road;
  for (int round = 0; round < 2; ++round) path = smoothed(path);
  if (set_heights(path, finder.ground())) road->points = std::move(path);
  return road;
}

double square_of(const Site& a, const Site& b) {
  return (a.east - b.east) * (a.east - b.east) + (a.north - b.north) * (a.north - b.north);
}

bool touches(const Road& road, const Rectangle& box, double reach) {
  for (std::size_t k = 1; k < road.points.size(); ++k) {
    const RoadPoint &a = road.points[k - 1], &b = road.points[k];
    if (std::min(a.east, b.east) <= box.east + reach && std::max(a.east, b.east) >= box.west - reach &&
        std::min(a.north, b.north) <= box.north + reach && std::max(a.north, b.north) >= box.south - reach) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<double> graded(const std::vector<double>& along, const std::vector<double>& ground) {
  const double length = along.back(), first = ground.front(), last = ground.back();
  if (std::abs(last - first) > most_grade * length) return {};
  std::vector<double> low(ground.size()), high(ground.size());
  for (std::size_t k = 0; k < ground.size(); ++k) {
    const double from = most_grade * along[k], to = most_grade * (length - along[k]);
    low[k] = std::clamp(ground[k], std::max(first - from, last - to), std::min(first + from, last + to));
  }
  high = low;
  const auto relax = [&](std::size_t k, std::size_t other) {
    const double rise = most_grade * std::abs(along[k] - along[other]);
    low[k] = std::min(low[k], low[other] + rise);
    high[k] = std::max(high[k], high[other] - rise);
  };
  for (std::size_t k = 1; k < low.size(); ++k) relax(k, k - 1);
  for (std::size_t k = low.size() - 1; k-- > 0;) relax(k, k + 1);
  for (std::size_t k = 0; k < low.size(); ++k) low[k] = (low[k] + high[k]) / 2;
  return low;
}

std::vector<std::shared_ptr<const Road>> roads_near(const World& world, const Rectangle& box, double reach,
                                                    Job& job) {
  std::vector<std::shared_ptr<const Road>> found;
  const double longest = world.params.roads.longest;
  if (longest <= 0) return found;
  const auto sites =
      sites_near(world, box, reach + world.reach(LayerInput::roads, reach_of_sites(longest)), job);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (std::size_t j = i + 1; j < sites.size(); ++j) {
      const Site &a = *sites[i], &b = *sites[j];
      const double square = square_of(a, b);
      if (square > longest * longest) continue;
      const double detours = reach + reach_of(std::sqrt(square));
      if (std::min(a.east, b.east) > box.east + detours || std::max(a.east, b.east) < box.west - detours ||
          std::min(a.north, b.north) > box.north + detours ||
          std::max(a.north, b.north) < box.south - detours) {
        continue;
      }
      const bool is_edge = std::none_of(sites.begin(), sites.end(), [&](const auto& c) {
        return std::max(square_of(a, *c), square_of(b, *c)) < square;
      });
      if (!is_edge) continue;
      const Site &first = a.cell < b.cell ? a : b, &second = a.cell < b.cell ? b : a;
      const std::int64_t step = (second.cell.x - first.cell.x) * 16 + second.cell.y - first.cell.y;
      auto road = world.store->get<Road>({world.id, Store::Layer::road, first.cell.x, first.cell.y, step},
                                         job, [&] { return make_road(world, first, second, job); });
      if (touches(*road, box, reach)) found.push_back(std::move(road));
    }
  }
  return found;
}

}  // namespace seedmesh::world
