#include "core/generators/tree/sculpt.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh::tree {
namespace {

// Most whorls of a limb; gaps that become shorter could otherwise go on for ever.
constexpr int most_whorls = 2000;
// Steps in which a ray searches for the border of a shape, and bisections of the last step.
constexpr int ray_steps = 64, halvings = 20;
// Largest radius of a limb as a share of that of its parent where it begins.
constexpr double thickest_child = 0.8;

double half_width(const TreeLevel& level, double share) {
  switch (level.shape) {
    case TreeShape::sphere:
      return 2 * std::sqrt(std::max(0.0, share * (1 - share)));
    case TreeShape::cone:
      return 1 - share;
    case TreeShape::lathe: {
      if (level.profile.empty()) return 1;
      const double at = share * static_cast<double>(level.profile.size() - 1);
      const auto low = static_cast<std::size_t>(math::to_int64(std::floor(at)));
      const std::size_t high = std::min(low + 1, level.profile.size() - 1);
      return level.profile[low] + (level.profile[high] - level.profile[low]) * (at - std::floor(at));
    }
    default:
      return 1;
  }
}

struct Limb {
  Frame frame;
  glm::dvec3 position{0};
  std::uint32_t joint = Limbs::none;
  int level = 0;
  double length = 0, radius = 0;
  Rng rng{0};
};

class SculptGrower {
 public:
  SculptGrower(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer)
      : p_(params), s_(params.sculpt), random_(random), writer_(writer) {}

  void run() {
    Limb trunk;
    trunk.rng = random_.trunk;
    trunk.length = s_.height * (1 + spread(trunk.rng.at("height"), s_.height_spread));
    trunk.frame = pitch(roll(Frame{}, math::quick_sincos_degrees(trunk.rng.at("roll").uniform(0, 360))),
                        math::quick_sincos_degrees(s_.lean));
    trunk.radius = s_.trunk_radius > 0 ? s_.trunk_radius : radius_of(trunk, 1e9);
    SkeletonWriter::Joint foot;
    foot.radius = foot.base_radius = radius_at(trunk, 0);
    foot.key = trunk.rng.key();
    trunk.joint = writer_.add(foot);
    waiting_.push_back(trunk);
    while (!waiting_.empty()) {
      const Limb limb = waiting_.back();
      waiting_.pop_back();
      grow(limb);
    }
  }

 private:
  const TreeLevel& level(int n) const {
    static const TreeLevel usual;
    if (s_.level.empty()) return usual;
    return s_.level[std::min(static_cast<std::size_t>(n), s_.level.size() - 1)];
  }
  bool bears_leaves(const Limb& limb) const {
    return !branches(limb) || (limb.level > 0 && limb.level + 2 >= s_.levels);
  }
  bool branches(const Limb& limb) const { return limb.level + 1 < s_.levels && limb.length > s_.shortest; }

  /// The radius at the foot of a limb, from the taper angle.
  double radius_of(const Limb& limb, double most) const {
    const double wanted = s_.tip_radius + limb.length * math::tan(math::radians(level(limb.level).taper));
    return std::min(wanted, most);
  }
  double radius_at(const Limb& limb, double share) const {
    const double end = std::min(s_.tip_radius, limb.radius);
    const double radius = limb.radius + (end - limb.radius) * share;
    const double low = std::max(0.0, 1 - 8 * share);
    return limb.level == 0 ? radius * (1 + p_.trunk_flare * low * low * low) : radius;
  }

  void grow(const Limb& limb);
  std::vector<double> whorls(const Limb& limb) const;
  Frame turned(const Limb& limb, const Frame& frame, int segment, double share) const;
  void whorl(const Limb& limb, const Limb& here, int number, double share);
  void leaves(const Limb& limb, const std::vector<Limb>& stations, const std::vector<double>& shares);

  const TreeParams& p_;
  const TreeSculpt& s_;
  const RandomStreams& random_;
  SkeletonWriter& writer_;
  std::vector<Limb> waiting_;
};

/// The ends of the segments of a limb as shares of its length: its whorls and its tip.
std::vector<double> SculptGrower::whorls(const Limb& limb) const {
  const TreeLevel& l = level(limb.level);
  std::vector<double> shares;
  double at = 0, gap = l.gap;
  for (int i = 0; i < most_whorls && at + gap < 1 && gap > 1e-3; ++i) {
    at += gap;
    gap *= l.gap_ratio;
    shares.push_back(at);
  }
  if (!shares.empty() && 1 - shares.back() < 0.25 * l.gap) shares.pop_back();
  shares.push_back(1);
  return shares;
}

Frame SculptGrower::turned(const Limb& limb, const Frame& frame, int segment, double share) const {
  const TreeLevel& l = level(limb.level);
  const Rng rng = limb.rng.at("segment").at(static_cast<std::uint64_t>(segment));
  const double bend = l.bend + spread(rng.at("bend"), l.bend_spread);
  Frame next = pitch(roll(frame, math::quick_sincos_degrees(l.spin)), math::quick_sincos_degrees(bend));
  if (l.rise == 0) return next;
  const glm::dvec3 axis = glm::cross(next.heading, glm::dvec3{0, 1, 0});
  const double size = std::sqrt(glm::dot(axis, axis));
  if (size < 1e-6) return next;
  const double to_sky = math::degrees(math::quick_acos(std::clamp(next.heading.y, -1.0, 1.0)));
  const double rise = std::clamp(l.rise * share, to_sky - 180, to_sky);
  return rotated(next, axis / size, math::quick_sincos_degrees(rise));
}

void SculptGrower::grow(const Limb& limb) {
  const TreeLevel& l = level(limb.level);
  const std::vector<double> shares = whorls(limb);
  Limb here = limb;
  std::vector<Limb> stations;
  double before = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (i > 0) here.frame = turned(limb, here.frame, static_cast<int>(i), shares[i] - before);
    SkeletonWriter::Joint joint;
    joint.parent = here.joint;
    here.position += here.frame.heading * ((shares[i] - before) * limb.length);
    joint.position = here.position;
    joint.base_radius = radius_at(limb, before);
    joint.radius = radius_at(limb, shares[i]);
    joint.starts_limb = i == 0 && limb.level > 0;
    joint.order = limb.level;
    joint.key = limb.rng.at("joint").at(i).key();
    here.joint = writer_.add(joint);
    before = shares[i];
    stations.push_back(here);
    if (branches(limb) && shares[i] >= l.start && shares[i] < 1)
      whorl(limb, here, static_cast<int>(i), shares[i]);
  }
  if (bears_leaves(limb)) leaves(limb, stations, shares);
}

void SculptGrower::whorl(const Limb& limb, const Limb& here, int number, double share) {
  const TreeLevel& l = level(limb.level);
  const Rng own = limb.level == 0 ? random_.branches : limb.rng;
  const Rng rng = own.at("whorl").at(static_cast<std::uint64_t>(number));
  for (int i = 0; i < l.whorl; ++i) {
    const Rng random = rng.at(static_cast<std::uint64_t>(i));
    if (l.chance < 1 && Rng(random.at("there")).unit() >= l.chance) continue;
    const double around = l.phase * number + 360.0 * i / l.whorl + spread(random.at("phase"), l.phase_spread);
    const double angle =
        l.angle + (l.angle_tip - l.angle) * share + spread(random.at("angle"), l.angle_spread);
    Limb child;
    child.frame =
        pitch(roll(here.frame, math::quick_sincos_degrees(around)), math::quick_sincos_degrees(angle));
    child.position = here.position;
    child.joint = here.joint;
    child.level = limb.level + 1;
    const math::SinCos lean = math::quick_sincos_degrees(angle), about = math::quick_sincos_degrees(around);
    const double reach = distance_in_shape(l, limb.length, share * limb.length,
                                           {lean.sin * about.sin, lean.cos, lean.sin * about.cos});
    child.length = reach * l.fill * (1 - l.fill_spread * Rng(random.at("fill")).unit());
    if (child.length < s_.shortest) continue;
    child.rng = random.at("limb");
    child.radius = radius_of(child, thickest_child * radius_at(limb, share));
    waiting_.push_back(child);
  }
}

void SculptGrower::leaves(const Limb& limb, const std::vector<Limb>& stations,
                          const std::vector<double>& shares) {
  const Rng rng = random_.leaves.at(limb.rng.key());
  for (int i = 0; i < s_.leaves; ++i) {
    const double share = 0.15 + 0.85 * (i + 1.0) / s_.leaves;
    std::size_t at = 0;
    while (at + 1 < shares.size() && shares[at] < share - 1e-9) ++at;
    const Rng own = rng.at(static_cast<std::uint64_t>(i));
    if (!writer_.wants_leaf(own.key())) continue;
    const double around = 137.5 * i + spread(own.at("around"), 20);
    SkeletonWriter::Leaf leaf;
    leaf.frame = pitch(roll(stations[at].frame, math::quick_sincos_degrees(around)),
                       math::quick_sincos_degrees(s_.leaf_angle + spread(own.at("angle"), 15)));
    if (leaf.frame.up.y < 0) leaf.frame = {leaf.frame.heading, -leaf.frame.left, -leaf.frame.up};
    leaf.position = stations[at].position - stations[at].frame.heading * ((shares[at] - share) * limb.length);
    leaf.length = s_.leaf_length;
    leaf.width = s_.leaf_length * s_.leaf_width;
    leaf.joint = stations[at].joint;
    leaf.key = own.key();
    writer_.add(leaf);
  }
}

}  // namespace

double distance_in_shape(const TreeLevel& level, double length, double from, const glm::dvec3& direction) {
  const double width = level.width * length;
  const double aside = level.shape == TreeShape::box
                           ? std::max(std::abs(direction.x), std::abs(direction.z))
                           : std::sqrt(direction.x * direction.x + direction.z * direction.z);
  const auto is_inside = [&](double t) {
    const double along = (from + direction.y * t) / length;
    if (along < 0 || along > 1) return false;
    return aside * t <= width * half_width(level, along);
  };
  const double farthest = length + width;
  double inside = 0, outside = farthest;
  for (int i = 1; i <= ray_steps; ++i) {
    const double t = farthest * i / ray_steps;
    if (!is_inside(t)) {
      outside = t;
      break;
    }
    inside = t;
  }
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (is_inside(middle) ? inside : outside) = middle;
  }
  return inside;
}

void grow_sculpt(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer) {
  SculptGrower(params, random, writer).run();
}

}  // namespace seedmesh::tree
