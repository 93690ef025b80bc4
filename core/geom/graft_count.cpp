#include "core/geom/graft_count.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/chains.h"
#include "core/geom/graft_axis.h"
#include "core/geom/graft_writer.h"

namespace seedmesh {
namespace {

// As graft() has them: see graft_plan.cpp and graft_writer.cpp.
constexpr double corner_power = 0.3;
constexpr int least_opened_sides = 6;
constexpr float straight = 0.9877F, radius_off = 0.05F;
constexpr float least_opened = 3, least_length = 60, fork_share = 0.55F;
constexpr std::uint32_t fork_bit = 1U << 24U;  ///< limbs at one joint are fewer

class Counter {
 public:
  Counter(const Limbs& limbs, const GraftOptions& options, Job& job)
      : limbs_(limbs),
        options_(options),
        scale_(scale_of(limbs, with_ribs(options, options.sides))),
        chains_(link_chains(limbs, job)),
        openings_(job, limbs.size(), 0U),
        has_loop_(job, limbs.size(), std::uint8_t{0}) {
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
    }
  }

  std::uint64_t run(Job& job) {
    for (const std::uint32_t head : chains_.head) {
      if (!is_opened(head)) continue;
      const std::uint32_t joint = limbs_.parent[head];
      const auto sides = static_cast<std::uint32_t>(loop_sides(head));
      // A fork shares half of its rings with the limb that it leaves.
      const bool is_fork = limbs_.base_radius[head] >= fork_share * limbs_.radius[joint];
      if (is_fork && openings_[joint] >= fork_bit) continue;  // a joint has room for one
      openings_[joint] += is_fork ? fork_bit : sides;
      has_loop_[head] = 1;
    }
    std::uint64_t triangles = 0, limb = 0;
    for (const std::uint32_t head : chains_.head) {
      if (++limb % 1024 == 0) job.check();
      triangles += count(head);
    }
    return triangles;
  }

 private:
  int corners(float radius) const {
    const double share = thickest_ > 0 ? static_cast<double>(std::min(1.0F, radius / thickest_)) : 1;
    const int wanted = math::to_int32(options_.sides * math::pow(std::max(share, 1e-6), corner_power) + 0.5);
    if (wanted <= 3) return 3;
    return wanted != options_.sides ? wanted + wanted % 2 : wanted;
  }
  int loop_sides(std::uint32_t head) const { return std::max(4, corners(limbs_.base_radius[head])); }

  /// A branch in the middle of its parent, thick enough.
  bool is_opened(std::uint32_t head) const {
    const std::uint32_t parent = limbs_.parent[head];
    if (!options_.weld || parent == Limbs::none || chains_.next[parent] == Limbs::none) return false;
    if (limbs_.parent[parent] == Limbs::none) return false;
    return limbs_.base_radius[head] >=
           std::max({least_opened * scale_.thinnest, options_.thinnest, options_.thinnest_joint});
  }

  std::uint64_t count(std::uint32_t head) {
    if (!axis_.read(limbs_, chains_, head, scale_.shortest)) return 0;
    if (axis_.radius[0] < std::max(2 * scale_.thinnest, options_.thinnest)) return 0;
    const bool is_root = limbs_.parent[head] == Limbs::none, has_loop = has_loop_[head] != 0;
    if (!is_root && !has_loop &&
        axis_.length() < std::max(limbs_.radius[limbs_.parent[head]], least_length * scale_.apart))
      return 0;
    int least = axis_.order == 0 && options_.lobes > 0 ? with_ribs(options_, 3) : 3;
    for (std::size_t point = 1; point + 1 < axis_.point.size(); ++point) {
      if (openings_[axis_.joint[point]] > 0) least = std::max(least, least_opened_sides);
    }
    const auto sides = [&](float radius) {
      return static_cast<std::uint64_t>(std::max(least, corners(radius)));
    };
    std::uint64_t below = has_loop ? static_cast<std::uint64_t>(loop_sides(head)) : sides(axis_.radius[0]);
    std::uint64_t triangles = has_loop ? 0 : below;  // the end that is closed
    const auto ring = [&](float radius) {
      const std::uint64_t corners = sides(radius);
      triangles += below + corners;
      below = corners;
    };
    if (has_loop && below > 4) ring(axis_.radius[0]);
    float last_at = 0, last_radius = axis_.radius[0];
    glm::vec3 heading = axis_.along[0];
    for (std::size_t point = 1; point < axis_.pieces(); ++point) {
      const float share = (axis_.at[point] - last_at) / (axis_.at[point + 1] - last_at);
      const float between = last_radius + (axis_.radius[point + 1] - last_radius) * share;
      const bool turns = glm::dot(heading, axis_.along[point]) < straight;
      const std::uint32_t opening = openings_[axis_.joint[point]];
      if (opening == 0 && !turns &&
          std::abs(between - axis_.radius[point]) < radius_off * axis_.radius[point])
        continue;
      ring(axis_.radius[point]);
      triangles += opening % fork_bit;
      // Where limbs leave at a bend, the bend has a ring of its own.
      if (opening % fork_bit > 0 && turns) ring(axis_.radius[point]);
      last_at = axis_.at[point];
      last_radius = axis_.radius[point];
      heading = axis_.along[point];
    }
    ring(axis_.radius.back());
    return triangles + below;
  }

  const Limbs& limbs_;
  const GraftOptions& options_;
  Scale scale_;
  Chains chains_;
  Array<std::uint32_t> openings_;  ///< of each joint, the corners of all loops there
  Array<std::uint8_t> has_loop_;   ///< of each joint that begins a limb, whether it grows out of another
  GraftAxis axis_;
  float thickest_ = 0;
};

}  // namespace

std::uint64_t graft_triangles(const Limbs& limbs, const GraftOptions& options, Job& job) {
  return limbs.size() == 0 ? 0 : Counter(limbs, options, job).run(job);
}

}  // namespace seedmesh
