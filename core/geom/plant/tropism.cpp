#include "core/geom/plant/tropism.h"

#include <algorithm>
#include <cmath>

namespace seedmesh {
namespace {

/// v rotated about the unit vector `axis` (Rodrigues).
glm::dvec3 turned_about(const glm::dvec3& axis, const math::SinCos& angle, const glm::dvec3& v) {
  return v * angle.cos + glm::cross(axis, v) * angle.sin + axis * (glm::dot(axis, v) * (1 - angle.cos));
}

}  // namespace

Tropisms::Tropisms(std::vector<Tropism> all) : all_(std::move(all)) {
  for (const Tropism& each : all_) elasticity_.push_back(each.elasticity);
}

void Tropisms::set(std::size_t index, double elasticity) {
  if (index < elasticity_.size()) elasticity_[index] = elasticity;
}

void Tropisms::change(std::size_t index, double steps) {
  if (index < elasticity_.size()) elasticity_[index] += steps * all_[index].step;
}

Frame Tropisms::turned(const Frame& frame, double share) const {
  Frame f = frame;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (elasticity_[i] == 0) continue;
    const glm::dvec3 torque = glm::cross(f.heading, all_[i].direction);
    const double strength = std::sqrt(glm::dot(torque, torque));
    if (strength < 1e-12) continue;  // parallel to T: there is no direction to turn to
    const math::SinCos angle = math::sincos(elasticity_[i] * strength * share);
    const glm::dvec3 axis = torque / strength;
    f.heading = turned_about(axis, angle, f.heading);
    f.left = turned_about(axis, angle, f.left);
    f = reorthonormalise(f);
  }
  return f;
}

void Tropisms::pop() {
  if (stack_.size() < elasticity_.size()) return;
  const auto from = stack_.end() - static_cast<std::ptrdiff_t>(elasticity_.size());
  std::copy(from, stack_.end(), elasticity_.begin());
  stack_.erase(from, stack_.end());
}

}  // namespace seedmesh
