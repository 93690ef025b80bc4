#include "core/geom/crowd.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
// Cells are so many reaches wide, so that few points have to look into a second one.
constexpr double cell_width = 8;

/// Gives points nearer than the reach to an earlier one that one's number.
class Welder {
 public:
  Welder(double reach, std::size_t most, const Job& job)
      : reach_(reach), first_(job), next_(job), points_(job) {
    std::size_t size = 16;
    while (size < 2 * most) size *= 2;
    first_ = Array<std::uint32_t>(job, size, none);
    next_.reserve(most);
    points_.reserve(most);
  }

  std::uint32_t number(const glm::vec3& point) {
    const glm::dvec3 at = glm::dvec3(point) / (cell_width * reach_);
    const glm::dvec3 low = glm::floor(at - 1 / cell_width), high = glm::floor(at + 1 / cell_width);
    for (double z = low.z; z <= high.z; ++z) {
      for (double y = low.y; y <= high.y; ++y) {
        for (double x = low.x; x <= high.x; ++x) {
          for (std::uint32_t id = first_[slot({x, y, z})]; id != none; id = next_[id]) {
            const glm::dvec3 apart = glm::dvec3(points_[id]) - glm::dvec3(point);
            if (glm::dot(apart, apart) <= reach_ * reach_) return id;
          }
        }
      }
    }
    const auto id = static_cast<std::uint32_t>(points_.size());
    std::uint32_t& first = first_[slot(glm::floor(at))];
    next_.push_back(first);
    first = id;
    points_.push_back(point);
    return id;
  }

 private:
  std::size_t slot(const glm::dvec3& cell) const {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis)
      key = mix(key ^ static_cast<std::uint64_t>(math::to_int64(cell[axis])));
    return key & (first_.size() - 1);
  }

  double reach_;
  Array<std::uint32_t> first_, next_;
  Array<glm::vec3> points_;
};

}  // namespace

bool is_crowded(const Mesh& mesh, float reach, const Job& job) {
  if (mesh.position.empty() || !(reach > 0)) return false;
  Welder welder(static_cast<double>(reach), mesh.position.size(), job);
  Array<std::uint32_t> id(job, mesh.position.size());
  for (std::size_t i = 0; i < id.size(); ++i) {
    if (i % 4096 == 0) job.check();
    id[i] = welder.number(mesh.position[i]);
  }
  // The lower end, the higher, and in the last bit the direction.
  Array<std::uint64_t> edges(job);
  edges.reserve(mesh.index.size());
  for (std::size_t t = 0; t + 2 < mesh.index.size(); t += 3) {
    const std::uint32_t corner[3] = {id[mesh.index.at(t)], id[mesh.index.at(t + 1)],
                                     id[mesh.index.at(t + 2)]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[0] == corner[2]) continue;
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t p = corner[k], q = corner[(k + 1) % 3];
      edges.push_back(std::min(p, q) << 33U | std::max(p, q) << 1U | (p < q ? 1U : 0U));
    }
  }
  job.check();
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t times = 0, upward = 0;
    for (const std::uint64_t edge = edges[i] >> 1U; i < edges.size() && edges[i] >> 1U == edge; ++i, ++times)
      upward += edges[i] & 1U;
    if (times > 2 || (times == 2 && upward != 1)) return true;
  }
  return false;
}

}  // namespace seedmesh
