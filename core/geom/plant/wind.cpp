#include "core/geom/plant/wind.h"

#include <algorithm>
#include <cmath>

#include "core/base/job.h"
#include "core/base/rng.h"
#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {
namespace {

// Radii below this share of the thickest count as this share: the bend of a thin limb is bounded.
constexpr float thinnest_share = 0.02F;
// The axis of a root lies at most this number of its radii above the ground.
constexpr float lowest_in_radii = 2.5F;

}  // namespace

WindField::WindField(const Limbs& limbs, std::span<const std::uint32_t> was, const WindField& finest,
                     Job& job)
    : limbs_(limbs),
      sway_(job, limbs.size()),
      height_(finest.height_),
      most_(finest.most_),
      thickest_(finest.thickest_) {
  for (std::size_t i = 0; i < limbs.size(); ++i) sway_[i] = finest.sway_[was[i]];
}

WindField::WindField(const Limbs& limbs, Job& job) : limbs_(limbs), sway_(job, limbs.size(), glm::vec2(0)) {
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    height_ = std::max(height_, limbs.position[i].y);
    if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
  }
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    const bool is_trunk = limbs.order.empty() || limbs.order[i] == 0;
    if (parent == Limbs::none || is_trunk) continue;
    const bool leaves_trunk = limbs.starts_limb[i] && limbs.order[parent] == 0;
    const std::uint64_t key = limbs.key.empty() ? i : limbs.key[i];
    sway_[i] = sway_[parent];
    if (leaves_trunk) sway_[i].y = fraction_of(key_at(key, 0x3149));
    // Roots do not move: what lies in the ground, or low above it for its thickness.
    if (limbs.position[i].y <= lowest_in_radii * limbs.base_radius[i]) continue;
    const glm::vec3 step = limbs.position[i] - limbs.position[parent];
    const float thickness = std::max(limbs.radius[i], thinnest_share * thickest_);
    sway_[i].x += std::sqrt(glm::dot(step, step) * (thickest_ / thickness));
    most_ = std::max(most_, sway_[i].x);
  }
  for (glm::vec2& each : sway_) each.x = std::min(1.0F, each.x / most_);
}

glm::vec2 WindField::at(std::uint32_t joint, const glm::vec3& point) const {
  if (joint == Limbs::none) return {0, 0};
  const std::uint32_t parent = limbs_.parent[joint];
  if (parent == Limbs::none) return sway_[joint];
  const glm::vec3 along = limbs_.position[joint] - limbs_.position[parent];
  const float length = glm::dot(along, along);
  if (!(length > 0)) return sway_[joint];
  const float share = std::clamp(glm::dot(point - limbs_.position[parent], along) / length, 0.0F, 1.0F);
  return {sway_[parent].x + (sway_[joint].x - sway_[parent].x) * share, sway_[joint].y};
}

float WindField::trunk_bend(float height) const {
  if (!(height_ > 0)) return 0;
  const float share = std::clamp(height / height_, 0.0F, 1.0F);
  return share * share;
}

void add_wind(Mesh& mesh, const Array<std::uint32_t>& joint, const WindField& wind, const Job& job) {
  const std::size_t count = mesh.position.size();
  mesh.uv[2] = Array<glm::vec2>(job, count);
  mesh.uv[3] = Array<glm::vec2>(job, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4096 == 0) job.check();
    const glm::vec2 sway = wind.at(joint[i], mesh.position[i]);
    mesh.uv[2][i] = {wind.trunk_bend(mesh.position[i].y), sway.x};
    mesh.uv[3][i] = {sway.y, 0};
  }
}

}  // namespace seedmesh
