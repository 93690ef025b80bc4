/// Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997; half-edge
/// collapse with the link condition of Dey et al., "Topology Preserving Edge Contraction", 1999.
#include "core/geom/lod/simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/array.h"
#include "core/geom/lod/quadric.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double border_weight = 10;      ///< of planes perpendicular to a border, against those of faces
constexpr std::uint32_t most_faces = 96;  ///< at a vertex; vertices with more stay

/// All meshes as one surface. Vertices at the same position are one point. A corner is an entry of the index
/// array; the corners of a point are a linked list.
class Net {
 public:
  Net(std::span<Mesh* const> meshes, const std::vector<bool>& fixed, Job& job) : job_(job) {
    read(meshes, fixed);
    find_points();
    link();
    measure();
  }

  /// Collapses are examined only when the bound of their cost is the least of all, so that most of the changes around
  /// a point cost one quadric.
  std::uint64_t reduce(std::uint64_t target, double most_cost) {
    seen_ = beside_ = std::vector<std::uint32_t>(head_.size(), 0);
    is_waiting_.assign(head_.size(), false);
    bound_.resize(head_.size());
    for (std::uint32_t point = 0; point < head_.size(); ++point) {
      look();
      bound_[point] = least_cost(point);
      if (!(bound_[point] < infinite)) continue;
      is_waiting_[point] = true;
      heap_.push_back({bound_[point], point, none, stamp_[point]});
    }
    std::make_heap(heap_.begin(), heap_.end(), [&](const auto& a, const auto& b) {
      look();
      return a < b;
    });
    for (std::uint64_t step = 1; left_ > target && heap_.size() > 0; ++step) {
      if (step % 1024 == 0) job_.check();
      std::pop_heap(heap_.begin(), heap_.end());
      CollapseCandidate best = heap_.back();
      heap_.pop_back();
      if (head_[best.from] == none || best.stamp != stamp_[best.from]) continue;
      if (best.to == none) {
        is_waiting_[best.from] = false;
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
        if (corner_[3 * triangle] == none) continue;
        for (std::size_t c = 0; c < 3; ++c) index[kept++] = corner_[3 * triangle + c] - first_[i];
      }
      if (kept < index.size()) mesh.cache_ordered = false;
      index.resize(kept);
    }
  }

 private:
  using Ring = std::array<std::uint32_t, 2 * most_faces>;

  /// Checks the deadline at each 4,096th call.
  void look() {
    if (++looks_ % 4'096 == 0) job_.check();
  }

  void read(std::span<Mesh* const> meshes, const std::vector<bool>& fixed) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      job_.check();
      first_.push_back(static_cast<std::uint32_t>(position_.size()));
      const Mesh& mesh = *meshes[i];
      if (mesh.topology != Topology::triangles) continue;
      for (std::size_t v = 0; v < mesh.position.size(); ++v) {
        look();
        position_.push_back(mesh.position[v] + 0.0F);
        normal_.push_back(mesh.normal.empty() ? glm::vec3(0) : mesh.normal[v]);
        locked_.push_back(fixed[i] ? 1 : 0);
      }
      for (std::size_t c = 0; c < mesh.index.size(); ++c) {
        look();
        corner_.push_back(first_.back() + mesh.index.at(c));
      }
    }
    left_ = corner_.size() / 3;
  }

  /// Numbers the points. Afterwards `locked_` is indexed by point instead of vertex.
  void find_points() {
    Array<std::uint32_t> order(job_, position_.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [this](std::uint32_t v) {
      return std::tie(position_[v].x, position_[v].y, position_[v].z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      look();
      return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    point_of_.resize(position_.size());
    Array<std::uint8_t> locked(job_);
    for (std::size_t i = 0; i < order.size(); ++i) {
      look();
      if (i == 0 || key(order[i]) != key(order[i - 1])) {
        at_.emplace_back(position_[order[i]]);
        locked.push_back(0);
      }
      point_of_[order[i]] = static_cast<std::uint32_t>(at_.size() - 1);
      locked.back() = locked.back() | locked_[order[i]];
    }
    locked_ = std::move(locked);
  }

  void link() {
    head_ = Array<std::uint32_t>(job_, at_.size(), none);
    stamp_ = Array<std::uint32_t>(job_, at_.size(), 0U);
    next_.resize(corner_.size());
    point_.resize(corner_.size());
    for (std::size_t c = corner_.size(); c-- > 0;) {
      look();
      point_[c] = point_of_[corner_[c]];
      std::uint32_t& head = head_[point(c)];
      next_[c] = head;
      head = static_cast<std::uint32_t>(c);
    }
  }

  std::uint32_t point(std::size_t corner) const { return point_[corner]; }

  /// The number of triangles with both points.
  std::uint32_t faces_on(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t count = 0;
    for (std::uint32_t c = head_[a]; c != none; c = next_[c]) {
      count += point(after(c)) == b || point(before(c)) == b ? 1U : 0U;
    }
    return count;
  }

  void measure() {
    quadric_ = Array<Quadric>(job_, at_.size(), Quadric{});
    border_.assign(at_.size(), false);
    for (std::size_t t = 0; t < corner_.size(); t += 3) {
      look();
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

  /// Adds a plane perpendicular to a border edge. Locks edges with more than two triangles.
  void measure_edge(std::size_t corner, const glm::dvec3& n) {
    const std::uint32_t a = point(corner), b = point(after(corner));
    const std::uint32_t faces = faces_on(a, b);
    if (faces > 2) locked_[a] = locked_[b] = 1;
    if (faces != 1) return;
    border_[a] = border_[b] = true;
    const glm::dvec3 edge = at_[b] - at_[a], out = glm::cross(edge, n);
    const double length = std::sqrt(glm::dot(out, out));
    if (!(length > 0)) return;
    for (const std::uint32_t each : {a, b}) {
      quadric_[each].add(out / length, -glm::dot(out / length, at_[a]), border_weight * length * length);
    }
  }

  /// Collects the neighbours of a point, each once. Returns 0 where there are too many.
  std::uint32_t neighbours(std::uint32_t of, Ring& ring, std::vector<std::uint32_t>& marks) {
    std::uint32_t count = 0, faces = 0;
    const std::uint32_t mark = ++mark_;
    for (std::uint32_t c = head_[of]; c != none; c = next_[c]) {
      if (++faces > most_faces) return 0;
      for (const std::uint32_t each : {point(after(c)), point(before(c))}) {
        if (marks[each] == mark) continue;
        marks[each] = mark;
        ring[count++] = each;
      }
    }
    return count;
  }

  double cost_of(std::uint32_t from, std::uint32_t to) const {
    return collapse_cost(quadric_[from], quadric_[to], at_[from], at_[to]);
  }

  /// Of all collapses of a point, allowed or not.
  double least_cost(std::uint32_t from) {
    if (head_[from] == none || locked_[from] != 0) return infinite;
    Ring ring;
    const std::uint32_t count = neighbours(from, ring, seen_);
    double least = infinite;
    for (std::uint32_t i = 0; i < count; ++i) least = std::min(least, cost_of(from, ring[i]));
    return least;
  }

  /// Pushes the bound of a point to the heap unless it is there.
  void wait(std::uint32_t from) {
    if (is_waiting_[from] || !(bound_[from] < infinite)) return;
    is_waiting_[from] = true;
    push({bound_[from], from, none, ++stamp_[from]});
  }

  /// The cheapest allowed collapse of a point, or one onto `none`.
  CollapseCandidate candidate(std::uint32_t from) {
    Ring ring;
    const std::uint32_t count = neighbours(from, ring, seen_);
    const std::uint32_t mark = mark_;
    std::array<std::pair<double, std::uint32_t>, 2 * most_faces> paths;
    for (std::uint32_t i = 0; i < count; ++i) paths[i] = {cost_of(from, ring[i]), ring[i]};
    std::sort(paths.begin(), paths.begin() + count);
    bound_[from] = count > 0 ? paths[0].first : infinite;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (may_collapse(from, paths[i].second, mark))
        return {paths[i].first, from, paths[i].second, stamp_[from]};
    }
    return {infinite, from, none, 0};
  }

  void push(const CollapseCandidate& candidate) {
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// `mark` marks the neighbours of `from` in `seen_`.
  bool may_collapse(std::uint32_t from, std::uint32_t to, std::uint32_t mark) {
    const std::uint32_t faces = faces_on(from, to);
    if (faces == 0 || faces > 2 || (border_[from] && faces != 1)) return false;
    if (!border_[from] && faces == 1) return false;
    Ring other;
    const std::uint32_t others = neighbours(to, other, beside_);
    std::uint32_t common = 0;
    for (std::uint32_t i = 0; i < others; ++i) common += seen_[other[i]] == mark ? 1U : 0U;
    return common == faces && keeps_faces(from, to);
  }

  /// The vertex of the point `to` that replaces a vertex of the point `from`, or `none` where it is not
  /// unique.
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
    if (!keeps_shape(at_[from], at_[to], b, d)) return false;
    const glm::dvec3 now = glm::cross(b - at_[to], d - at_[to]);
    for (const std::uint32_t corner : corners) {
      const glm::dvec3 n(normal_[corner]);
      if (n != glm::dvec3(0) && !(glm::dot(n, now) > 0)) return false;
    }
    return true;
  }

  /// True where a triangle of these three points exists.
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
    heirs_.clear();
    gone_.clear();
    for (std::uint32_t c = head_[from]; c != none; c = next_[c]) {
      if (point(after(c)) == to || point(before(c)) == to) {
        gone_.push_back(c / 3);
      } else {
        heirs_.emplace_back(c, heir(corner_[c], from, to));
      }
    }
    for (const std::uint32_t triangle : gone_) drop(triangle);
    for (const auto& [c, vertex] : heirs_) {
      corner_[c] = vertex;
      point_[c] = to;
      next_[c] = head_[to];
      head_[to] = c;
    }
    head_[from] = none;
    quadric_[to].add(quadric_[from]);
    Ring ring;
    const std::uint32_t count = neighbours(to, ring, seen_);
    bound_[to] = infinite;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (locked_[to] == 0) bound_[to] = std::min(bound_[to], cost_of(to, ring[i]));
      refresh(ring[i], cost_of(ring[i], to));
    }
    is_waiting_[to] = false;
    wait(to);
  }

  /// Something has changed around a point: another collapse may be allowed or cheaper, at this cost or a known one.
  void refresh(std::uint32_t of, double cost) {
    if (locked_[of] != 0 || head_[of] == none) return;
    if (cost < bound_[of]) {
      bound_[of] = cost;
      is_waiting_[of] = false;
    }
    wait(of);
  }

  Job& job_;
  Array<glm::vec3> position_{job_}, normal_{job_};  ///< by vertex
  Array<std::uint32_t> corner_{job_};    ///< vertex of each corner; none where the triangle is removed
  Array<std::uint32_t> point_{job_};     ///< of each corner
  Array<std::uint32_t> point_of_{job_};  ///< of each vertex
  Array<std::uint32_t> next_{job_};      ///< the next corner of the same point
  Array<std::uint32_t> head_{job_};      ///< of each point: its first corner
  Array<std::uint32_t> stamp_{job_};     ///< of each point: the number of changes around it
  Array<std::uint8_t> locked_{job_};
  Array<Quadric> quadric_{job_};
  Array<CollapseCandidate> heap_{job_};
  std::vector<glm::dvec3> at_;
  std::vector<bool> border_;
  std::vector<double> bound_;                 ///< by point: no collapse costs less
  std::vector<bool> is_waiting_;              ///< by point: the heap has its bound
  std::vector<std::uint32_t> seen_, beside_;  ///< by point: the last mark of neighbours()
  std::uint32_t mark_ = 0;
  std::size_t looks_ = 0;
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
