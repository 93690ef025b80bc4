#include "core/generators/tree/skeleton_writer.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"

namespace seedmesh::tree {
namespace {

// The bark of an internode is at least a tube of three sides, a leaf at least a square.
constexpr std::uint64_t least_triangles_a_joint = 6, least_triangles_a_leaf = 2;
// Joints of one part. Larger trees are rare, and are grown again on one thread without parts.
constexpr std::uint64_t most_of_a_part = std::uint64_t{1} << 18U;
constexpr std::uint64_t bytes_of_both = 128;  // at least, of a joint and a leaf
constexpr std::uint64_t spent_at_once = 4096;
// Memory is reserved for at most this many; larger arrays grow in place.
constexpr double most_expected = 12'288;

/// Spends in small amounts, so that the meter returns what it does not use.
void spend(Meter& meter, std::uint64_t amount) {
  for (; amount > spent_at_once; amount -= spent_at_once) meter.spend(spent_at_once);
  meter.spend(amount);
}

template <class T>
void copy_all(const Array<T>& from, Array<T>& to, std::size_t at) {
  std::copy(from.begin(), from.end(), to.begin() + at);
}

}  // namespace

Frame headed(const Frame& frame, const glm::dvec3& heading) {
  const glm::dvec3 left = glm::cross(frame.up, heading);
  const double size = glm::dot(left, left);
  const glm::dvec3 aside =
      size > 1e-12 ? left / std::sqrt(size)
                   : math::unit(glm::cross(heading, glm::dvec3{0.31, 0.07, 0.95}), glm::dvec3{1, 0, 0});
  return {heading, aside, glm::cross(heading, aside)};
}

SkeletonWriter::SkeletonWriter(Skeleton& skeleton, Job& job, double density)
    : limbs_(skeleton.limbs),
      organs_(skeleton.organs),
      job_(job),
      modules_(job, Resource::modules),
      shapes_(job, Resource::shapes),
      most_joints_(job.limits().triangles / least_triangles_a_joint),
      most_leaves_(job.limits().triangles / least_triangles_a_leaf),
      density_(density),
      drawn_below_(static_cast<std::uint64_t>(math::to_int64(std::ceil(density * 0x1p53)))) {}

SkeletonWriter::SkeletonWriter(Skeleton& part, const SkeletonWriter& whole, std::size_t most)
    : SkeletonWriter(part, whole.job_, whole.density_) {
  is_part_ = true;
  whole_ = &whole;
  least_radius_ = whole.least_radius_;
  marks_every_foot_ = whole.marks_every_foot_;
  first_ = whole.first_ + static_cast<std::uint32_t>(whole.limbs_.size());
  end_after(most, most);
}

std::size_t SkeletonWriter::most_of_parts(std::size_t parts) const {
  const Limits& limits = job_.limits();
  const std::uint64_t joints = this->joints();
  if (is_part_ || end_joints_ != ~std::size_t{0} || joints >= most_joints_ || leaves_ >= most_leaves_)
    return 0;
  const std::uint64_t left =
      std::min({limits.modules - job_.spent(Resource::modules), limits.shapes - job_.spent(Resource::shapes),
                most_joints_ - joints, most_leaves_ - leaves_, limits.memory_bytes / bytes_of_both});
  return static_cast<std::size_t>(std::min(most_of_a_part, left / (2 * std::max<std::size_t>(parts, 1))));
}

void SkeletonWriter::take(std::span<SkeletonWriter* const> parts) {
  std::vector<std::size_t> leaves;
  std::size_t last_joint = limbs_.size(), last_leaf = organs_.organ.size();
  for (SkeletonWriter* part : parts) {
    spend(modules_, part->joints());
    spend(shapes_, part->leaves_);
    leaves_ += part->leaves_;
    passed_ += part->passed_;
    passed_box_ = {glm::min(passed_box_.min, part->passed_box_.min),
                   glm::max(passed_box_.max, part->passed_box_.max)};
    part->taken_at_ = static_cast<std::uint32_t>(last_joint);
    leaves.push_back(last_leaf);
    last_joint += part->limbs_.size();
    last_leaf += part->organs_.organ.size();
  }
  each_array(limbs_, [&](auto& array) { array.resize(last_joint); });
  organs_.organ.resize(last_leaf);
  parallel_for(job_, parts.size(), 1,
               [&](std::size_t, std::size_t, std::size_t i) { copy(*parts[i], leaves[i]); });
}

/// The number of a joint of this part, or of a part before it, in the skeleton that takes all parts.
std::uint32_t SkeletonWriter::number_after_take(std::uint32_t joint) const {
  if (joint == Limbs::none) return joint;
  const SkeletonWriter* writer = this;
  while (writer->is_part_ && joint < writer->first_) writer = writer->whole_;
  return writer->is_part_ ? joint - writer->first_ + writer->taken_at_ : joint;
}

/// Copies a part; its leaves begin at index `leaf`.
void SkeletonWriter::copy(const SkeletonWriter& part, std::size_t leaf) {
  const std::size_t joint = part.taken_at_;
  copy_all(part.limbs_.position, limbs_.position, joint);
  copy_all(part.limbs_.radius, limbs_.radius, joint);
  copy_all(part.limbs_.base_radius, limbs_.base_radius, joint);
  copy_all(part.limbs_.starts_limb, limbs_.starts_limb, joint);
  copy_all(part.limbs_.color, limbs_.color, joint);
  copy_all(part.limbs_.order, limbs_.order, joint);
  copy_all(part.limbs_.key, limbs_.key, joint);
  for (std::size_t i = 0; i < part.limbs_.size(); ++i)
    limbs_.parent[joint + i] = part.number_after_take(part.limbs_.parent[i]);
  for (std::size_t i = 0; i < part.organs_.organ.size(); ++i) {
    Organ& organ = organs_.organ[leaf + i];
    organ = part.organs_.organ[i];
    organ.limb_joint = part.number_after_take(organ.limb_joint);
  }
}

void SkeletonWriter::expect(double joints, double leaves) {
  const auto bounded = [](double count) {
    return static_cast<std::size_t>(std::clamp(count, 0.0, most_expected));
  };
  const std::size_t count = bounded(joints);
  each_array(limbs_, [&](auto& array) { array.reserve(count); });
  organs_.organ.reserve(bounded(std::min(1.0, density_) * leaves));
}

std::uint32_t SkeletonWriter::add(const Joint& joint) {
  count_joint();
  write(joint);
  return first_ + static_cast<std::uint32_t>(limbs_.size() - 1);
}

void SkeletonWriter::write(const Joint& joint) {
  limbs_.position.push_back(glm::vec3(joint.position));
  limbs_.radius.push_back(static_cast<float>(joint.radius));
  limbs_.base_radius.push_back(static_cast<float>(joint.base_radius));
  limbs_.parent.push_back(joint.parent);
  limbs_.starts_limb.push_back(joint.starts_limb ? 1 : 0);
  limbs_.color.push_back(0);
  limbs_.order.push_back(static_cast<std::uint16_t>(joint.order));
  limbs_.key.push_back(joint.key);
}

void SkeletonWriter::finish() {
  if (passed_ == 0) return;
  for (const glm::vec3& corner : {passed_box_.min, passed_box_.max}) {
    Joint joint;
    joint.position = corner;
    write(joint);
  }
}

void SkeletonWriter::refuse_joints() const {
  job_.refuse(limit_issue({Resource::joints, most_joints_, most_joints_ + 1},
                          "the tree has more than " + std::to_string(most_joints_) +
                              " internodes, whose bark would exceed the limit of triangles"));
}

void SkeletonWriter::refuse_leaves() const {
  job_.refuse(limit_issue({Resource::leaves, most_leaves_, leaves_},
                          "the tree has more than " + std::to_string(most_leaves_) +
                              " leaves, which would exceed the limit of triangles"));
}

void SkeletonWriter::add(const Leaf& leaf) {
  Organ organ;
  organ.frame = quaternion(leaf.frame);
  organ.position = glm::vec3(leaf.position);
  organ.scale = glm::vec3(leaf.width, leaf.length, leaf.length);
  organ.limb_joint = leaf.joint;
  organ.key = leaf.key;
  add(organ);
}

}  // namespace seedmesh::tree
