#include "core/generators/tree/ez_tree.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/array.h"
#include "core/generators/tree/ez_tree_turns.h"
#include "core/generators/tree/leaf_frames.h"

namespace seedmesh::tree {
namespace {

// Radius of the tips of the last level.
constexpr double tip_radius = 0.001;
// Limbs that begin closer together than this share of a section share a joint.
constexpr double nearest_feet = 1e-6;
constexpr std::size_t level_count = 4;

/// The levels of a new tree of ez-tree 1.1: angle, children, gnarliness, length, radius, sections, start, taper,
/// twist.
std::vector<TreeBranchLevel> new_levels() {
  const auto level = [](double angle, int children, double gnarliness, double length, double radius) {
    TreeBranchLevel out;
    out.angle = angle;
    out.children = children;
    out.gnarliness = gnarliness;
    out.length = length;
    out.radius = radius;
    return out;
  };
  std::vector<TreeBranchLevel> levels = {level(0, 7, 0.15, 20, 1.5), level(70, 7, 0.2, 20, 0.7),
                                         level(60, 5, 0.3, 10, 0.7), level(60, 0, 0.02, 1, 0.7)};
  const int sections[level_count] = {12, 10, 8, 6};
  const double starts[level_count] = {0, 0.4, 0.3, 0.3};
  for (std::size_t i = 0; i < level_count; ++i) {
    levels[i].sections = sections[i];
    levels[i].start = starts[i];
  }
  return levels;
}

/// A limb that has not grown yet. Lengths are units of the model.
struct Branch {
  glm::dvec3 origin{0}, angles{0};
  double length = 0, radius = 0;
  int level = 0, sections = 1;
  std::uint32_t joint = Limbs::none;
  bool continues = false;  ///< it is the end of another limb, not a side branch
};

/// The state of a limb where a section begins, or at its tip.
struct Station {
  glm::dvec3 origin{0}, angles{0};
  double radius = 0;
  std::uint32_t joint = Limbs::none;
};

class EzTreeGrower {
 public:
  EzTreeGrower(const TreeParams& params, const RandomStreams& random, std::uint64_t seed,
               SkeletonWriter& writer)
      : params_(params),
        p_(params.ez_tree),
        random_(random),
        numbers_(seed),
        writer_(writer),
        queue_(writer.job()),
        levels_(p_.ez_level.empty() ? new_levels() : p_.ez_level),
        force_(turn_from_up({p_.force_x, p_.force_y, p_.force_z})) {}

  void run() {
    Branch trunk;
    trunk.length = level(0).length;
    trunk.radius = level(0).radius;
    trunk.sections = level(0).sections;
    SkeletonWriter::Joint foot;
    foot.radius = foot.base_radius = p_.scale * trunk.radius * (1 + params_.trunk_flare);
    foot.key = random_.trunk.at("foot").key();
    trunk.joint = writer_.add(foot);
    queue_.push_back(trunk);
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const Branch branch = queue_[i];
      number_ = i;
      grow(branch);
    }
  }

 private:
  const TreeBranchLevel& level(int n) const {
    return levels_[std::min(static_cast<std::size_t>(n), levels_.size() - 1)];
  }
  bool is_last(const Branch& branch) const { return branch.level >= p_.levels; }

  void grow(const Branch& branch);
  void walk(const Branch& branch);
  glm::dvec3 turned(const Branch& branch, const Station& at, const glm::dvec3& origin);
  EzTurn to_trellis(const EzTurn& turn, const glm::dvec3& origin, double radius) const;
  void draw_feet(const Branch& branch);
  void write_joints(const Branch& branch);
  std::uint32_t write_joint(const Branch& branch, const glm::dvec3& at, double radius);
  void add_children(const Branch& branch);
  void add_leaves();
  void add_leaf(const Station& at);
  Station between_sections(double share) const;
  EzTurn side(const Station& at, double down, double about) const;

  /// Where a child begins on the limb that grows: the share of its length, and the joint there.
  struct Foot {
    double share = 0;
    std::uint32_t joint = Limbs::none;
  };

  const TreeParams& params_;
  const TreeEzTree& p_;
  const RandomStreams& random_;
  EzTreeRandom numbers_;
  SkeletonWriter& writer_;
  Array<Branch> queue_;
  std::vector<TreeBranchLevel> levels_;
  EzTurn force_;
  std::size_t number_ = 0;  ///< number of the limb that grows

  // Of the limb that grows.
  std::vector<Station> stations_;
  std::vector<Foot> feet_;
  double offset_ = 0;  ///< turns about the limb of its first child or leaf
  std::uint32_t last_joint_ = Limbs::none;
  double last_radius_ = 0;
  bool starts_ = false;
  std::size_t joints_ = 0, leaves_ = 0;  ///< written so far
};

void EzTreeGrower::grow(const Branch& branch) {
  if (number_ % 256 == 0) writer_.job().check();
  joints_ = leaves_ = 0;
  walk(branch);
  draw_feet(branch);
  write_joints(branch);
  if (is_last(branch)) {
    add_leaves();
  } else {
    add_children(branch);
  }
}

/// Finds the stations of a limb.
void EzTreeGrower::walk(const Branch& branch) {
  const TreeBranchLevel& own = level(branch.level);
  const double step = branch.length / branch.sections;
  stations_.clear();
  Station here;
  here.origin = branch.origin;
  here.angles = branch.angles;
  for (int i = 0; i <= branch.sections; ++i) {
    const double share = static_cast<double>(i) / branch.sections;
    here.radius = branch.radius * (1 - (p_.evergreen ? 1 : own.taper) * share);
    if (i == branch.sections && is_last(branch)) here.radius = tip_radius;
    stations_.push_back(here);
    const glm::dvec3 next = here.origin + step * frame_of(turn_of_angles(here.angles)).heading;
    here.angles = turned(branch, here, next);
    here.origin = next;
  }
}

/// The angles of the section after `at`, which begins at `origin`.
glm::dvec3 EzTreeGrower::turned(const Branch& branch, const Station& at, const glm::dvec3& origin) {
  const TreeBranchLevel& own = level(branch.level);
  const double radius = std::max(at.radius, 1e-9);
  const double range = std::max(1.0, 1 / std::sqrt(radius)) * own.gnarliness;
  glm::dvec3 angles = at.angles;
  angles.x += numbers_.between(-range, range);
  angles.z += numbers_.between(-range, range);
  EzTurn turn = product(turn_of_angles(angles), turn_about({0, 1, 0}, own.twist));
  turn = toward(turn, force_, p_.force_strength / radius);
  if (p_.trellis.enabled) turn = to_trellis(turn, origin, radius);
  return angles_of(turn);
}

/// Turned toward the nearest bar of the trellis.
EzTurn EzTreeGrower::to_trellis(const EzTurn& turn, const glm::dvec3& origin, double radius) const {
  const TreeTrellis& t = p_.trellis;
  const double left = t.x - t.width / 2, right = t.x + t.width / 2, top = t.y + t.height;
  const double x = std::clamp(origin.x, left, right), y = std::clamp(origin.y, t.y, top);
  const auto bar = [&](double from, double value, double most) {
    return std::clamp(std::floor((value - from) / t.spacing + 0.5) * t.spacing + from, from, most);
  };
  const glm::dvec3 level_bar{x, bar(t.y, y, top), t.z}, upright_bar{bar(left, x, right), y, t.z};
  const glm::dvec3 to_level = level_bar - origin, to_upright = upright_bar - origin;
  const bool is_level = glm::dot(to_level, to_level) < glm::dot(to_upright, to_upright);
  const glm::dvec3 way = is_level ? to_level : to_upright;
  const double distance = std::sqrt(glm::dot(way, way));
  if (distance > t.max_distance || distance < 0.001) return turn;
  const double effect = 1 - math::pow(distance / t.max_distance, t.falloff);
  return toward(turn, turn_from_up(way / distance), t.strength * effect / radius);
}

/// Draws where the children of the limb begin, in the order of ez-tree.
void EzTreeGrower::draw_feet(const Branch& branch) {
  feet_.clear();
  last_joint_ = branch.joint;
  if (is_last(branch)) return;
  offset_ = numbers_.between(0, 1);
  const double start = level(branch.level + 1).start;
  for (int i = 0; i < level(branch.level).children; ++i) feet_.push_back({numbers_.between(start, 1)});
}

std::uint32_t EzTreeGrower::write_joint(const Branch& branch, const glm::dvec3& at, double radius) {
  SkeletonWriter::Joint joint;
  joint.parent = last_joint_;
  joint.position = p_.scale * at;
  joint.base_radius = p_.scale * last_radius_;
  joint.radius = p_.scale * radius;
  joint.starts_limb = starts_;
  joint.order = branch.level;
  const Rng rng = branch.level == 0 ? random_.trunk : random_.branches;
  joint.key = rng.at(number_).at(joints_++).key();
  starts_ = false;
  last_radius_ = radius;
  last_joint_ = writer_.add(joint);
  return last_joint_;
}

/// Writes a joint at each station and wherever a child begins.
void EzTreeGrower::write_joints(const Branch& branch) {
  std::vector<std::size_t> order(feet_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return feet_[a].share < feet_[b].share; });
  starts_ = branch.level > 0 && !branch.continues;
  last_radius_ = stations_.front().radius;
  stations_.front().joint = branch.joint;
  std::size_t next = 0;
  const double sections = branch.sections;
  for (std::size_t section = 0; section + 1 < stations_.size(); ++section) {
    const Station &from = stations_[section], &to = stations_[section + 1];
    double before = 0;
    for (; next < order.size() && feet_[order[next]].share * sections < static_cast<double>(section + 1);
         ++next) {
      Foot& foot = feet_[order[next]];
      const double along = foot.share * sections - static_cast<double>(section);
      if (along > before + nearest_feet && along < 1 - nearest_feet) {
        const double radius = from.radius + (to.radius - from.radius) * along;
        write_joint(branch, from.origin + (to.origin - from.origin) * along, radius);
        before = along;
      }
      foot.joint = last_joint_;
    }
    stations_[section + 1].joint = write_joint(branch, to.origin, to.radius);
  }
  for (; next < order.size(); ++next) feet_[order[next]].joint = last_joint_;
}

/// The state of the limb at a share of its length.
Station EzTreeGrower::between_sections(double share) const {
  const double sections = static_cast<double>(stations_.size() - 1);
  const auto section = static_cast<std::size_t>(math::to_int64(std::floor(share * sections)));
  const std::size_t first = std::min(section, stations_.size() - 1),
                    second = std::min(first + 1, stations_.size() - 1);
  const Station &a = stations_[first], &b = stations_[second];
  const double along = share * sections - static_cast<double>(first);
  Station at;
  at.origin = a.origin + (b.origin - a.origin) * along;
  at.radius = a.radius * (1 - along) + b.radius * along;
  // ez-tree goes from the second orientation to the first.
  at.angles = angles_of(between(turn_of_angles(b.angles), turn_of_angles(a.angles), along));
  at.joint = b.joint;
  return at;
}

/// Turned from the limb by `down` degrees, and about it by `about` turns.
EzTurn EzTreeGrower::side(const Station& at, double down, double about) const {
  const EzTurn lean = turn_about({1, 0, 0}, math::radians(down));
  const EzTurn around = turn_about({0, 1, 0}, 2 * math::pi * about);
  return product(turn_of_angles(at.angles), product(around, lean));
}

void EzTreeGrower::add_children(const Branch& branch) {
  const TreeBranchLevel& own = level(branch.level + 1);
  Branch child;
  child.level = branch.level + 1;
  if (!p_.evergreen) {
    const Station& tip = stations_.back();
    child.origin = tip.origin;
    child.angles = tip.angles;
    child.length = own.length;
    child.radius = tip.radius;
    child.sections = branch.sections;
    child.joint = tip.joint;
    child.continues = true;
    queue_.push_back(child);
    child.continues = false;
  }
  child.sections = own.sections;
  const double count = static_cast<double>(feet_.size());
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const Station at = between_sections(feet_[i].share);
    child.origin = at.origin;
    child.radius = own.radius * at.radius;
    child.angles = angles_of(side(at, own.angle, offset_ + static_cast<double>(i) / count));
    child.length = own.length * (p_.evergreen ? 1 - feet_[i].share : 1);
    child.joint = feet_[i].joint;
    queue_.push_back(child);
  }
}

void EzTreeGrower::add_leaves() {
  if (!p_.evergreen) add_leaf(stations_.back());
  offset_ = numbers_.between(0, 1);
  const double count = p_.leaf_count;
  for (int i = 0; i < p_.leaf_count; ++i) {
    Station at = between_sections(numbers_.between(p_.leaf_start, 1));
    at.angles = angles_of(side(at, p_.leaf_angle, offset_ + i / count));
    add_leaf(at);
  }
}

void EzTreeGrower::add_leaf(const Station& at) {
  const double variance = p_.leaf_size_variance;
  const double size = p_.scale * p_.leaf_size * (1 + numbers_.between(-variance, variance));
  const std::uint64_t key = random_.leaves.at(number_).at(leaves_++).key();
  if (!writer_.wants_leaf(key)) return;
  SkeletonWriter::Leaf leaf;
  leaf.frame = upper_side_up(frame_of(turn_of_angles(at.angles)));
  leaf.position = p_.scale * at.origin;
  leaf.length = leaf.width = size;
  leaf.joint = at.joint;
  leaf.key = key;
  writer_.add(leaf);
}

}  // namespace

EzTreeRandom::EzTreeRandom(std::uint64_t seed)
    : w_(static_cast<std::uint32_t>(123456789 + seed)), z_(static_cast<std::uint32_t>(987654321 - seed)) {}

double EzTreeRandom::between(double low, double high) {
  // The original shifts signed numbers.
  const auto high_bits = [](std::uint32_t x) {
    return (x >> 16U) | ((x & 0x80000000U) != 0 ? 0xFFFF0000U : 0U);
  };
  z_ = 36969U * (z_ & 65535U) + high_bits(z_);
  w_ = 18000U * (w_ & 65535U) + high_bits(w_);
  const std::uint32_t both = (z_ << 16U) + (w_ & 65535U);
  return (high - low) * (both / 4294967296.0) + low;
}

void grow_ez_tree(const TreeParams& params, const RandomStreams& random, std::uint64_t seed,
                  SkeletonWriter& writer) {
  EzTreeGrower(params, random, seed, writer).run();
}

}  // namespace seedmesh::tree
