#include "core/geom/mesh/manifold_check.h"

#include <algorithm>
#include <cstdint>

#include "core/base/array.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
// Width of a cell in radii: wide, so that few points need a second cell.
constexpr double cell_width = 8;
// Cells farther out are treated as one.
constexpr double most_cell = 1e15;
// Up to this number, the edges of a point are compared in pairs; more are sorted.
constexpr std::uint32_t few = 24;

/// floor(x) for x well inside the range of the type.
std::int64_t floor_of(double x) {
  const auto whole = static_cast<std::int64_t>(x);
  return whole - (static_cast<double>(whole) > x ? 1 : 0);
}

/// Numbers points so that a point within the radius of an earlier one gets the same number.
class Welder {
 public:
  Welder(double reach, std::size_t most, const Job& job)
      : squared_(reach * reach), by_cell_(1 / (cell_width * reach)), next_(job), points_(job) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    first_ = Array<std::uint32_t>(job, size, none);
    mask_ = size - 1;
    next_.reserve(most);
    points_.reserve(most);
  }

  std::uint32_t number(const glm::vec3& point) {
    const glm::dvec3 at = glm::dvec3(point) * by_cell_;
    std::int64_t low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double bounded = at[axis] > -most_cell ? std::min(at[axis], most_cell) : -most_cell;
      low[axis] = floor_of(bounded - 1 / cell_width);
      high[axis] = floor_of(bounded + 1 / cell_width);
      here_[axis] = floor_of(bounded);
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          for (std::uint32_t id = first_[slot(x, y, z)]; id != none; id = next_[id]) {
            const glm::dvec3 apart = glm::dvec3(points_[id]) - glm::dvec3(point);
            if (glm::dot(apart, apart) <= squared_) return id;
          }
        }
      }
    }
    const auto id = static_cast<std::uint32_t>(points_.size());
    std::uint32_t& first = first_[slot(here_[0], here_[1], here_[2])];
    next_.push_back(first);
    first = id;
    points_.push_back(point);
    return id;
  }
  std::size_t size() const { return points_.size(); }

 private:
  std::size_t slot(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::uint64_t key = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^
                              static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU ^
                              static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U;
    return (key ^ key >> 29U) * 0xBF58476D1CE4E5B9U >> 20U & mask_;
  }

  double squared_, by_cell_;
  std::int64_t here_[3] = {0, 0, 0};
  std::size_t mask_ = 0;
  Array<std::uint32_t> first_, next_;
  Array<glm::vec3> points_;
};

/// Calls each(from, to) for the three edges of every triangle that is not degenerate after welding.
template <class Each>
void for_edges(const Mesh& mesh, const Array<std::uint32_t>& id, const Each& each) {
  for (std::size_t t = 0; t + 2 < mesh.index.size(); t += 3) {
    const std::uint32_t corner[3] = {id[mesh.index.at(t)], id[mesh.index.at(t + 1)],
                                     id[mesh.index.at(t + 2)]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[0] == corner[2]) continue;
    each(corner[0], corner[1]);
    each(corner[1], corner[2]);
    each(corner[2], corner[0]);
  }
}

bool has_twice(std::uint32_t* ends, std::uint32_t count) {
  if (count > few) {
    std::sort(ends, ends + count);
    return std::adjacent_find(ends, ends + count) != ends + count;
  }
  for (std::uint32_t i = 1; i < count; ++i) {
    for (std::uint32_t k = 0; k < i; ++k) {
      if (ends[k] == ends[i]) return true;
    }
  }
  return false;
}

}  // namespace

bool has_nonmanifold_edges(const Mesh& mesh, float reach, const Job& job) {
  if (mesh.position.empty() || !(reach > 0)) return false;
  const std::size_t count = mesh.position.size();
  Array<std::uint32_t> id(job, count);
  std::size_t points = 0;
  {
    Welder welder(static_cast<double>(reach), count, job);
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 4096 == 0) job.check();
      id[i] = welder.number(mesh.position[i]);
    }
    points = welder.size();
  }
  // More than two triangles at an edge, or two that disagree, give a directed edge that occurs twice. The
  // edges are sorted by their first point.
  Array<std::uint32_t> first(job, points + 1, 0U);
  for_edges(mesh, id, [&](std::uint32_t from, std::uint32_t) { ++first[from]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& each : first) {
    sum += each;
    each = sum;
  }
  Array<std::uint32_t> end(job, sum);
  for_edges(mesh, id, [&](std::uint32_t from, std::uint32_t to) { end[--first[from]] = to; });
  for (std::size_t i = 0; i < points; ++i) {
    if (i % 4096 == 0) job.check();
    if (has_twice(end.data() + first[i], first[i + 1] - first[i])) return true;
  }
  return false;
}

}  // namespace seedmesh
