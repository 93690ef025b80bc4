#include "core/generators/tree/proctree.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh::tree {
namespace {

// Radius at the end of a twig as a share of that at its beginning.
constexpr double twig_end = 0.3;
// Bound of lengths, because the falloff may raise a small length to a negative power.
constexpr double longest = 100;
// Limbs are at least this thick, even where they are shorter.
constexpr double least_radius = 1e-3;

struct Node {
  glm::dvec3 tail{0}, head{0};
  double length = 0;  ///< length of its children
  double radius = 0;
  bool on_trunk = false, starts_limb = false;
  std::uint32_t parent_joint = Limbs::none;
  std::int32_t levels = 0, steps = 0;  ///< left
  int order = 0;
  int first = 1, second = 1;  ///< forks on the way from the foot that chose either branch, from 1
  Rng rng{0};
};

class ProctreeGrower {
 public:
  ProctreeGrower(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer)
      : p_(params), random_(random), writer_(writer) {}

  void run() {
    SkeletonWriter::Joint foot;
    foot.radius = foot.base_radius = p_.mMaxRadius * (1 + p_.trunk_flare);
    foot.key = random_.trunk.at("foot").key();
    Node root;
    root.head = {0, p_.mTrunkLength, 0};
    root.length = p_.mInitialBranchLength;
    root.radius = std::min(p_.mMaxRadius, root.length);
    root.on_trunk = true;
    root.levels = p_.mLevels;
    root.steps = p_.mTreeSteps;
    root.parent_joint = writer_.add(foot);
    root.rng = random_.trunk;
    waiting_.push_back(root);
    is_first_ = true;
    while (!waiting_.empty()) {
      const Node node = waiting_.back();
      waiting_.pop_back();
      fork(node);
    }
  }

 private:
  struct Directions {
    glm::dvec3 first, second;
    double random;
  };

  Directions directions(const Node& node) const;
  std::uint32_t draw(const Node& node);
  void fork(const Node& node);
  void twig(const Node& node, const Node& child, std::uint32_t joint);

  double random_of(const Node& node) const;
  double falloff(bool on_trunk) const { return on_trunk ? p_.mTaperRate : p_.mRadiusFalloffRate; }

  const TreeParams& p_;
  const RandomStreams& random_;
  SkeletonWriter& writer_;
  std::vector<Node> waiting_;
  bool is_first_ = false;
};

glm::dvec3 unit(const glm::dvec3& v) { return math::unit(v, glm::dvec3{0, 1, 0}); }

/// The random number of a fork, 0 .. 1. That of proctree.js is |cos(x + x^2)| of a number that repeats.
double ProctreeGrower::random_of(const Node& node) const {
  if (p_.sequence == TreeSequence::keyed) return Rng(node.rng.at("fork")).unit();
  const double x = 10.0 * (p_.mLevels - node.levels) + 5.0 * node.first + node.second + p_.mSeed;
  return std::abs(math::cos(x + x * x));
}

/// The two directions of a fork: the first is close to that of the parent, the second is nearly its mirror
/// image.
ProctreeGrower::Directions ProctreeGrower::directions(const Node& node) const {
  const std::int32_t depth = p_.mLevels - node.levels;
  const double r = random_of(node);
  const glm::dvec3 ahead = unit(node.head - node.tail);
  const glm::dvec3 normal = glm::cross(ahead, glm::dvec3{ahead.z, ahead.x, ahead.y});
  const glm::dvec3 tangent = glm::cross(ahead, normal);
  glm::dvec3 aside = r * normal + (1 - r) * tangent;
  if (r > 0.5) aside = -aside;
  const double clump = p_.mClumpMin + (p_.mClumpMax - p_.mClumpMin) * r;
  glm::dvec3 first = unit((1 - clump) * aside + clump * ahead);
  const glm::dvec3 across = first - ahead * glm::dot(first, ahead);
  glm::dvec3 second = first - across * (p_.mBranchFactor * glm::dot(across, across));
  if (r > 0.5) std::swap(first, second);
  if (node.steps > 0) {
    const math::SinCos around = math::quick_sincos(2 * math::pi * p_.mTwistRate * node.steps / p_.mTreeSteps);
    second = unit({around.sin, r, around.cos});
  }
  const double near_trunk = static_cast<double>(node.levels) / p_.mLevels;
  const glm::dvec3 bias{depth * p_.mSweepAmount,
                        depth * p_.mDropAmount + near_trunk * near_trunk * p_.mGrowAmount, 0};
  return {unit(first + bias), unit(second + bias), r};
}

/// Writes the branch of a node, from its beginning to its fork; the first branch with the flare of the trunk.
std::uint32_t ProctreeGrower::draw(const Node& node) {
  SkeletonWriter::Joint joint;
  joint.parent = node.parent_joint;
  joint.starts_limb = node.starts_limb;
  joint.order = node.order;
  joint.base_radius = node.radius;
  if (is_first_ && p_.trunk_flare > 0) {
    for (const double share : {1.0 / 48, 1.0 / 16, 1.0 / 8}) {
      const double width = 1 - 8 * share;
      joint.base_radius = writer_.radius(joint.parent);
      joint.radius = node.radius * (1 + p_.trunk_flare * width * width * width);
      joint.position = share * node.head;
      joint.key = node.rng.at("flare").at(static_cast<std::uint64_t>(64 * share)).key();
      joint.parent = writer_.add(joint);
      joint.base_radius = node.radius;
    }
  }
  is_first_ = false;
  joint.position = node.head;
  joint.radius = node.radius * falloff(node.on_trunk && node.steps > 0);
  if (node.levels < 0) joint.radius = node.radius * twig_end;
  joint.key = node.rng.key();
  return writer_.add(joint);
}

void ProctreeGrower::fork(const Node& node) {
  const std::uint32_t joint = draw(node);
  if (node.levels < 0) return;
  const auto [first, second, r] = directions(node);
  const double length =
      std::min(longest, math::pow(node.length, p_.mLengthFalloffPower) * p_.mLengthFalloffFactor);
  Node main, side;
  main.tail = side.tail = node.head;
  main.parent_joint = side.parent_joint = joint;
  main.length = side.length = length;
  main.head = node.head + first * node.length;
  side.head = node.head + second * node.length;
  main.rng = node.rng.at(0);
  side.rng = (node.on_trunk ? random_.branches.at(static_cast<std::uint64_t>(node.steps)) : node.rng).at(1);
  main.radius = side.radius = std::min(node.radius * p_.mRadiusFalloffRate, std::max(length, least_radius));
  main.levels = side.levels = node.levels - 1;
  main.first = node.first + 1;
  side.first = node.first;
  main.second = node.second;
  side.second = node.second + 1;
  main.order = node.order;
  side.order = node.order + 1;
  side.starts_limb = true;
  if (node.levels > 0 && node.steps > 0) {
    const double kink = (2 * r - 1) * p_.mTrunkKink;
    main.head = node.head + glm::dvec3{kink, p_.mClimbRate, kink};
    main.on_trunk = true;
    main.length = std::min(longest, node.length * p_.mTaperRate);
    main.radius = std::min(node.radius * p_.mTaperRate, std::max(main.length, least_radius));
    main.levels = node.levels;
    main.steps = node.steps - 1;
  }
  for (const Node* child : {&side, &main}) {
    if (child->levels < 0) twig(node, *child, joint);
    waiting_.push_back(*child);
  }
}

/// Writes a square with sides of twice mTwigScale. It begins before the tip of a branch by the length that branches
/// from there would have.
void ProctreeGrower::twig(const Node& node, const Node& child, std::uint32_t joint) {
  const std::uint64_t key = random_.leaves.at(child.rng.key()).key();
  if (!writer_.wants_leaf(key)) return;
  const glm::dvec3 ahead = unit(child.head - node.head);
  const glm::dvec3 behind = unit(node.head - node.tail);
  const glm::dvec3 normal = math::unit(glm::cross(behind, ahead), glm::dvec3{0, 0, 1});
  Frame frame;
  frame.up = glm::cross(normal, ahead);
  SkeletonWriter::Leaf leaf;
  leaf.frame = headed(frame, ahead);
  if (leaf.frame.up.y < 0) leaf.frame = {leaf.frame.heading, -leaf.frame.left, -leaf.frame.up};
  leaf.position = child.head - ahead * child.length;
  leaf.length = 2 * p_.mTwigScale;
  leaf.width = 2 * p_.mTwigScale;
  leaf.joint = joint;
  leaf.key = key;
  writer_.add(leaf);
}

}  // namespace

void grow_proctree(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer) {
  ProctreeGrower(params, random, writer).run();
}

}  // namespace seedmesh::tree
