#include "core/generators/tree/grown_skeleton.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/generators/tree/leaf_frames.h"

namespace seedmesh::tree {
namespace {

// Cosine of the bend from which on a limb has a joint, and the longest piece without one in internodes.
constexpr double straight = 0.985;
constexpr int longest_piece = 6;
// Wood of this number of tip radii is smooth; thinner wood less.
constexpr double smooth_from = 5;
constexpr int smoothings = 2;
// The flare ends at this share of the height.
constexpr double flare_share = 1.0 / 8;
// Leaves unfold in this share of a year.
constexpr double unfolding = 0.3;

/// What the nodes of a plant become.
struct Shape {
  explicit Shape(Job& job, std::size_t size)
      : position(job, size),
        radius(job, size),
        follower(job, size, Limbs::none),
        joint(job, size, Limbs::none) {}
  Array<glm::dvec3> position;
  Array<double> radius;
  Array<std::uint32_t> follower;  ///< the child that continues the limb
  Array<std::uint32_t> joint;     ///< joint with which the node moves
  double height = 0;
};

void place_nodes(const GrownPlant& plant, const TreeGrown& grown, const GrownTime& time, Shape& shape) {
  const double exponent = 1 / grown.radius_exponent;
  for (std::size_t i = 0; i < plant.nodes.size(); ++i) {
    const GrownNode& node = plant.nodes[i];
    const double area = node.area_before + (node.area - node.area_before) * time.share;
    shape.radius[i] = std::max(math::pow(area, exponent), 0.2 * grown.tip_radius);
    shape.position[i] = node.position;
    if (node.parent == Limbs::none) continue;
    if (node.born == time.year) {
      const glm::dvec3 whole = node.position - plant.nodes[node.parent].position;
      shape.position[i] = shape.position[node.parent] + whole * time.share;
    }
    std::uint32_t& follower = shape.follower[node.parent];
    const auto is_thinner = [&] {
      const GrownNode& other = plant.nodes[follower];
      return other.area < node.area || (other.area == node.area && !other.continues && node.continues);
    };
    if (follower == Limbs::none || is_thinner()) follower = static_cast<std::uint32_t>(i);
    if (node.tree == 0) shape.height = std::max(shape.height, shape.position[i].y);
  }
}

void smooth(const GrownPlant& plant, const TreeGrown& grown, Shape& shape, Job& job) {
  Array<glm::dvec3> before(job, plant.nodes.size());
  for (int pass = 0; pass < smoothings; ++pass) {
    std::copy(shape.position.begin(), shape.position.end(), before.begin());
    for (std::size_t i = 0; i < plant.nodes.size(); ++i) {
      const std::uint32_t parent = plant.nodes[i].parent, next = shape.follower[i];
      if (parent == Limbs::none || next == Limbs::none) continue;
      const double share = 0.5 * std::min(1.0, shape.radius[i] / (smooth_from * grown.tip_radius));
      shape.position[i] = before[i] + ((before[parent] + before[next]) * 0.5 - before[i]) * share;
    }
  }
}

/// A limb to be written.
struct Start {
  std::uint32_t node = 0;
  int order = 0;
  bool has_bark = true;
};

class GrownWriter {
 public:
  GrownWriter(const GrownPlant& plant, const TreeParams& params, const GrownTime& time,
              SkeletonWriter& writer)
      : plant_(plant),
        p_(params),
        g_(params.grown),
        time_(time),
        writer_(writer),
        shape_(writer.job(), plant.nodes.size()),
        next_(writer.job(), plant.nodes.size(), Limbs::none),
        first_(writer.job(), plant.nodes.size(), Limbs::none) {
    place_nodes(plant, g_, time, shape_);
    smooth(plant, g_, shape_, writer.job());
    for (std::size_t i = plant.nodes.size(); i-- > 0;) {
      const std::uint32_t parent = plant.nodes[i].parent;
      if (parent == Limbs::none) continue;
      next_[i] = first_[parent];
      first_[parent] = static_cast<std::uint32_t>(i);
    }
  }

  void run(const RandomStreams& random) {
    SkeletonWriter::Joint foot;
    foot.radius = foot.base_radius = flared(0, shape_.follower[0] == Limbs::none ? 0 : shape_.follower[0]);
    foot.key = plant_.nodes[0].key;
    shape_.joint[0] = writer_.add(foot);
    begin_limbs(0, 0, true);
    while (!waiting_.empty()) {
      const Start start = waiting_.back();
      waiting_.pop_back();
      write_limb(start);
    }
    if (g_.leaves > 0) write_leaves(random);
  }

 private:
  double flared(double height, std::uint32_t node) const {
    const double low = std::max(0.0, 1 - height / std::max(1e-6, flare_share * shape_.height));
    return shape_.radius[node] * (1 + p_.trunk_flare * low * low * low);
  }
  bool begins_limb(std::uint32_t node) const { return shape_.follower[plant_.nodes[node].parent] != node; }
  void begin_limbs(std::uint32_t node, int order, bool has_bark);
  bool needs_joint(std::uint32_t node, const glm::dvec3& from, int passed) const;
  void write_limb(const Start& start);
  void flare_foot(std::uint32_t node, SkeletonWriter::Joint& joint);
  void write_leaves(const RandomStreams& random);

  const GrownPlant& plant_;
  const TreeParams& p_;
  const TreeGrown& g_;
  const GrownTime& time_;
  SkeletonWriter& writer_;
  Shape shape_;
  Array<std::uint32_t> next_, first_;  ///< children as linked lists
  std::vector<Start> waiting_;
};

/// Puts the limbs that begin at a node, and that which continues at the foot, on the list.
void GrownWriter::begin_limbs(std::uint32_t node, int order, bool has_bark) {
  for (std::uint32_t child = first_[node]; child != Limbs::none; child = next_[child]) {
    if (begins_limb(child)) waiting_.push_back({child, order + 1, has_bark});
  }
  if (plant_.nodes[node].parent == Limbs::none && shape_.follower[node] != Limbs::none)
    waiting_.push_back({shape_.follower[node], order, has_bark});
}

bool GrownWriter::needs_joint(std::uint32_t node, const glm::dvec3& from, int passed) const {
  const std::uint32_t next = shape_.follower[node];
  if (next == Limbs::none || passed >= longest_piece) return true;
  for (std::uint32_t child = first_[node]; child != Limbs::none; child = next_[child]) {
    if (child != next && (writer_.marks_every_foot() || !writer_.leaves_out(shape_.radius[child])))
      return true;
  }
  const glm::dvec3 here = shape_.position[node] - from, ahead = shape_.position[next] - shape_.position[node];
  const double along = glm::dot(here, ahead);
  return along <= 0 || along * along < straight * glm::dot(here, here) * glm::dot(ahead, ahead);
}

/// Writes the joints of the flare, up to the first node.
void GrownWriter::flare_foot(std::uint32_t node, SkeletonWriter::Joint& joint) {
  if (!(p_.trunk_flare > 0)) return;
  for (const double share : {1.0 / 6, 1.0 / 2}) {
    joint.position = shape_.position[node] * std::min(1.0, share * flare_share * shape_.height /
                                                               std::max(1e-6, shape_.position[node].y));
    if (joint.position.y >= 0.9 * shape_.position[node].y) return;
    joint.base_radius = writer_.radius(joint.parent);
    joint.radius = flared(joint.position.y, node);
    joint.key = key_at(plant_.nodes[0].key, static_cast<std::uint64_t>(64 * share));
    joint.parent = writer_.add(joint);
  }
  joint.base_radius = writer_.radius(joint.parent);
}

void GrownWriter::write_limb(const Start& start) {
  const std::uint32_t root = plant_.nodes[start.node].parent;
  const bool has_bark = start.has_bark && !writer_.leaves_out(shape_.radius[start.node]);
  SkeletonWriter::Joint joint;
  joint.parent = shape_.joint[root];
  joint.starts_limb = start.order > 0;
  joint.order = start.order;
  joint.base_radius = start.order == 0 ? writer_.radius(joint.parent) : shape_.radius[start.node];
  if (start.order == 0) flare_foot(start.node, joint);
  glm::dvec3 from = shape_.position[root];
  std::vector<std::uint32_t> passed;
  for (std::uint32_t node = start.node; node != Limbs::none; node = shape_.follower[node]) {
    if (!has_bark) {
      writer_.pass_over(shape_.position[node]);
      shape_.joint[node] = joint.parent;
      begin_limbs(node, start.order, false);
      continue;
    }
    passed.push_back(node);
    if (!needs_joint(node, from, static_cast<int>(passed.size()))) continue;
    joint.position = shape_.position[node];
    joint.radius = start.order == 0 ? flared(joint.position.y, node) : shape_.radius[node];
    joint.key = plant_.nodes[node].key;
    joint.parent = writer_.add(joint);
    joint.base_radius = joint.radius;
    joint.starts_limb = false;
    from = joint.position;
    for (const std::uint32_t each : passed) {
      shape_.joint[each] = joint.parent;
      begin_limbs(each, start.order, true);
    }
    passed.clear();
  }
}

void GrownWriter::write_leaves(const RandomStreams& random) {
  for (std::uint32_t i = 0; i < plant_.nodes.size(); ++i) {
    const GrownNode& node = plant_.nodes[i];
    if (node.tree != 0 || node.parent == Limbs::none || time_.year - node.born >= g_.leaf_years) continue;
    const Rng rng = random.leaves.at(node.key);
    const Frame stem = upright(headed(Frame{}, node.heading));
    const double open = node.born == time_.year ? std::min(1.0, time_.share / unfolding) : 1;
    for (int k = 0; k < g_.leaves; ++k) {
      const Rng own = rng.at(static_cast<std::uint64_t>(k));
      if (!writer_.wants_leaf(own.key())) continue;
      const bool is_last = k + 1 == g_.leaves && shape_.follower[i] == Limbs::none;
      const double around = 137.5 * (node.number * g_.leaves + k) + spread(own.at("around"), 20);
      const double angle = is_last ? 0 : g_.leaf_angle + spread(own.at("angle"), 15);
      SkeletonWriter::Leaf leaf;
      leaf.frame = pitch(roll(stem, math::quick_sincos_degrees(around)), math::quick_sincos_degrees(angle));
      const glm::dvec3 base = shape_.position[node.parent];
      leaf.position = base + (shape_.position[i] - base) * ((k + 1.0) / g_.leaves);
      leaf.frame = upper_side_up(turned_to_light(leaf.frame, leaf.position, g_.leaf_bend));
      leaf.length = g_.leaf_length * std::max(open, 1e-3);
      leaf.width = leaf.length * g_.leaf_width;
      leaf.joint = shape_.joint[i];
      leaf.key = own.key();
      writer_.add(leaf);
    }
  }
}

}  // namespace

void write_grown(const GrownPlant& plant, const TreeParams& params, const GrownTime& time,
                 const RandomStreams& random, SkeletonWriter& writer) {
  GrownWriter(plant, params, time, writer).run(random);
}

}  // namespace seedmesh::tree
