#include "core/generators/tree/roots.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh::tree {
namespace {

// A root leaves the trunk at the joint whose height is nearest to `wanted_height` times the radius of the
// root. The height has to be above `least_height` times that radius, and below `most_height` times the radius
// of the trunk.
constexpr double least_height = 1.25, wanted_height = 1.6, most_height = 2.2;
// Number of pieces from the trunk to the ground and along the ground.
constexpr int pieces_down = 4, pieces_out = 8;
// Height of the axis above the flare and the ground, and its random change, as shares of the radius.
constexpr double over_ground = 0.25, undulation = 0.3;
// A root falls by `first_fall` until it is `first_step` outside the bark, measured where the flare is widest
// that its collar reaches: `collar_depth` below the joint. All are shares of its radius.
constexpr double first_fall = 0.7, first_step = 0.7, collar_depth = 1.7;
// Radius at the tip as a share of the radius where the root reaches the ground.
constexpr double tip_share = 0.03;
// Radius and length of the second arm of a fork as shares of those of the rest of the root.
constexpr double arm_thickness = 0.75, arm_length = 0.95;
// Largest random turn from piece to piece, in degrees, and the share of the turn so far that a piece takes
// back.
constexpr double winding = 36, taken_back = 0.25;

// Most joints of the profile of the trunk.
constexpr std::size_t most_stations = 64;

/// A stretch of a root along the ground.
struct Run {
  Rng rng{0};
  std::uint32_t joint = Limbs::none;  ///< joint from which it continues
  glm::dvec3 at{0};
  double heading = 0;             ///< degrees
  double radius = 0, length = 0;  ///< the radius where it begins
  double share = 0;               ///< share of the whole root that lies before it
  int pieces = pieces_out, order = 1;
  int forks = 0;  ///< the first after a piece, the second after three
  bool starts_limb = false;
};

class RootGrower {
 public:
  RootGrower(const TreeRoots& roots, double trunk, const RandomStreams& random, SkeletonWriter& writer)
      : roots_(roots), trunk_(trunk), random_(random), writer_(writer) {}

  void run() {
    const std::uint32_t from = collar();
    writer_.each_of_limb(0, [&](std::uint32_t joint) {
      profile_.emplace_back(writer_.radius(joint), writer_.position(joint).y);
      return profile_.size() < most_stations;
    });
    for (int i = 0; i < roots_.count; ++i) grow(i, from);
  }

 private:
  std::uint32_t collar() const;
  void grow(int number, std::uint32_t from);
  void run_out(const Run& run);
  std::uint32_t add(std::uint32_t parent, const glm::dvec3& at, glm::dvec2 radii, int order, bool starts_limb,
                    std::uint64_t key);
  double surface(double aside) const;
  double width(double height) const;
  double reach() const { return roots_.length * trunk_; }
  double thickest() const { return roots_.thickness * trunk_; }

  const TreeRoots& roots_;
  double trunk_;
  const RandomStreams& random_;
  SkeletonWriter& writer_;
  std::vector<glm::dvec2> profile_;  ///< radius and height of the trunk
};

/// Height of the surface of the trunk at a distance from its axis.
double RootGrower::surface(double aside) const {
  glm::dvec2 before{writer_.radius(0), 0};
  if (aside >= before.x) return 0;
  for (const glm::dvec2& station : profile_) {
    if (station.x <= aside && station.x < before.x)
      return before.y + (station.y - before.y) * (before.x - aside) / (before.x - station.x);
    before = station;
  }
  return before.y;
}

/// Radius of the trunk at a height.
double RootGrower::width(double height) const {
  glm::dvec2 before{writer_.radius(0), 0};
  for (const glm::dvec2& station : profile_) {
    if (station.y >= height && station.y > before.y)
      return before.x + (station.x - before.x) * std::max(0.0, height - before.y) / (station.y - before.y);
    before = station;
  }
  return before.x;
}

/// The joint of the trunk from which roots grow; the foot if no other is near the ground.
std::uint32_t RootGrower::collar() const {
  const double least = least_height * thickest(), most = std::max(least, most_height * trunk_);
  std::uint32_t best = 0;
  double nearest = 0;
  writer_.each_of_limb(0, [&](std::uint32_t joint) {
    const double height = writer_.position(joint).y;
    if (height < least || height > most) return height <= most;
    const double off = std::abs(height - wanted_height * thickest());
    if (best == 0 || off < nearest) {
      best = joint;
      nearest = off;
    }
    return true;
  });
  return best;
}

std::uint32_t RootGrower::add(std::uint32_t parent, const glm::dvec3& at, glm::dvec2 radii, int order,
                              bool starts_limb, std::uint64_t key) {
  SkeletonWriter::Joint joint;
  joint.parent = parent;
  joint.position = at;
  joint.base_radius = radii.x;
  joint.radius = radii.y;
  joint.order = order;
  joint.starts_limb = starts_limb;
  joint.key = key;
  return writer_.add(joint);
}

/// Writes a root from the trunk down to the ground at the edge of the flare, and then along the ground.
void RootGrower::grow(int number, std::uint32_t from) {
  const Rng rng = random_.trunk.at("root").at(static_cast<std::uint64_t>(number));
  const double around = 360.0 * (number + Rng(rng.at("around")).uniform(-0.22, 0.22)) / roots_.count;
  const math::SinCos way = math::quick_sincos_degrees(around);
  const glm::dvec3 out{way.cos, 0, way.sin};
  const glm::dvec3 start(writer_.position(from));
  const double radius = thickest() * Rng(rng.at("thickness")).uniform(0.8, 1.0);
  const double flank = writer_.radius(from), foot = writer_.radius(0);
  const double near = std::max(flank, width(start.y - collar_depth * radius)) + first_step * radius,
               far = std::max(foot + trunk_, near + 1.5 * trunk_);
  const double high = std::max(start.y - first_fall * radius, surface(near) + over_ground * radius);
  Run run;
  run.rng = rng;
  const auto key = [&](int k) { return rng.at("down").at(static_cast<std::uint64_t>(k)).key(); };
  run.at = start + out * near;
  run.at.y = high;
  run.joint = add(from, run.at, {radius, 0.92 * radius}, 1, true, key(0));
  double before = 0.92 * radius;
  for (int k = 1; k <= pieces_down; ++k) {
    const double t = static_cast<double>(k) / pieces_down, aside = near + (far - near) * t;
    const double here = radius * (0.92 - 0.24 * t), left = high - surface(near) - over_ground * radius;
    run.at = start + out * aside;
    run.at.y = surface(aside) + over_ground * here + left * (1 - t) * (1 - t);
    run.joint = add(run.joint, run.at, {before, here}, 1, false, key(k));
    before = here;
  }
  run.heading = around;
  run.radius = before;
  run.length = std::max(0.3 * trunk_, foot + reach() * Rng(rng.at("length")).uniform(0.7, 1.0) - far);
  run.forks = 1 + (Rng(rng.at("forks")).unit() < 0.5 ? 1 : 0);
  run_out(run);
}

void RootGrower::run_out(const Run& run) {
  glm::dvec3 at = run.at;
  double heading = run.heading, before = run.radius;
  std::uint32_t joint = run.joint;
  const double step = run.length / run.pieces;
  for (int k = 1; k <= run.pieces; ++k) {
    const Rng rng = run.rng.at(static_cast<std::uint64_t>(k));
    const double t = static_cast<double>(k) / run.pieces, share = run.share + (1 - run.share) * t;
    heading += spread(rng.at("turn"), winding) - taken_back * (heading - run.heading);
    const math::SinCos way = math::quick_sincos_degrees(heading);
    at += glm::dvec3{way.cos, 0, way.sin} * step;
    const double radius = run.radius * (tip_share + (1 - tip_share) * (1 - t) * (1 - 0.5 * t));
    const double deep = roots_.depth * reach() * share * share * share * share;
    at.y = over_ground * radius - deep + spread(rng.at("height"), undulation * radius);
    joint = add(joint, at, {before, radius}, run.order, run.starts_limb && k == 1, rng.key());
    before = radius;
    const bool forks = (run.forks > 0 && k == 1) || (run.forks > 1 && k == 3);
    if (!forks) continue;
    Run arm;
    arm.rng = rng.at("arm");
    arm.joint = joint;
    arm.at = at;
    const double side = Rng(rng.at("side")).unit() < 0.5 ? -1 : 1;
    arm.heading = heading + side * Rng(rng.at("angle")).uniform(32, 52);
    arm.radius = arm_thickness * radius;
    arm.length = arm_length * run.length * (1 - t);
    arm.share = share;
    arm.pieces = std::max(2, run.pieces - k);
    arm.order = run.order + 1;
    arm.starts_limb = true;
    run_out(arm);
  }
}

}  // namespace

void grow_roots(const TreeRoots& roots, double trunk, const RandomStreams& random, SkeletonWriter& writer) {
  if (roots.count > 0) RootGrower(roots, trunk, random, writer).run();
}

}  // namespace seedmesh::tree
