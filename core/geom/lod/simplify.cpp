/// Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997; half-edge
/// collapse with the link condition of Dey et al., "Topology Preserving Edge Contraction", 1999.
#include "core/geom/lod/simplify.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/array.h"
#include "core/geom/lod/position_numbers.h"
#include "core/geom/lod/quadric.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double border_weight = 10;      ///< of planes perpendicular to a border, against those of faces
constexpr std::uint32_t most_faces = 96;  ///< at a vertex; vertices with more stay

/// All meshes as one surface. Vertices at the same position are one point. A corner is an entry of the index
/// array; the corners of a point are a linked list. Points and corners are arrays of structs: a step of a walk around a
/// point then misses the cache once.
class Net {
 public:
  Net(std::span<Mesh* const> meshes, const std::vector<bool>& fixed, Job& job) : job_(job) {
    read(meshes, fixed);
    find_points();
    measure();
  }

  /// Collapses are examined only when the bound of their cost is the least of all, so that most of the changes around
  /// a point cost one quadric.
  std::uint64_t reduce(std::uint64_t target, double most_cost) {
    beside_ = Array<std::uint32_t>(job_, points_.size(), 0U);
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
      look();
      points_[point].bound = least_cost(point);
      if (!(points_[point].bound < infinite)) continue;
      points_[point].is_waiting = true;
      heap_.push_back({points_[point].bound, point, none, points_[point].stamp});
    }
    std::make_heap(heap_.begin(), heap_.end(), [&](const auto& a, const auto& b) { return look(), a < b; });
    for (std::uint64_t step = 1; left_ > target && heap_.size() > 0; ++step) {
      if (step % 1024 == 0) job_.check();
      std::pop_heap(heap_.begin(), heap_.end());
      CollapseCandidate best = heap_.back();
      heap_.pop_back();
      if (points_[best.from].head == none || best.stamp != points_[best.from].stamp) continue;
      if (best.to == none) {
        points_[best.from].is_waiting = false;
        best = candidate(best.from);
        if (best.to == none) continue;
        if (heap_.size() > 0 && best < heap_[0]) {
          push(best);
          continue;
        }
      }
      if (best.cost > most_cost) break;
      collapse(best.from, best.to);
    }
    return left_;
  }

  /// Writes the remaining triangles to their meshes.
  void write(std::span<Mesh* const> meshes) const {
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      Mesh& mesh = *meshes[i];
      if (mesh.topology != Topology::triangles) continue;
      Array<std::uint32_t>& index = mesh.index.wide;
      std::size_t kept = 0;
      for (const std::size_t end = triangle + index.size() / 3; triangle < end; ++triangle) {
        if (corner_[3 * triangle].vertex == none) continue;
        for (std::size_t c = 0; c < 3; ++c) index[kept++] = corner_[3 * triangle + c].vertex - first_[i];
      }
      if (kept < index.size()) mesh.cache_ordered = false;
      index.resize(kept);
    }
  }

 private:
  using Ring = std::array<std::uint32_t, 2 * most_faces>;

  struct Corner {
    std::uint32_t vertex;  ///< none where the triangle is removed
    std::uint32_t point;
    std::uint32_t next;  ///< the next corner of the same point
  };

  /// What a collapse needs of a point, together in memory.
  struct Point {
    glm::dvec3 at{0};
    Quadric quadric;
    double bound = infinite;    ///< no collapse costs less
    std::uint32_t head = none;  ///< its first corner
    std::uint32_t stamp = 0;    ///< the number of changes around it
    std::uint32_t seen = 0;     ///< the last mark of neighbours()
    bool is_locked = false, is_border = false;
    bool is_waiting = false;  ///< the heap has its bound
  };

  /// Checks the deadline at each 4,096th call.
  void look() {
    if (++steps_ % 4'096 == 0) job_.check();
  }

  void read(std::span<Mesh* const> meshes, const std::vector<bool>& fixed) {
    std::size_t vertices = 0, corners = 0;
    for (const Mesh* mesh : meshes) {
      if (mesh->topology != Topology::triangles) continue;
      vertices += mesh->position.size();
      corners += mesh->index.size();
    }
    position_.reserve(vertices);
    normal_.reserve(vertices);
    is_fixed_.reserve(vertices);
    corner_.reserve(corners);
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      job_.check();
      first_.push_back(static_cast<std::uint32_t>(position_.size()));
      const Mesh& mesh = *meshes[i];
      if (mesh.topology != Topology::triangles) continue;
      for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        look();
        position_.push_back(mesh.position[v] + 0.0F);
        normal_.push_back(mesh.normal.empty() ? glm::vec3(0) : mesh.normal[v]);
        is_fixed_.push_back(fixed[i] ? 1 : 0);
      }
      for (std::size_t c = 0; c < mesh.index.size(); ++c) {
        look();
        corner_.push_back({first_.back() + mesh.index.at(c), none, none});
      }
    }
    left_ = corner_.size() / 3;
  }

  /// Points are numbered in the order of their first vertices, which keeps neighbours close in memory.
  void find_points() {
    const PositionNumbers points = position_numbers(position_, job_);
    points_ = Array<Point>(job_, points.first.size(), Point{});
    for (std::size_t i = 0; i < points_.size(); ++i) points_[i].at = glm::dvec3(position_[points.first[i]]);
    for (std::size_t v = 0; v < position_.size(); ++v) {
      look();
      if (is_fixed_[v] != 0) points_[points.number[v]].is_locked = true;
    }
    for (std::size_t c = corner_.size(); c-- > 0;) {
      look();
      Corner& corner = corner_[c];
      corner.point = points.number[corner.vertex];
      corner.next = std::exchange(points_[corner.point].head, static_cast<std::uint32_t>(c));
    }
  }

  std::uint32_t point(std::size_t corner) const { return corner_[corner].point; }
  std::uint32_t next(std::uint32_t corner) const { return corner_[corner].next; }
  const glm::dvec3& at(std::uint32_t point) const { return points_[point].at; }

  /// The number of triangles with both points.
  std::uint32_t faces_on(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t count = 0;
    for (std::uint32_t c = points_[a].head; c != none; c = next(c)) {
      count += point(after(c)) == b || point(before(c)) == b ? 1U : 0U;
    }
    return count;
  }

  void measure() {
    for (std::size_t t = 0; t < corner_.size(); t += 3) {
      look();
      const glm::dvec3 &a = at(point(t)), &b = at(point(t + 1)), &c = at(point(t + 2));
      const glm::dvec3 across = glm::cross(b - a, c - a);
      const double length = std::sqrt(glm::dot(across, across));
      if (!(length > 0)) continue;
      const glm::dvec3 n = across / length;
      for (std::size_t i = 0; i < 3; ++i) {
        points_[point(t + i)].quadric.add(n, -glm::dot(n, a), length);
        measure_edge(t + i, n);
      }
    }
  }

  /// Adds a plane perpendicular to a border edge. Locks edges with more than two triangles.
  void measure_edge(std::size_t corner, const glm::dvec3& n) {
    const std::uint32_t a = point(corner), b = point(after(corner));
    const std::uint32_t faces = faces_on(a, b);
    if (faces > 2) points_[a].is_locked = points_[b].is_locked = true;
    if (faces != 1) return;
    points_[a].is_border = points_[b].is_border = true;
    const glm::dvec3 edge = at(b) - at(a), out = glm::cross(edge, n);
    const double length = std::sqrt(glm::dot(out, out));
    if (!(length > 0)) return;
    for (const std::uint32_t each : {a, b}) {
      points_[each].quadric.add(out / length, -glm::dot(out / length, at(a)),
                                border_weight * length * length);
    }
  }

  /// Collects the neighbours of a point, each once, and marks them with ++mark_. Returns 0 where there are too many.
  template <class MarkOf>
  std::uint32_t neighbours(std::uint32_t of, Ring& ring, const MarkOf& mark_of) {
    std::uint32_t count = 0, faces = 0;
    const std::uint32_t mark = ++mark_;
    for (std::uint32_t c = points_[of].head; c != none; c = next(c)) {
      if (++faces > most_faces) return 0;
      for (const std::uint32_t each : {point(after(c)), point(before(c))}) {
        if (std::exchange(mark_of(each), mark) != mark) ring[count++] = each;
      }
    }
    return count;
  }

  std::uint32_t neighbours(std::uint32_t of, Ring& ring) {
    return neighbours(
        of, ring, [this](std::uint32_t each) -> auto& { return points_[each].seen; });
  }

  double cost_of(std::uint32_t from, std::uint32_t to) const {
    return collapse_cost(points_[from].quadric, points_[to].quadric, at(from), at(to));
  }

  /// Of all collapses of a point, allowed or not.
  double least_cost(std::uint32_t from) {
    if (points_[from].head == none || points_[from].is_locked) return infinite;
    Ring ring;
    const std::uint32_t count = neighbours(from, ring);
    double least = infinite;
    for (std::uint32_t i = 0; i < count; ++i) least = std::min(least, cost_of(from, ring[i]));
    return least;
  }

  /// Pushes the bound of a point to the heap unless it is there.
  void wait(std::uint32_t from) {
    if (points_[from].is_waiting || !(points_[from].bound < infinite)) return;
    points_[from].is_waiting = true;
    push({points_[from].bound, from, none, ++points_[from].stamp});
  }

  /// The cheapest allowed collapse of a point, or one onto `none`.
  CollapseCandidate candidate(std::uint32_t from) {
    Ring ring;
    const std::uint32_t count = neighbours(from, ring);
    const std::uint32_t mark = mark_;
    std::array<CollapsePath, 2 * most_faces> paths;
    for (std::uint32_t i = 0; i < count; ++i) paths[i] = {cost_of(from, ring[i]), ring[i]};
    points_[from].bound = infinite;
    for (std::uint32_t i = 0; i < count; ++i) {
      std::swap(paths[i], *std::min_element(paths.begin() + i, paths.begin() + count));
      if (i == 0) points_[from].bound = paths[0].cost;
      if (may_collapse(from, paths[i].to, mark))
        return {paths[i].cost, from, paths[i].to, points_[from].stamp};
    }
    return {infinite, from, none, 0};
  }

  void push(const CollapseCandidate& candidate) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// `mark` marks the neighbours of `from` in Point::seen.
  bool may_collapse(std::uint32_t from, std::uint32_t to, std::uint32_t mark) {
    const std::uint32_t faces = faces_on(from, to);
    if (faces == 0 || faces > 2 || (points_[from].is_border && faces != 1)) return false;
    if (!points_[from].is_border && faces == 1) return false;
    Ring other;
    const std::uint32_t others = neighbours(
        to, other, [this](std::uint32_t each) -> auto& { return beside_[each]; });
    std::uint32_t common = 0;
    for (std::uint32_t i = 0; i < others; ++i) common += points_[other[i]].seen == mark ? 1U : 0U;
    return common == faces && keeps_faces(from, to);
  }

  /// The vertex of the point `to` that replaces one of the point `from`, or `none` where it is not unique.
  std::uint32_t heir(std::uint32_t vertex, std::uint32_t from, std::uint32_t to) const {
    std::uint32_t found = none;
    for (std::uint32_t c = points_[from].head; c != none; c = next(c)) {
      if (corner_[c].vertex != vertex) continue;
      for (const std::size_t each : {after(c), before(c)}) {
        if (point(each) != to) continue;
        if (found != none && found != corner_[each].vertex) return none;
        found = corner_[each].vertex;
      }
    }
    return found;
  }

  bool keeps_faces(std::uint32_t from, std::uint32_t to) const {
    bool any = false;
    for (std::uint32_t c = points_[from].head; c != none; c = next(c)) {
      const std::uint32_t b = point(after(c)), d = point(before(c));
      const std::uint32_t vertex = heir(corner_[c].vertex, from, to);
      if (vertex == none) return false;
      if (b == to || d == to) continue;
      any = true;
      const std::array<std::uint32_t, 3> corners = {vertex, corner_[after(c)].vertex,
                                                    corner_[before(c)].vertex};
      if (!is_sound(from, to, {b, d}, corners) || is_there(to, b, d)) return false;
    }
    return any;
  }

  bool is_sound(std::uint32_t from, std::uint32_t to, std::pair<std::uint32_t, std::uint32_t> rest,
                const std::array<std::uint32_t, 3>& corners) const {
    const glm::dvec3 &b = at(rest.first), &d = at(rest.second);
    if (!keeps_shape(at(from), at(to), b, d)) return false;
    const glm::dvec3 now = glm::cross(b - at(to), d - at(to));
    for (const std::uint32_t corner : corners) {
      const glm::dvec3 n(normal_[corner]);
      if (n != glm::dvec3(0) && !(glm::dot(n, now) > 0)) return false;
    }
    return true;
  }

  /// True where a triangle of these three points exists.
  bool is_there(std::uint32_t a, std::uint32_t b, std::uint32_t d) const {
    for (std::uint32_t c = points_[a].head; c != none; c = next(c)) {
      const std::uint32_t x = point(after(c)), y = point(before(c));
      if ((x == b && y == d) || (x == d && y == b)) return true;
    }
    return false;
  }

  void drop(std::size_t triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t c = 3 * triangle + i;
      std::uint32_t* link = &points_[point(c)].head;
      while (*link != c) link = &corner_[*link].next;
      *link = corner_[c].next;
    }
    for (std::size_t i = 0; i < 3; ++i) corner_[3 * triangle + i].vertex = none;
    --left_;
  }

  void collapse(std::uint32_t from, std::uint32_t to) {
    heirs_.clear();
    gone_.clear();
    for (std::uint32_t c = points_[from].head; c != none; c = next(c)) {
      if (point(after(c)) == to || point(before(c)) == to) {
        gone_.push_back(c / 3);
      } else {
        heirs_.emplace_back(c, heir(corner_[c].vertex, from, to));
      }
    }
    for (const std::uint32_t triangle : gone_) drop(triangle);
    for (const auto& [c, vertex] : heirs_) {
      corner_[c] = {vertex, to, std::exchange(points_[to].head, c)};
    }
    points_[from].head = none;
    points_[to].quadric.add(points_[from].quadric);
    points_[to].bound = infinite;
    const std::uint32_t mark = ++mark_;
    for (std::uint32_t c = points_[to].head; c != none; c = next(c)) {  // all, even more than `most_faces`
      for (const std::uint32_t each : {point(after(c)), point(before(c))}) {
        if (std::exchange(points_[each].seen, mark) == mark) continue;
        if (!points_[to].is_locked) points_[to].bound = std::min(points_[to].bound, cost_of(to, each));
        refresh(each, cost_of(each, to));
      }
    }
    points_[to].is_waiting = false;
    wait(to);
  }

  /// Something has changed around a point: another collapse may be allowed or cheaper, at this cost or a known one.
  void refresh(std::uint32_t of, double cost) {
    if (points_[of].is_locked || points_[of].head == none) return;
    if (cost < points_[of].bound) {
      points_[of].bound = cost;
      points_[of].is_waiting = false;
    }
    wait(of);
  }

  Job& job_;
  Array<glm::vec3> position_{job_}, normal_{job_};  ///< by vertex
  Array<std::uint8_t> is_fixed_{job_};              ///< by vertex
  Array<Corner> corner_{job_};
  Array<Point> points_{job_};
  Array<CollapseCandidate> heap_{job_};
  Array<std::uint32_t> beside_{job_};  ///< by point: the last mark of the neighbours of a target
  std::uint32_t mark_ = 0;
  std::size_t steps_ = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> heirs_;  ///< new vertex of each corner that moves
  std::vector<std::uint32_t> gone_, first_;                     ///< triangles; vertex of each mesh
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
