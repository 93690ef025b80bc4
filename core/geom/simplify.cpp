/// Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997; half-edge
/// collapse with the link condition of Dey et al., "Topology Preserving Edge Contraction", 1999.
#include "core/geom/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <vector>

#include "core/base/array.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr double border_weight = 10;      ///< of the planes that stand on a border, to that of faces
constexpr double length_weight = 1e-6;    ///< prefers short edges where everything is flat
constexpr double least_turn = 0.2;        ///< cosine between a face before and after
constexpr double least_height = 1e-3;     ///< of a triangle, to its longest side
constexpr std::uint32_t most_faces = 96;  ///< round a vertex that is looked at

/// Sum of squared distances to planes, as the ten numbers of a symmetric matrix.
struct Quadric {
  std::array<double, 10> q{};
  void add(const glm::dvec3& n, double d, double weight) {
    const double terms[10] = {n.x * n.x, n.x * n.y, n.x * n.z, n.x * d, n.y * n.y,
                              n.y * n.z, n.y * d,   n.z * n.z, n.z * d, d * d};
    for (std::size_t i = 0; i < 10; ++i) q[i] += weight * terms[i];
  }
  void add(const Quadric& other) {
    for (std::size_t i = 0; i < 10; ++i) q[i] += other.q[i];
  }
  double at(const glm::dvec3& p) const {
    return q[0] * p.x * p.x + 2 * q[1] * p.x * p.y + 2 * q[2] * p.x * p.z + 2 * q[3] * p.x +
           q[4] * p.y * p.y + 2 * q[5] * p.y * p.z + 2 * q[6] * p.y + q[7] * p.z * p.z + 2 * q[8] * p.z +
           q[9];
  }
};

/// A wish to move a point onto a neighbour.
struct Wish {
  double cost;
  std::uint32_t from, to, stamp;
  /// For a heap with the cheapest on top; a total order.
  bool operator<(const Wish& o) const { return std::tie(cost, from, to) > std::tie(o.cost, o.from, o.to); }
};

/// All meshes as one net. Vertices at one position are one point; a corner is a place of a
/// triangle, and the corners of a point are a list.
class Net {
 public:
  Net(std::span<Mesh* const> meshes, const std::vector<bool>& fixed, Job& job)
      : job_(job),
        position_(job),
        normal_(job),
        corner_(job),
        point_of_(job),
        next_(job),
        head_(job),
        stamp_(job),
        locked_(job),
        quadric_(job),
        heap_(job) {
    read(meshes, fixed);
    find_points();
    link();
    measure();
  }

  std::uint64_t reduce(std::uint64_t target, double most_cost) {
    for (std::uint32_t point = 0; point < head_.size(); ++point) wish(point);
    std::uint64_t steps = 0;
    while (left_ > target && heap_.size() > 0) {
      if (++steps % 1024 == 0) job_.check();
      std::pop_heap(heap_.begin(), heap_.end());
      const Wish best = heap_.back();
      heap_.pop_back();
      if (head_[best.from] == none || best.stamp != stamp_[best.from]) continue;
      if (best.cost > most_cost) break;
      collapse(best.from, best.to);
    }
    return left_;
  }

  /// Writes the triangles that are left back to their meshes.
  void write(std::span<Mesh* const> meshes) const {
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Mesh& mesh = *meshes[i];
      if (mesh.topology != Topology::triangles) continue;
      Array<std::uint32_t>& index = mesh.index.wide;
      std::size_t kept = 0;
      for (const std::size_t end = triangle + index.size() / 3; triangle < end; ++triangle) {
        if (corner_[3 * triangle] == none) continue;
        for (std::size_t c = 0; c < 3; ++c) index[kept++] = corner_[3 * triangle + c] - first_[i];
      }
      if (kept < index.size()) mesh.cache_ordered = false;
      index.resize(kept);
    }
  }

 private:
  using Ring = std::array<std::uint32_t, 2 * most_faces>;

  void read(std::span<Mesh* const> meshes, const std::vector<bool>& fixed) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      first_.push_back(static_cast<std::uint32_t>(position_.size()));
      const Mesh& mesh = *meshes[i];
      if (mesh.topology != Topology::triangles) continue;
      for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        position_.push_back(mesh.position[v] + 0.0F);
        normal_.push_back(mesh.normal.empty() ? glm::vec3(0) : mesh.normal[v]);
        locked_.push_back(fixed[i] ? 1 : 0);
      }
      for (std::size_t c = 0; c < mesh.index.size(); ++c) corner_.push_back(first_.back() + mesh.index.at(c));
    }
    left_ = corner_.size() / 3;
  }

  /// Numbers the positions; `locked_` is of points from here on.
  void find_points() {
    Array<std::uint32_t> order(job_, position_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [this](std::uint32_t v) {
      const glm::vec3& p = position_[v];
      return std::tie(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    point_of_.resize(position_.size());
    Array<std::uint8_t> locked(job_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || key(order[i]) != key(order[i - 1])) {
        at_.push_back(glm::dvec3(position_[order[i]]));
        locked.push_back(0);
      }
      point_of_[order[i]] = static_cast<std::uint32_t>(at_.size() - 1);
      locked.back() = locked.back() | locked_[order[i]];
    }
    locked_ = std::move(locked);
  }

  void link() {
    head_.resize(at_.size());
    stamp_.resize(at_.size());
    std::fill(head_.begin(), head_.end(), none);
    std::fill(stamp_.begin(), stamp_.end(), 0U);
    next_.resize(corner_.size());
    for (std::size_t c = corner_.size(); c-- > 0;) {
      std::uint32_t& head = head_[point(c)];
      next_[c] = head;
      head = static_cast<std::uint32_t>(c);
    }
  }

  std::uint32_t point(std::size_t corner) const { return point_of_[corner_[corner]]; }
  static std::size_t after(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static std::size_t before(std::size_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

  /// How many triangles have both points.
  std::uint32_t faces_on(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t count = 0;
    for (std::uint32_t c = head_[a]; c != none; c = next_[c]) {
      count += point(after(c)) == b || point(before(c)) == b ? 1U : 0U;
    }
    return count;
  }

  void measure() {
    quadric_.resize(at_.size());
    std::fill(quadric_.begin(), quadric_.end(), Quadric{});
    border_.assign(at_.size(), false);
    for (std::size_t t = 0; t < corner_.size(); t += 3) {
      if (t % 3072 == 0) job_.check();
      const glm::dvec3 &a = at_[point(t)], &b = at_[point(t + 1)], &c = at_[point(t + 2)];
      const glm::dvec3 across = glm::cross(b - a, c - a);
      const double length = std::sqrt(glm::dot(across, across));
      if (!(length > 0)) continue;
      const glm::dvec3 n = across / length;
      for (std::size_t i = 0; i < 3; ++i) {
        quadric_[point(t + i)].add(n, -glm::dot(n, a), length);
        measure_edge(t + i, n);
      }
    }
  }

  /// A border gets a plane that stands on it; where more than two triangles meet nothing moves.
  void measure_edge(std::size_t corner, const glm::dvec3& n) {
    const std::uint32_t a = point(corner), b = point(after(corner));
    const std::uint32_t faces = faces_on(a, b);
    if (faces > 2) locked_[a] = locked_[b] = 1;
    if (faces != 1) return;
    border_[a] = border_[b] = true;
    const glm::dvec3 edge = at_[b] - at_[a];
    const glm::dvec3 out = glm::cross(edge, n);
    const double length = std::sqrt(glm::dot(out, out));
    if (!(length > 0)) return;
    for (const std::uint32_t each : {a, b}) {
      quadric_[each].add(out / length, -glm::dot(out / length, at_[a]), border_weight * length * length);
    }
  }

  /// Neighbours of a point, each once; more than fit: 0.
  std::uint32_t neighbours(std::uint32_t of, Ring& ring) const {
    std::uint32_t count = 0, faces = 0;
    for (std::uint32_t c = head_[of]; c != none; c = next_[c]) {
      if (++faces > most_faces) return 0;
      for (const std::uint32_t each : {point(after(c)), point(before(c))}) {
        if (std::find(ring.begin(), ring.begin() + count, each) == ring.begin() + count) ring[count++] = each;
      }
    }
    return count;
  }

  /// Puts the cheapest collapse of a point that is allowed into the heap.
  void wish(std::uint32_t from) {
    if (head_[from] == none || locked_[from] != 0) return;
    Ring ring;
    const std::uint32_t count = neighbours(from, ring);
    std::array<std::pair<double, std::uint32_t>, 2 * most_faces> ways;
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::dvec3 way = at_[ring[i]] - at_[from];
      Quadric sum = quadric_[from];
      sum.add(quadric_[ring[i]]);
      ways[i] = {
          std::max(0.0, sum.at(at_[ring[i]])) + length_weight * glm::dot(way, way) * glm::dot(way, way),
          ring[i]};
    }
    std::sort(ways.begin(), ways.begin() + count);
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!may_collapse(from, ways[i].second, ring, count)) continue;
      push({ways[i].first, from, ways[i].second, stamp_[from]});
      return;
    }
  }

  void push(const Wish& wish) {
    heap_.push_back(wish);
    std::push_heap(heap_.begin(), heap_.end());
  }

  bool may_collapse(std::uint32_t from, std::uint32_t to, const Ring& ring, std::uint32_t count) const {
    const std::uint32_t faces = faces_on(from, to);
    if (faces == 0 || faces > 2 || (border_[from] && faces != 1)) return false;
    if (!border_[from] && faces == 1) return false;
    Ring other;
    const std::uint32_t others = neighbours(to, other);
    std::uint32_t common = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (std::find(other.begin(), other.begin() + others, ring[i]) != other.begin() + others) ++common;
    }
    return common == faces && keeps_faces(from, to);
  }

  /// The vertex of the point `to` that takes the place of a vertex of the point `from`; `none` unless exactly
  /// one does.
  std::uint32_t heir(std::uint32_t vertex, std::uint32_t from, std::uint32_t to) const {
    std::uint32_t found = none;
    for (std::uint32_t c = head_[from]; c != none; c = next_[c]) {
      if (corner_[c] != vertex) continue;
      for (const std::size_t each : {after(c), before(c)}) {
        if (point(each) != to) continue;
        if (found != none && found != corner_[each]) return none;
        found = corner_[each];
      }
    }
    return found;
  }

  bool keeps_faces(std::uint32_t from, std::uint32_t to) const {
    bool any = false;
    for (std::uint32_t c = head_[from]; c != none; c = next_[c]) {
      const std::uint32_t b = point(after(c)), d = point(before(c));
      const std::uint32_t vertex = heir(corner_[c], from, to);
      if (vertex == none) return false;
      if (b == to || d == to) continue;
      any = true;
      const std::array<std::uint32_t, 3> corners = {vertex, corner_[after(c)], corner_[before(c)]};
      if (!is_sound(from, to, {b, d}, corners) || is_there(to, b, d)) return false;
    }
    return any;
  }

  bool is_sound(std::uint32_t from, std::uint32_t to, std::pair<std::uint32_t, std::uint32_t> rest,
                const std::array<std::uint32_t, 3>& corners) const {
    const glm::dvec3 &b = at_[rest.first], &d = at_[rest.second];
    const glm::dvec3 old = glm::cross(b - at_[from], d - at_[from]),
                     now = glm::cross(b - at_[to], d - at_[to]);
    const double now2 = glm::dot(now, now), turn = glm::dot(old, now);
    const double longest = std::max(
        {glm::dot(b - at_[to], b - at_[to]), glm::dot(d - at_[to], d - at_[to]), glm::dot(b - d, b - d)});
    if (!(now2 > least_height * least_height * longest * longest)) return false;
    if (!(turn > 0) || turn * turn < least_turn * least_turn * now2 * glm::dot(old, old)) return false;
    for (const std::uint32_t corner : corners) {
      const glm::dvec3 n(normal_[corner]);
      if (n != glm::dvec3(0) && !(glm::dot(n, now) > 0)) return false;
    }
    return true;
  }

  /// Is there a triangle of these three points already?
  bool is_there(std::uint32_t a, std::uint32_t b, std::uint32_t d) const {
    for (std::uint32_t c = head_[a]; c != none; c = next_[c]) {
      const std::uint32_t x = point(after(c)), y = point(before(c));
      if ((x == b && y == d) || (x == d && y == b)) return true;
    }
    return false;
  }

  void drop(std::size_t triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = 3 * triangle + i;
      std::uint32_t* link = &head_[point(c)];
      while (*link != c) link = &next_[*link];
      *link = next_[c];
    }
    for (std::size_t i = 0; i < 3; ++i) corner_[3 * triangle + i] = none;
    --left_;
  }

  void collapse(std::uint32_t from, std::uint32_t to) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> heirs;  // of each corner that goes over
    std::vector<std::uint32_t> gone;
    for (std::uint32_t c = head_[from]; c != none; c = next_[c]) {
      if (point(after(c)) == to || point(before(c)) == to) {
        gone.push_back(c / 3);
      } else {
        heirs.emplace_back(c, heir(corner_[c], from, to));
      }
    }
    for (const std::uint32_t triangle : gone) drop(triangle);
    for (const auto& [c, vertex] : heirs) {
      corner_[c] = vertex;
      next_[c] = head_[to];
      head_[to] = c;
    }
    head_[from] = none;
    quadric_[to].add(quadric_[from]);
    Ring ring;
    const std::uint32_t count = neighbours(to, ring);
    refresh(to);
    for (std::uint32_t i = 0; i < count; ++i) refresh(ring[i]);
  }

  /// Old wishes of the point no longer count; it is asked anew where its turn comes.
  void refresh(std::uint32_t of) {
    if (locked_[of] != 0 || head_[of] == none) return;
    ++stamp_[of];
    wish(of);
  }

  Job& job_;
  Array<glm::vec3> position_, normal_;  ///< by vertex
  Array<std::uint32_t> corner_;         ///< vertex of each corner; none: the triangle is gone
  Array<std::uint32_t> point_of_;       ///< of each vertex
  Array<std::uint32_t> next_;           ///< the next corner of the same point
  Array<std::uint32_t> head_, stamp_;   ///< by point: its first corner, how often its surroundings changed
  Array<std::uint8_t> locked_;
  Array<Quadric> quadric_;
  Array<Wish> heap_;
  std::vector<glm::dvec3> at_;
  std::vector<bool> border_;
  std::vector<std::uint32_t> first_;  ///< vertex of each mesh
  std::uint64_t left_ = 0;
};

}  // namespace

std::uint64_t simplify(std::span<Mesh* const> meshes, std::uint64_t target, const std::vector<bool>& fixed,
                       Job& job, double most_cost) {
  Net net(meshes, fixed, job);
  const std::uint64_t left = net.reduce(target, most_cost);
  net.write(meshes);
  return left;
}

}  // namespace seedmesh
