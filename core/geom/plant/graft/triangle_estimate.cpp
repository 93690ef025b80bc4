#include "core/geom/plant/graft/triangle_estimate.h"

#include <algorithm>
#include <cmath>

#include "core/geom/plant/chains.h"
#include "core/geom/plant/graft/limb_axis.h"
#include "core/geom/plant/graft/limb_writer.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t fork_flag = 1U << 24U;  ///< added to the number of loop corners, which is less

class Estimate {
 public:
  Estimate(const Limbs& limbs, const GraftOptions& options, Job& job)
      : limbs_(limbs),
        options_(options),
        scale_(scale_of(limbs, ribbed_corners(options, options.sides))),
        chains_(link_chains(limbs, job)),
        openings_(job, limbs.size(), 0U),
        has_loop_(job, limbs.size(), std::uint8_t{0}),
        thickest_(thickest_base(limbs)) {}

  std::uint64_t run(Job& job) {
    for (const std::uint32_t head : chains_.head) add_junction(head);
    std::uint64_t triangles = 0, limb = 0;
    for (const std::uint32_t head : chains_.head) {
      if (++limb % 1024 == 0) job.check();
      triangles += count(head);
    }
    return triangles;
  }

 private:
  int corners(float radius) const {
    return corners_by_radius(radius, thickest_, options_.sides, options_.corner_exponent);
  }
  int loop_corners(std::uint32_t head) const { return std::max(4, corners(limbs_.base_radius[head])); }

  /// A branch in the middle of its parent that is thick enough to be welded.
  bool is_welded(std::uint32_t head) const {
    const std::uint32_t parent = limbs_.parent[head];
    if (!options_.weld || parent == Limbs::none || chains_.next[parent] == Limbs::none) return false;
    if (limbs_.parent[parent] == Limbs::none) return false;
    return limbs_.base_radius[head] >=
           std::max({least_opened_radius * scale_.thinnest, options_.thinnest, options_.thinnest_joint});
  }

  void add_junction(std::uint32_t head) {
    if (!is_welded(head)) return;
    const std::uint32_t joint = limbs_.parent[head];
    // A fork shares half of its rings with its parent, and a joint has at most one fork.
    const bool is_fork = limbs_.base_radius[head] >= fork_share * limbs_.radius[joint];
    if (is_fork && openings_[joint] >= fork_flag) return;
    openings_[joint] += is_fork ? fork_flag : static_cast<std::uint32_t>(loop_corners(head));
    has_loop_[head] = 1;
  }

  /// The triangles of one limb.
  std::uint64_t count(std::uint32_t head) {
    if (!axis_.read(limbs_, chains_, head, scale_.shortest)) return 0;
    if (axis_.radius[0] < std::max(2 * scale_.thinnest, options_.thinnest)) return 0;
    const bool is_root = limbs_.parent[head] == Limbs::none, has_loop = has_loop_[head] != 0;
    if (!is_root && !has_loop &&
        axis_.length() < std::max(limbs_.radius[limbs_.parent[head]], least_closed_length * scale_.apart))
      return 0;
    int least = axis_.order == 0 && options_.lobes > 0 ? ribbed_corners(options_, 3) : 3;
    for (std::size_t point = 1; point + 1 < axis_.point.size(); ++point) {
      if (openings_[axis_.joint[point]] > 0) least = std::max(least, least_opened_corners);
    }
    const auto sides = [&](float radius) {
      return static_cast<std::uint64_t>(std::max(least, corners(radius)));
    };
    std::uint64_t below = has_loop ? static_cast<std::uint64_t>(loop_corners(head)) : sides(axis_.radius[0]);
    std::uint64_t triangles = has_loop ? 0 : below;  // the closed end
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
      const bool turns = glm::dot(heading, axis_.along[point]) < straight_cosine;
      const std::uint32_t opening = openings_[axis_.joint[point]];
      if (opening == 0 && !turns &&
          std::abs(between - axis_.radius[point]) < radius_tolerance * axis_.radius[point])
        continue;
      ring(axis_.radius[point]);
      triangles += opening % fork_flag;
      // A bend with collars has a ring of its own as well.
      if (opening % fork_flag > 0 && turns) ring(axis_.radius[point]);
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
  Array<std::uint32_t> openings_;  ///< of each joint, the corners of all collars there, and fork_flag
  Array<std::uint8_t> has_loop_;   ///< of the first joint of each limb
  LimbAxis axis_;
  float thickest_;
};

}  // namespace

std::uint64_t graft_triangles(const Limbs& limbs, const GraftOptions& options, Job& job) {
  return limbs.size() == 0 ? 0 : Estimate(limbs, options, job).run(job);
}

}  // namespace seedmesh
