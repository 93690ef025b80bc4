#pragma once
/// Skeletons for tests, joint by joint or at random.
#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/plant/frame.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh {

class SkeletonMaker {
 public:
  explicit SkeletonMaker(const Job& job) : limbs(job) {}

  std::uint32_t root(const glm::vec3& at) { return add(Limbs::none, at, {0, 0}, 0); }
  /// An internode that continues the limb of `parent`; `radii` at its near and its far end.
  std::uint32_t grow(std::uint32_t parent, const glm::vec3& to, glm::vec2 radii) {
    return add(parent, to, radii, 0);
  }
  std::uint32_t branch(std::uint32_t parent, const glm::vec3& to, glm::vec2 radii) {
    return add(parent, to, radii, 1);
  }

  Limbs limbs;
  std::int16_t color = 0;

 private:
  std::uint32_t add(std::uint32_t parent, const glm::vec3& to, glm::vec2 radii, std::uint8_t starts_limb) {
    limbs.position.push_back(to);
    limbs.base_radius.push_back(radii.x);
    limbs.radius.push_back(radii.y);
    limbs.parent.push_back(parent);
    limbs.starts_limb.push_back(starts_limb);
    limbs.color.push_back(color);
    limbs.order.push_back(0);
    return static_cast<std::uint32_t>(limbs.size() - 1);
  }
};

/// A limb through the points, all of one radius.
inline Limbs limb_through(const Job& job, const std::vector<glm::vec3>& points, float radius) {
  SkeletonMaker maker(job);
  std::uint32_t joint = maker.root(points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) joint = maker.grow(joint, points[i], {radius, radius});
  return std::move(maker.limbs);
}

/// Limbs that turn about at random: sharp and gentle bends, steep and gentle taper, radii of 0, internodes of
/// no length, side branches, several at one place, some drawn twice, several colours.
inline Limbs random_limbs(const Job& job, std::uint64_t seed) {
  Rng rng(seed);
  SkeletonMaker maker(job);
  const double wildness = rng.uniform(0.05, 3.2);
  const double thickness = rng.uniform(0.005, 0.4);
  const bool on_lattice = rng.below(4) == 0;
  std::vector<std::pair<std::uint32_t, Frame>> ends{{maker.root({0, 0, 0}), Frame{}}};
  const std::uint32_t count = 1 + rng.below(60);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t chosen = rng.below(3) ? static_cast<std::uint32_t>(ends.size() - 1)
                                              : rng.below(static_cast<std::uint32_t>(ends.size()));
    auto [joint, frame] = ends[chosen];
    const auto angle = [&] {
      return on_lattice ? math::sincos_degrees(90.0 * rng.below(4))
                        : math::sincos(rng.uniform(-wildness, wildness));
    };
    if (rng.below(5)) frame = roll(turn(frame, angle()), angle());
    double length = on_lattice ? 1 : rng.uniform(0.02, 1.5);
    if (rng.below(12) == 0) length = 0;
    glm::vec2 radii(static_cast<float>(thickness * (on_lattice ? 1 : rng.uniform(0.2, 1))));
    if (rng.below(3) == 0) radii.y = static_cast<float>(thickness * rng.uniform(0, 1));
    if (rng.below(15) == 0) radii.y = 0;
    if (rng.below(15) == 0) radii.x = 0;
    if (rng.below(8) == 0) maker.color = static_cast<std::int16_t>(rng.below(3));
    const glm::vec3 to = maker.limbs.position[joint] + glm::vec3(frame.heading * length);
    const bool is_branch = chosen + 1 != ends.size() || rng.below(6) == 0;
    const std::uint32_t end = is_branch ? maker.branch(joint, to, radii) : maker.grow(joint, to, radii);
    if (rng.below(10) == 0) ends.emplace_back(maker.branch(joint, to, radii), frame);
    ends.emplace_back(end, frame);
  }
  return std::move(maker.limbs);
}

}  // namespace seedmesh
