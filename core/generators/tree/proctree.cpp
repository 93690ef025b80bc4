#include "core/generators/tree/proctree.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace seedmesh::tree {
namespace {

// Radius of a twig's end as a share of where it begins: closed, but not a needle.
constexpr double twig_end = 0.3;
// Lengths stay finite where the falloff raises a small length to a negative power.
constexpr double longest = 100;

struct Node {
  glm::dvec3 tail{0}, head{0};
  double length = 0;  ///< of its children
  double radius = 0;
  bool on_trunk = false, starts_limb = false;
  std::uint32_t parent_joint = Limbs::none;
  std::int32_t levels = 0, steps = 0;  ///< left
  int order = 0;
  Rng rng{0};
};

class Forker {
 public:
  Forker(const TreeParams& params, const Chances& chances, SkeletonWriter& writer)
      : p_(params), chances_(chances), writer_(writer) {}

  void run() {
    SkeletonWriter::Joint foot;
    foot.radius = foot.base_radius = p_.mMaxRadius * (1 + p_.trunk_flare);
    foot.key = chances_.trunk.at("foot").key();
    Node root;
    root.head = {0, p_.mTrunkLength, 0};
    root.length = p_.mInitialBranchLength;
    root.radius = std::min(p_.mMaxRadius, std::max(root.length, p_.mTrunkLength));
    root.on_trunk = true;
    root.levels = p_.mLevels;
    root.steps = p_.mTreeSteps;
    root.parent_joint = writer_.add(foot);
    root.rng = chances_.trunk;
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
    double chance;
  };

  Directions directions(const Node& node) const;
  std::uint32_t draw(const Node& node);
  void fork(const Node& node);
  void twig(const Node& node, const Node& child, std::uint32_t joint);

  double falloff(bool on_trunk) const { return on_trunk ? p_.mTaperRate : p_.mRadiusFalloffRate; }

  const TreeParams& p_;
  const Chances& chances_;
  SkeletonWriter& writer_;
  std::vector<Node> waiting_;
  bool is_first_ = false;
};

glm::dvec3 unit(const glm::dvec3& v) { return math::unit(v, glm::dvec3{0, 1, 0}); }

/// The two directions of a fork: the first keeps to its parent, the second is nearly its mirror image.
Forker::Directions Forker::directions(const Node& node) const {
  const std::int32_t depth = p_.mLevels - node.levels;
  Rng chance = node.rng.at("fork");
  const double r = chance.unit();
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

/// The branch of a node: from where it begins to its own fork. The trunk takes its flare along.
std::uint32_t Forker::draw(const Node& node) {
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

void Forker::fork(const Node& node) {
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
  side.rng = (node.on_trunk ? chances_.branches.at(static_cast<std::uint64_t>(node.steps)) : node.rng).at(1);
  main.radius = side.radius = std::min(node.radius * p_.mRadiusFalloffRate, std::max(node.length, 1e-3));
  main.levels = side.levels = node.levels - 1;
  main.order = node.order;
  side.order = node.order + 1;
  side.starts_limb = true;
  if (node.levels > 0 && node.steps > 0) {
    const double kink = (2 * r - 1) * p_.mTrunkKink;
    main.head = node.head + glm::dvec3{kink, p_.mClimbRate, kink};
    main.on_trunk = true;
    main.length = length * p_.mTaperRate;
    main.radius = std::min(node.radius * p_.mTaperRate, std::max(node.length, 1e-3));
    main.levels = node.levels;
    main.steps = node.steps - 1;
  }
  for (const Node* child : {&side, &main}) {
    if (child->levels < 0) twig(node, *child, joint);
    waiting_.push_back(*child);
  }
}

/// A square of twice mTwigScale that begins a little before the branch does.
void Forker::twig(const Node& node, const Node& child, std::uint32_t joint) {
  const std::uint64_t key = chances_.leaves.at(child.rng.key()).key();
  if (!writer_.wants_leaf(key)) return;
  const glm::dvec3 ahead = unit(child.head - node.head);
  const glm::dvec3 behind = unit(node.head - node.tail);
  const glm::dvec3 normal = math::unit(glm::cross(behind, ahead), glm::dvec3{0, 0, 1});
  Frame frame;
  frame.up = glm::cross(normal, ahead);
  SkeletonWriter::Leaf leaf;
  leaf.frame = headed(frame, ahead);
  if (leaf.frame.up.y < 0) leaf.frame = {leaf.frame.heading, -leaf.frame.left, -leaf.frame.up};
  leaf.position = node.head;
  leaf.length = 2 * p_.mTwigScale;
  leaf.width = 2 * p_.mTwigScale;
  leaf.joint = joint;
  leaf.key = key;
  writer_.add(leaf);
}

}  // namespace

void grow_proctree(const TreeParams& params, const Chances& chances, SkeletonWriter& writer) {
  Forker(params, chances, writer).run();
}

}  // namespace seedmesh::tree
