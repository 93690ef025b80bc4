#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {
namespace {

// Of the bark of an internode, and of a leaf: a triangular tube, two triangles a side; a card.
constexpr std::uint64_t least_triangles_a_joint = 6, least_triangles_a_leaf = 2;

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
      density_(density) {}

std::uint32_t SkeletonWriter::add(const Joint& joint) {
  modules_.spend();
  if (limbs_.size() >= end_joints_) throw Enough{};
  if (limbs_.size() >= most_joints_) {
    Job::refuse("the tree has more than " + std::to_string(most_joints_) +
                " internodes, whose bark would pass the limit of triangles");
  }
  limbs_.position.push_back(glm::vec3(joint.position));
  limbs_.radius.push_back(static_cast<float>(joint.radius));
  limbs_.base_radius.push_back(static_cast<float>(joint.base_radius));
  limbs_.parent.push_back(joint.parent);
  limbs_.starts_limb.push_back(joint.starts_limb ? 1 : 0);
  limbs_.color.push_back(0);
  limbs_.order.push_back(static_cast<std::uint16_t>(joint.order));
  limbs_.key.push_back(joint.key);
  return static_cast<std::uint32_t>(limbs_.size() - 1);
}

void SkeletonWriter::refuse_leaves() const {
  Job::refuse("the tree has more than " + std::to_string(most_leaves_) +
              " leaves, which would pass the limit of triangles");
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
