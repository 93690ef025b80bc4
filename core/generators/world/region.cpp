#include "core/generators/world/region.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <queue>

#include "core/base/math.h"
#include "core/generators/world/courses.h"

namespace seedmesh::world {
namespace {

constexpr int window_margin = 3;  ///< cells that displaced borders reach beyond a region at most
constexpr double jitter = 0.6;    ///< share of a cell
constexpr int pieces = 12;        ///< pieces of a river between two nodes
constexpr double cell_area = drain_cell * drain_cell / 1e6;  ///< km²
constexpr double lake_reach = 640;  ///< metres; greatest radius, below the distance of nodes
constexpr int sinking_steps = 5;
constexpr double sinking = 70,
                 level_ground = 0.02;  ///< metres a step of a node, where the slope is at least this

struct Node {
  CellKey cell;
  double east = 0, north = 0, ground = 0;
  int down = -1;       ///< the node that it drains to
  int main_up = -1;    ///< the greatest river that ends here
  double flow = 1;     ///< cells
  double water = 1e9;  ///< at first the least water of the rivers that end here
  double floor = 0;    ///< level of the water that it drains to
  int lake = -1;
  bool is_sea = false, is_reached = false;
};

Node node_of(const World& world, const CellKey& cell) {
  Rng rng(cell_key(region_key(world, 1), cell.x, cell.y));
  Node node;
  node.cell = cell;
  node.east = (static_cast<double>(cell.x) + 0.5 + jitter * (rng.unit() - 0.5)) * drain_cell;
  node.north = (static_cast<double>(cell.y) + 0.5 + jitter * (rng.unit() - 0.5)) * drain_cell;
  Slope land = land_at(world, node.east, node.north).height;
  for (int k = 0; k < sinking_steps; ++k) {  // towards a valley, within the cell
    const double slope = std::sqrt(land.east * land.east + land.north * land.north);
    const double by = sinking / std::max(slope, level_ground);
    node.east -= by * land.east;
    node.north -= by * land.north;
    land = land_at(world, node.east, node.north).height;
  }
  node.ground = land.value;
  node.is_sea = world.params.relief.sea && node.ground < world.params.relief.sea_level - 6;
  return node;
}

/// Cells around dry positions have no node, so rivers pass them by.
bool is_dry(const CellKey& cell) {
  constexpr std::int64_t period = 8;
  static_assert(period * drain_cell == dry_spacing);
  const auto touches = [](std::int64_t v) { return ((v % period + period + 1) % period) <= 1; };
  return touches(cell.x) && touches(cell.y);
}

double distance_of(const RiverPoint& p, const Lake& lake) {
  const double east = p.east - lake.east, north = p.north - lake.north;
  return std::sqrt(east * east + north * north);
}

std::string name_of(char kind, const CellKey& cell) {
  return kind + std::to_string(cell.x) + "_" + std::to_string(cell.y);
}

/// Drainage of one region while it is made.
class Drainage {
 public:
  Drainage(const World& world, const CellKey& region, Job& job)
      : world_(world),
        job_(job),
        region_(region),
        margin_(math::to_int32(world.reach(LayerInput::cells, window_margin))),
        window_(region_cells + 2 * margin_) {}

  Region make() {
    if (world_.params.water.rivers <= 0 && world_.params.relief.sea) return {};
    collect_nodes();
    flood_from_sea();
    flood_from_lowest();
    add_flow();
    choose_main_rivers();
    add_hollows();
    for (std::size_t k = order_.size(); k-- > 0;) follow(order_[k]);
    join_rivers();
    made_.size = 256 + 200 * made_.lakes.size();
    for (River& river : made_.rivers) {
      for (const RiverPoint& p : river.points) river.add_to_bounds(p);
      made_.size += sizeof(River) + 64 + river.points.size() * sizeof(RiverPoint);
    }
    return std::move(made_);
  }

 private:
  using Queue =
      std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>>;

  void collect_nodes() {
    grid_.assign(static_cast<std::size_t>(window_ * window_), -1);
    for (int y = 0; y < window_; ++y) {
      for (int x = 0; x < window_; ++x) {
        const CellKey cell{region_.x * region_cells - margin_ + x, region_.y * region_cells - margin_ + y};
        if (is_dry(cell) || region_of(world_, cell) != region_) continue;
        grid_[static_cast<std::size_t>(y * window_ + x)] = static_cast<int>(nodes_.size());
        nodes_.push_back(node_of(world_, cell));
      }
    }
    job_.check();
  }

  int node_at(std::int64_t x, std::int64_t y) const {
    const std::int64_t i = x - region_.x * region_cells + margin_, j = y - region_.y * region_cells + margin_;
    if (i < 0 || j < 0 || i >= window_ || j >= window_) return -1;
    return grid_[static_cast<std::size_t>(j * window_ + i)];
  }

  /// Of the two diagonals of four nodes, one is an edge of the graph, so that edges do not cross.
  bool has_diagonal(std::int64_t x, std::int64_t y, bool is_rising) const {
    return ((cell_key(region_key(world_, 2), x, y) & 1U) != 0) == is_rising;
  }

  template <class Visit>
  void for_neighbours(const Node& node, const Visit& visit) const {
    const auto [x, y] = node.cell;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        if (dx != 0 && dy != 0 && !has_diagonal(std::min(x, x + dx), std::min(y, y + dy), dx == dy)) continue;
        if (const int other = node_at(x + dx, y + dy); other >= 0) visit(other);
      }
    }
  }

  void flood(Queue& queue) {
    while (!queue.empty()) {
      const auto [level, here] = queue.top();
      queue.pop();
      order_.push_back(here);
      for_neighbours(at(here), [&, from = here, height = level](int other) {
        Node& next = at(other);
        if (next.is_reached) return;
        next.is_reached = true;
        next.down = from;
        next.floor = at(from).floor;
        queue.emplace(std::max(next.ground, height + 0.1), other);
      });
    }
  }

  void flood_from_sea() {
    Queue queue;
    for (int n = 0; n < count(); ++n) {
      Node& node = at(n);
      if (!node.is_sea) continue;
      node.is_reached = true;
      node.floor = world_.params.relief.sea_level;
      queue.emplace(node.ground, n);
    }
    flood(queue);
  }

  /// What does not drain to the sea drains to a lake at its lowest node.
  void flood_from_lowest() {
    for (;;) {
      int lowest = -1;
      for (int n = 0; n < count(); ++n) {
        if (at(n).is_reached || (lowest >= 0 && at(n).ground >= at(lowest).ground)) continue;
        lowest = n;
      }
      if (lowest < 0) return;
      const std::size_t before = order_.size();
      Node& sink = at(lowest);
      sink.is_reached = true;
      sink.floor = sink.ground - shallow;
      if (world_.params.relief.sea) sink.floor = std::max(sink.floor, world_.params.relief.sea_level);
      Queue queue;
      queue.emplace(sink.ground, lowest);
      flood(queue);
      const auto cells = static_cast<double>(order_.size() - before);
      add_lake(lowest, std::min(lake_reach / 1.25, 180 + 26 * std::sqrt(cells)));
    }
  }

  void add_lake(int n, double radius) {
    Node& node = at(n);
    node.lake = static_cast<int>(made_.lakes.size());
    made_.lakes.push_back({name_of('l', node.cell), node.east, node.north, node.floor, radius,
                           3 + radius / 60, cell_key(region_key(world_, 3), node.cell.x, node.cell.y)});
  }

  void add_flow() {
    for (std::size_t k = order_.size(); k-- > 0;) {
      const Node& node = at(order_[k]);
      if (node.down >= 0) at(node.down).flow += node.flow;
    }
  }

  /// Lakes with an outlet, where a node is below its neighbours.
  void add_hollows() {
    for (int n = 0; n < count(); ++n) {
      Node& node = at(n);
      if (node.is_sea || node.lake >= 0 || node.flow < least_flow()) continue;
      bool is_hollow = true;
      for_neighbours(
          node, [&](int other) { is_hollow &= at(other).ground > node.ground + 1 && at(other).lake < 0; });
      Rng rng(cell_key(region_key(world_, 4), node.cell.x, node.cell.y));
      if (is_hollow && node.ground > node.floor + 4) add_lake(n, rng.uniform(150, lake_reach / 1.25));
    }
  }

  double least_flow() const {
    const double few = 1 - world_.params.water.rivers;
    return world_.params.water.rivers > 0 ? 1.5 + 10 * few * few : 1e9;
  }
  double width_of(double flow) const {
    return std::max(1.5, world_.params.water.width * std::sqrt(flow * cell_area / 100));
  }
  bool is_river(const Node& node) const {
    return !node.is_sea && node.down >= 0 && node.flow >= least_flow();
  }

  /// Where a river flows at a node.
  glm::dvec2 direction_of(const Node& node) const {
    const Node* above = node.main_up >= 0 ? &at(node.main_up) : &node;
    const Node* below = node.down >= 0 ? &at(node.down) : &node;
    return {(below->east - above->east) / 2, (below->north - above->north) / 2};
  }

  RiverPoint point_at(const Node& from, const Node& to, double t) const {
    const glm::dvec2 a = direction_of(from), b = direction_of(to);
    const double t2 = t * t, t3 = t2 * t;
    const double p = 2 * t3 - 3 * t2 + 1, q = t3 - 2 * t2 + t, r = -2 * t3 + 3 * t2, s = t3 - t2;
    RiverPoint point;
    point.east = p * from.east + q * a.x + r * to.east + s * b.x;
    point.north = p * from.north + q * a.y + r * to.north + s * b.y;
    const double bend = 16 * t2 * (1 - t) * (1 - t) * 150;
    const double east = point.east, north = point.north;
    point.east += bend * noise(region_key(world_, 5), east / 620, north / 620).value;
    point.north += bend * noise(region_key(world_, 6), east / 620, north / 620).value;
    keep_away(point);
    return point;
  }

  const Lake* lake_of(const Node& node) const {
    return node.lake >= 0 ? &made_.lakes[static_cast<std::size_t>(node.lake)] : nullptr;
  }
  static bool is_inside(const Lake* lake, const RiverPoint& p) {
    if (lake == nullptr) return false;
    const double away = distance_of(p, *lake);
    return away < shore_distance(*lake, p.east, p.north, away);
  }

  void choose_main_rivers() {
    courses_.resize(nodes_.size());
    for (int n = 0; n < count(); ++n) {
      if (!is_river(at(n))) continue;
      int& main = at(at(n).down).main_up;
      if (main < 0 || at(n).flow > at(main).flow) main = n;
    }
  }

  /// Finds the water of a node, and the river that leaves it. Nodes above come before.
  void follow(int n) {
    Node& node = at(n);
    node.water = std::max(node.floor, std::min(node.water, node.ground - shallow));
    if (node.is_sea) return;
    if (node.lake >= 0) made_.lakes[static_cast<std::size_t>(node.lake)].level = node.water;
    if (!is_river(node)) return;
    const double water = lay_course(n, path_of(n));
    Node& below = at(node.down);
    if (courses_[static_cast<std::size_t>(n)].into != "sea") below.water = std::min(below.water, water);
  }

  /// The positions and widths of a river from its node to the node below.
  std::vector<RiverPoint> path_of(int n) const {
    const Node &node = at(n), &below = at(node.down);
    const double last_width = width_of(node.flow);
    const double first_width = node.main_up >= 0 ? width_of(at(node.main_up).flow) : 0.6 * last_width;
    std::vector<RiverPoint> path;
    for (int k = 0; k <= pieces; ++k) {
      path.push_back(point_at(node, below, static_cast<double>(k) / pieces));
      path.back().width = first_width + (last_width - first_width) * k / pieces;
    }
    settle_in_valleys(world_, path);
    for (std::size_t k = 1; k + 1 < path.size(); ++k) keep_away(path[k]);
    return path;
  }

  /// Adds the points of a path up to a shore, with their water. Returns the lowest water.
  double lay_course(int n, const std::vector<RiverPoint>& path) {
    Node& node = at(n);
    const Node& below = at(node.down);
    Course& course = courses_[static_cast<std::size_t>(n)];
    course.down = node.down;
    double water = node.water;
    for (std::size_t k = 0; k < path.size() && course.into.empty(); ++k) {
      RiverPoint point = path[k];
      if (is_inside(lake_of(node), point)) continue;
      const Land ground = land_at(world_, point.east, point.north);
      const double land = ground.height.value, low = lowest_across(world_, path, k, point.width / 2);
      if (k > 0) water = std::max(node.floor, std::min(water, std::min(land, low) - shallow));
      if (world_.params.relief.sea && k > 0 && land < world_.params.relief.sea_level - shallow) {
        course.into = "sea";
        water = world_.params.relief.sea_level;
      } else if (is_inside(lake_of(below), point)) {
        course.into = lake_of(below)->id;
        course.into_lake = below.lake;
      }
      point.water = water;
      point.cut = std::max(0.0, land - water);
      course.points.push_back(point);
      course.ruggedness.push_back(ground.ruggedness);
    }
    return water;
  }

  bool is_head(int n) const {
    const Node& node = at(n);
    if (node.lake >= 0 || node.main_up < 0) return true;
    const Course& above = courses_[static_cast<std::size_t>(node.main_up)];
    return !above.into.empty() || above.points.size() < 2;
  }

  void join_rivers() {
    for (int n = 0; n < count(); ++n) courses_[static_cast<std::size_t>(n)].lake = at(n).lake;
    lower_to_valleys(courses_, order_, made_.lakes);
    std::vector<int> river_at(nodes_.size(), -1), mouths;
    for (int n = 0; n < count(); ++n) {
      if (courses_[static_cast<std::size_t>(n)].points.size() < 2 || !is_head(n)) continue;
      River river;
      river.id = name_of('r', at(n).cell);
      int here = n, mouth = -1;
      for (;;) {
        const Course& course = courses_[static_cast<std::size_t>(here)];
        river_at[static_cast<std::size_t>(here)] = static_cast<int>(made_.rivers.size());
        if (!river.points.empty()) river.points.pop_back();
        river.points.insert(river.points.end(), course.points.begin(), course.points.end());
        river.into = course.into;
        if (!river.into.empty()) break;
        mouth = at(here).down;
        if (at(mouth).main_up != here) break;
        here = mouth;
      }
      made_.rivers.push_back(std::move(river));
      mouths.push_back(mouth);
    }
    for (std::size_t k = 0; k < made_.rivers.size(); ++k) {
      if (made_.rivers[k].into.empty()) made_.rivers[k].into = outlet_at(mouths[k], river_at);
    }
  }

  /// What a river at a node flows into: the river from there or, where its course is within a lake, the end of that.
  std::string outlet_at(int n, const std::vector<int>& river_at) const {
    for (;; n = at(n).down) {
      const auto here = static_cast<std::size_t>(n);
      if (river_at[here] >= 0) return made_.rivers[static_cast<std::size_t>(river_at[here])].id;
      if (!courses_[here].into.empty()) return courses_[here].into;
      if (const Lake* lake = lake_of(at(n))) return lake->id;
      if (at(n).down < 0) return "sea";
    }
  }

  Node& at(int n) { return nodes_[static_cast<std::size_t>(n)]; }
  const Node& at(int n) const { return nodes_[static_cast<std::size_t>(n)]; }
  int count() const { return static_cast<int>(nodes_.size()); }

  const World& world_;
  Job& job_;
  CellKey region_;
  int margin_, window_;  ///< cells around the region, and along a side with them
  std::vector<Node> nodes_;
  std::vector<int> grid_;
  std::vector<int> order_;  ///< nodes from the outlets upwards
  std::vector<Course> courses_;
  Region made_;
};

}  // namespace

double shore_distance(const Lake& lake, double east, double north, double away) {
  if (away < 1e-6) return lake.radius;
  const double x = (east - lake.east) / away, y = (north - lake.north) / away;
  return lake.radius *
         (1 + 0.2 * noise(lake.key, 1.3 * x, 1.3 * y).value + 0.07 * noise(lake.key + 1, 4 * x, 4 * y).value);
}

std::shared_ptr<const Region> region_at(const World& world, const CellKey& region, Job& job) {
  return world.store->get<Region>({world.id, Store::Layer::region, region.x, region.y, 0}, job, [&] {
    return std::make_shared<const Region>(Drainage(world, region, job).make());
  });
}

}  // namespace seedmesh::world
