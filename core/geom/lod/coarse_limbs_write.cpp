#include "core/geom/lod/coarsening.h"

namespace seedmesh {
namespace {

template <class T>
void copy_row(const Array<T>& from, std::uint32_t joint, Array<T>& to) {
  if (!from.empty()) to.push_back(from[joint]);
}

}  // namespace

std::uint32_t Coarsening::add(std::size_t limb, std::uint32_t joint, std::uint32_t parent,
                              CoarseLimbs& out) const {
  Limbs& to = out.limbs;
  to.position.push_back(position_of(joint));
  copy_row(limbs_.radius, joint, to.radius);
  copy_row(limbs_.base_radius, joint, to.base_radius);
  to.parent.push_back(parent);
  to.starts_limb.push_back(0);
  if (options_.skin) out.corners.push_back(corners_[limb]);
  copy_row(limbs_.color, joint, to.color);
  copy_row(limbs_.order, joint, to.order);
  copy_row(limbs_.frame, joint, to.frame);
  copy_row(limbs_.contour, joint, to.contour);
  copy_row(limbs_.birth, joint, to.birth);
  if (options_.skin) {
    to.key.push_back(key_of(joint));
  } else {
    copy_row(limbs_.key, joint, to.key);
  }
  copy_row(limbs_.anchor, joint, to.anchor);
  out.was.push_back(joint);
  return static_cast<std::uint32_t>(to.size() - 1);
}

void Coarsening::write_limb(std::size_t limb, float multiplier, CoarseLimbs& out,
                            Array<std::uint32_t>& place) {
  const std::uint32_t head = chains_.head[limb];
  const bool is_root = limbs_.parent[head] == Limbs::none;
  Limbs& to = out.limbs;
  std::size_t before = begin(limb);
  std::uint32_t parent =
      is_root ? place[head] = add(limb, head, Limbs::none, out) : place[limbs_.parent[head]];
  glm::vec3 from = to.position[parent];  // of a branch: the new position of its parent's joint
  float from_radius = stations_[before].radius;
  bool starts = !is_root, is_first = true;
  for (std::size_t i = before + 1; i < end(limb); ++i) {
    if (!stays(limb, i, multiplier)) continue;
    const Station& last = stations_[i];
    const glm::vec3 to_position = last.position;
    float length = 0;
    for (std::size_t k = before + 1; k <= i; ++k)
      length += glm::distance(stations_[k].position, stations_[k - 1].position);
    float along = 0, at_radius = from_radius;
    for (std::size_t k = before + 1; k <= i; ++k) {
      const Station& each = stations_[k];
      along += glm::distance(each.position, stations_[k - 1].position);
      if (k < i && !is_fork_[each.joint]) continue;
      const float share = length > 0 ? along / length : 1.0F;
      const float radius = k == i ? last.radius : from_radius + (last.radius - from_radius) * share;
      const std::uint32_t joint = add(limb, each.joint, parent, out);
      place[each.joint] = joint;
      if (k < i) to.position[joint] = from + (to_position - from) * share;
      to.starts_limb[joint] = starts ? 1 : 0;
      starts = false;
      // The key of its first joint determines the rotation of a limb.
      if (options_.skin && is_first) to.key[joint] = key_of(stations_[begin(limb) + 1].joint);
      is_first = false;
      to.base_radius[joint] = at_radius * widening(limb, at_radius);
      to.radius[joint] = radius * widening(limb, radius);
      at_radius = radius;
      parent = joint;
    }
    from = to_position;
    before = i;
    // The radius may change abruptly at a joint.
    from_radius = i + 1 < end(limb) ? limbs_.base_radius[stations_[i + 1].joint] : last.radius;
  }
}

CoarseLimbs Coarsening::write(float multiplier) {
  CoarseLimbs out{Limbs(job_), Array<std::uint32_t>(job_), {}};
  Array<std::uint32_t> place(job_, limbs_.size(), Limbs::none);
  for (std::size_t limb = 0; limb < area_.size(); ++limb) {
    if (limb % check_interval == 0) job_.check();
    if (kept_[limb]) write_limb(limb, multiplier, out, place);
  }
  // An anchor at a removed joint moves to the nearest ancestor that is kept.
  for (std::uint32_t& anchor : out.limbs.anchor) {
    std::uint32_t joint = anchor;
    while (joint != Limbs::none && place[joint] == Limbs::none) joint = limbs_.parent[joint];
    anchor = joint == Limbs::none ? Limbs::none : place[joint];
  }
  return out;
}

}  // namespace seedmesh
