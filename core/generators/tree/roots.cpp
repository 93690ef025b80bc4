#include "core/generators/tree/roots.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh::tree {
namespace {

// A root leaves the trunk where the joint is nearest to so many of its radii above the ground, if one is
// within reach of these (by its own radius, and by the trunk's).
constexpr double least_height = 1.25, wanted_height = 1.6, most_height = 2.2;
// Pieces from the flank to the ground, and along it.
constexpr int pieces_down = 4, pieces_out = 8;
// A root's axis lies so much of its radius above the flare and the ground, and goes up and down by so much.
constexpr double over_ground = 0.25, undulation = 0.3;
// It leaves the trunk as steeply as to fall so much of its radius until it is out of the bark by so much,
// also where the flare is widest that its collar reaches, so much of its radius below the joint.
constexpr double first_fall = 0.7, first_step = 0.7, collar_depth = 1.7;
// A radius at the tip, as a share of that at the trunk.
constexpr double tip_share = 0.03;
// A root that forks has a second arm so thick and so long as the rest of the first.
constexpr double arm_thickness = 0.75, arm_length = 0.95;
// Turns of a root from piece to piece, and how much of what it has turned so far it takes back.
constexpr double winding = 36, taken_back = 0.25;

// Joints of the trunk that its profile is taken from.
constexpr std::size_t most_stations = 64;

/// A stretch of a root along the ground.
struct Run {
  Rng rng{0};
  std::uint32_t joint = Limbs::none;  ///< that it leaves
  glm::dvec3 at{0};
  double heading = 0;             ///< degrees
  double radius = 0, length = 0;  ///< where it begins, and of all of it
  double share = 0;               ///< of the root's way that lies behind it
  int pieces = pieces_out, order = 1;
  int forks = 0;  ///< the first after a piece, the second after three
  bool starts_limb = false;
};

class RootGrower {
 public:
  RootGrower(const TreeRoots& roots, double trunk, const Chances& chances, SkeletonWriter& writer)
      : roots_(roots), trunk_(trunk), chances_(chances), writer_(writer) {}

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
  const Chances& chances_;
  SkeletonWriter& writer_;
  std::vector<glm::dvec2> profile_;  ///< of the trunk: radius and height
};

/// How high the flare is at a distance from the axis of the trunk.
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

/// How wide the flare is at a height.
double RootGrower::width(double height) const {
  glm::dvec2 before{writer_.radius(0), 0};
  for (const glm::dvec2& station : profile_) {
    if (station.y >= height && station.y > before.y)
      return before.x + (station.x - before.x) * std::max(0.0, height - before.y) / (station.y - before.y);
    before = station;
  }
  return before.x;
}

/// The joint of the trunk that roots leave: the foot where no other is near the ground.
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

/// From the flank of the trunk down to the ground at the edge of the flare.
void RootGrower::grow(int number, std::uint32_t from) {
  const Rng rng = chances_.trunk.at("root").at(static_cast<std::uint64_t>(number));
  const double around = 360.0 * (number + Rng(rng.at("around")).uniform(-0.22, 0.22)) / roots_.count;
  const math::SinCos way = math::quick_sincos_degrees(around);
  const glm::dvec3 out{way.cos, 0, way.sin};
  const glm::dvec3 start(writer_.position(from));
  const double radius = thickest() * Rng(rng.at("thickness")).uniform(0.8, 1.0);
  const double flank = writer_.radius(from), foot = writer_.radius(0);
  // Down along the flare, half out of it, to the ground at its edge.
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

void grow_roots(const TreeRoots& roots, double trunk, const Chances& chances, SkeletonWriter& writer) {
  if (roots.count > 0) RootGrower(roots, trunk, chances, writer).run();
}

}  // namespace seedmesh::tree
