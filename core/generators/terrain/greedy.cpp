#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/triangulation.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
// Number of insertions between two checks of the clock.
constexpr std::size_t look = 256;

/// Returns true where d is inside the circle through a, b, c (counter-clockwise). Exact, because sides are
/// below 2^15.
bool in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto from = [&](GridPoint p) { return std::pair{std::int64_t{p.x} - d.x, std::int64_t{p.z} - d.z}; };
  const auto [ax, az] = from(a);
  const auto [bx, bz] = from(b);
  const auto [cx, cz] = from(c);
  const std::int64_t aa = ax * ax + az * az, bb = bx * bx + bz * bz, cc = cx * cx + cz * cz;
  // With x to the east and z to the south, counter-clockwise from above is clockwise in the plane: hence "< 0".
  return aa * (bx * cz - bz * cx) - bb * (ax * cz - az * cx) + cc * (ax * bz - az * bx) < 0;
}

/// A grid point in four bytes. Sides are below 2^15.
struct Packed {
  std::uint16_t x = 0, z = 0;
  Packed() = default;
  explicit Packed(GridPoint at) : x(static_cast<std::uint16_t>(at.x)), z(static_cast<std::uint16_t>(at.z)) {}
  GridPoint point() const { return {x, z}; }
};

/// A heap of triangles with an error above the bound. The largest error comes first, then the lower number. A
/// triangle is in it at most once.
class Queue {
 public:
  struct Entry {
    float error = 0;
    std::uint32_t triangle = 0;
    Packed worst;  ///< the sample with the largest error
    bool operator<(const Entry& other) const {
      return error != other.error ? error > other.error : triangle < other.triangle;
    }
  };

  explicit Queue(const Job& job) : heap_(job), slot_(job) {}

  bool empty() const { return heap_.empty(); }
  const Entry& first() const { return heap_[0]; }

  void set(const Entry& entry) {
    while (slot_.size() <= entry.triangle) slot_.push_back(none);
    std::uint32_t slot = slot_[entry.triangle];
    if (slot == none) {
      slot = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back(entry);
    }
    settle(slot, entry);
  }

  void remove(std::uint32_t triangle) {
    if (triangle >= slot_.size() || slot_[triangle] == none) return;
    const std::uint32_t slot = slot_[triangle];
    slot_[triangle] = none;
    const Entry last = heap_.back();
    heap_.pop_back();
    if (slot < heap_.size()) settle(slot, last);
  }

 private:
  void put(std::uint32_t slot, const Entry& entry) {
    heap_[slot] = entry;
    slot_[entry.triangle] = slot;
  }

  /// Moves an entry up or down from `slot` to its position. The entry in the slot is overwritten.
  void settle(std::uint32_t slot, const Entry& entry) {
    while (slot > 0 && entry < heap_[(slot - 1) / 2]) {
      put(slot, heap_[(slot - 1) / 2]);
      slot = (slot - 1) / 2;
    }
    for (std::uint32_t child = 2 * slot + 1; child < heap_.size(); child = 2 * slot + 1) {
      if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
      if (!(heap_[child] < entry)) break;
      put(slot, heap_[child]);
      slot = child;
    }
    put(slot, entry);
  }

  Array<Entry> heap_;
  Array<std::uint32_t> slot_;  ///< for each triangle; none: it is not in the heap
};

/// A Delaunay triangulation into which samples are inserted. Edge 3 t + k goes from corner k of triangle t to
/// the next corner.
class Network {
 public:
  Network(const Field& field, Job& job)
      : field_(field), meter_(job, Resource::triangles), points_(job), corners_(job), twins_(job) {
    const std::int32_t east = field.width - 1, south = field.depth - 1;
    for (const GridPoint at :
         {GridPoint{0, 0}, GridPoint{0, south}, GridPoint{east, south}, GridPoint{east, 0}})
      add_sample(at);
    meter_.spend(2);
    add_triangle({0, 1, 2}, {none, none, none});
    add_triangle({0, 2, 3}, {none, none, none});
    link(2, 3);
    changed_ = {0, 1};
  }

  /// Inserts a sample inside or on the border of triangle t that is not one of its corners.
  void insert(std::uint32_t t, GridPoint at) {
    const std::uint32_t added = add_sample(at);
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (doubled_area(corner(3 * t + k), corner(next(3 * t + k)), at) == 0)
        return split_edge(3 * t + k, added);
    }
    split_triangle(t, added);
  }

  /// Returns the triangle that contains a point or has it on its border. The search starts at the newest
  /// triangle.
  std::uint32_t triangle_at(GridPoint at) const {
    auto t = static_cast<std::uint32_t>(corners_.size() / 3 - 1);
    for (std::uint32_t k = 0; k < 3;) {
      const std::uint32_t edge = 3 * t + k;
      if (doubled_area(corner(edge), corner(next(edge)), at) < 0 && twins_[edge] != none) {
        t = twins_[edge] / 3;
        k = 0;
      } else {
        ++k;
      }
    }
    return t;
  }

  /// Returns the triangles that changed since the last call, each once. Valid until the next call.
  const std::vector<std::uint32_t>& take_changed() {
    taken_.swap(changed_);
    changed_.clear();
    std::sort(taken_.begin(), taken_.end());
    taken_.erase(std::unique(taken_.begin(), taken_.end()), taken_.end());
    return taken_;
  }

  /// Returns the sample of triangle t with the largest error; error 0 where none exceeds `max_error`. Includes
  /// samples of the border where `with_border`.
  Queue::Entry scan(std::uint32_t t, double max_error, bool with_border) const {
    const GridPoint a = corner(3 * t), b = corner(3 * t + 1), c = corner(3 * t + 2);
    if (doubled_area(a, b, c) <= 1) return {0, t, {}};
    const auto height = [&](GridPoint p) { return static_cast<double>(field_.at(p.x, p.z)); };
    const Plane plane = Plane::through(a, b, c, height(a), height(b), height(c));
    double most = max_error;
    GridPoint worst;
    const std::int32_t east = field_.width - 1, south = field_.depth - 1;
    each_row_inside(a, b, c, [&](std::int32_t z, std::int32_t first, std::int32_t last) {
      if (!with_border) {
        if (z == 0 || z == south) return;
        first = std::max(first, 1);
        last = std::min(last, east - 1);
      }
      const float* row = field_.row(z);
      const double start = plane.base + plane.south * z;
      if (worst_of_row(row, start, plane.east, first, last) <= most) return;
      for (std::int32_t x = first; x <= last; ++x) {
        const double off = std::abs(static_cast<double>(row[x]) - (start + plane.east * x));
        if (off > most && !(GridPoint{x, z} == a) && !(GridPoint{x, z} == b) && !(GridPoint{x, z} == c)) {
          most = off;
          worst = {x, z};
        }
      }
    });
    return {most > max_error ? static_cast<float>(most) : 0, t, Packed(worst)};
  }

  Triangulation take(const Job& job) {
    twins_ = {};
    corners_.shrink_to_fit();
    Array<std::uint32_t> samples(job, points_.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const GridPoint at = points_[i].point();
      samples[i] = static_cast<std::uint32_t>(at.z * field_.width + at.x);
    }
    return {std::move(samples), std::move(corners_)};
  }

 private:
  static std::uint32_t next(std::uint32_t edge) { return edge % 3 == 2 ? edge - 2 : edge + 1; }
  static std::uint32_t before(std::uint32_t edge) { return edge % 3 == 0 ? edge + 2 : edge - 1; }
  GridPoint corner(std::uint32_t edge) const { return points_[corners_[edge]].point(); }

  std::uint32_t add_sample(GridPoint at) {
    points_.push_back(Packed(at));
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  std::uint32_t add_triangle(const std::array<std::uint32_t, 3>& vertices,
                             const std::array<std::uint32_t, 3>& twins) {
    const auto t = static_cast<std::uint32_t>(corners_.size() / 3);
    corners_.extend(3);
    twins_.extend(3);
    set(t, vertices, twins);
    return t;
  }
  void set(std::uint32_t t, const std::array<std::uint32_t, 3>& vertices,
           const std::array<std::uint32_t, 3>& twins) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners_[3 * t + k] = vertices[k];
      link(3 * t + k, twins[k]);
    }
    changed_.push_back(t);
  }
  void link(std::uint32_t edge, std::uint32_t twin) {
    twins_[edge] = twin;
    if (twin != none) twins_[twin] = edge;
  }

  void split_triangle(std::uint32_t t, std::uint32_t added) {
    const std::uint32_t a = corners_[3 * t], b = corners_[3 * t + 1], c = corners_[3 * t + 2];
    const std::uint32_t ab = twins_[3 * t], bc = twins_[3 * t + 1], ca = twins_[3 * t + 2];
    meter_.spend(2);
    set(t, {a, b, added}, {ab, none, none});
    const std::uint32_t second = add_triangle({b, c, added}, {bc, none, 3 * t + 1});
    const std::uint32_t third = add_triangle({c, a, added}, {ca, 3 * t + 2, 3 * second + 1});
    legalize({3 * t, 3 * second, 3 * third});
  }

  /// Splits edge a-b of triangle (a, b, c) and, if there is one, triangle (b, a, d) on its other side.
  void split_edge(std::uint32_t edge, std::uint32_t added) {
    const std::uint32_t t = edge / 3, twin = twins_[edge];
    const std::uint32_t a = corners_[edge], b = corners_[next(edge)], c = corners_[before(edge)];
    const std::uint32_t bc = twins_[next(edge)], ca = twins_[before(edge)];
    meter_.spend(twin == none ? 1 : 2);
    if (twin == none) {
      set(t, {c, a, added}, {ca, none, none});
      const std::uint32_t other = add_triangle({b, c, added}, {bc, 3 * t + 2, none});
      return legalize({3 * t, 3 * other});
    }
    const std::uint32_t u = twin / 3, d = corners_[before(twin)];
    const std::uint32_t ad = twins_[next(twin)], db = twins_[before(twin)];
    set(t, {c, a, added}, {ca, none, none});
    set(u, {d, b, added}, {db, none, none});
    const std::uint32_t second = add_triangle({b, c, added}, {bc, 3 * t + 2, 3 * u + 1});
    const std::uint32_t third = add_triangle({a, d, added}, {ad, 3 * u + 2, 3 * t + 1});
    legalize({3 * t, 3 * u, 3 * second, 3 * third});
  }

  /// Flips edges opposite to the new vertex until the circle of every triangle is empty.
  void legalize(std::initializer_list<std::uint32_t> edges) {
    left_.assign(edges);
    while (!left_.empty()) {
      const std::uint32_t edge = left_.back();
      left_.pop_back();
      const std::uint32_t twin = twins_[edge];
      if (twin == none) continue;
      const std::uint32_t t = edge / 3, u = twin / 3;
      const std::uint32_t a = corners_[edge], b = corners_[next(edge)], added = corners_[before(edge)],
                          d = corners_[before(twin)];
      if (!in_circle(corner(edge), corner(next(edge)), corner(before(edge)), corner(before(twin)))) continue;
      const std::uint32_t b_added = twins_[next(edge)], added_a = twins_[before(edge)];
      const std::uint32_t a_d = twins_[next(twin)], d_b = twins_[before(twin)];
      set(t, {a, d, added}, {a_d, none, added_a});
      set(u, {d, b, added}, {d_b, b_added, 3 * t + 1});
      left_.push_back(3 * t);
      left_.push_back(3 * u);
    }
  }

  const Field& field_;
  Meter meter_;
  Array<Packed> points_;  ///< of each vertex
  Array<std::uint32_t> corners_, twins_;
  std::vector<std::uint32_t> changed_, taken_, left_;
};

/// Returns the samples of one side of the border that a greedy polyline needs, without its ends.
void refine_side(const Field& field, GridPoint a, GridPoint b, double max_error,
                 std::vector<GridPoint>& out) {
  const std::int32_t steps = std::max(std::abs(b.x - a.x), std::abs(b.z - a.z));
  if (steps < 2) return;
  const GridPoint step{(b.x - a.x) / steps, (b.z - a.z) / steps};
  const double from = static_cast<double>(field.at(a.x, a.z)), to = static_cast<double>(field.at(b.x, b.z));
  double most = max_error;
  std::int32_t worst = 0;
  for (std::int32_t i = 1; i < steps; ++i) {
    const double line = from + (to - from) * i / steps;
    const double off = std::abs(static_cast<double>(field.at(a.x + i * step.x, a.z + i * step.z)) - line);
    if (off > most) {
      most = off;
      worst = i;
    }
  }
  if (worst == 0) return;
  const GridPoint middle{a.x + worst * step.x, a.z + worst * step.z};
  refine_side(field, a, middle, max_error, out);
  out.push_back(middle);
  refine_side(field, middle, b, max_error, out);
}

void insert_border(Network& network, const Field& field, double max_error) {
  const std::int32_t east = field.width - 1, south = field.depth - 1;
  // Each side starts at its western or northern end, as it does for the adjacent field.
  const std::array<std::pair<GridPoint, GridPoint>, 4> sides{
      {{{0, 0}, {east, 0}}, {{0, south}, {east, south}}, {{0, 0}, {0, south}}, {{east, 0}, {east, south}}}};
  for (const auto& [from, to] : sides) {
    std::vector<GridPoint> needed;
    refine_side(field, from, to, max_error, needed);
    for (const GridPoint at : needed) network.insert(network.triangle_at(at), at);
  }
}

}  // namespace

Triangulation greedy(const Field& field, const Tolerance& tolerance, Border border, Job& job) {
  Network network(field, job);
  const double max_error = tolerance.inside;
  const bool with_border = border == Border::by_error;
  if (!with_border) insert_border(network, field, tolerance.border);
  Queue queue(job);
  for (std::size_t count = 0;; ++count) {
    if (count % look == 0) job.check();
    for (const std::uint32_t t : network.take_changed()) {
      const Queue::Entry entry = network.scan(t, max_error, with_border);
      if (entry.error > 0) {
        queue.set(entry);
      } else {
        queue.remove(t);
      }
    }
    if (queue.empty()) break;
    const Queue::Entry first = queue.first();
    network.insert(first.triangle, first.worst.point());
  }
  queue = Queue(job);
  return network.take(job);
}

Triangulation greedy(const Field& field, double max_error, Border border, Job& job) {
  return greedy(field, Tolerance{max_error, max_error}, border, job);
}

}  // namespace seedmesh::terrain
