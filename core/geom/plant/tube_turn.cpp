/// The parts of the tube writer for coarser levels of detail, where tubes have few corners: rings that are
/// turned against each other, flat ends, and the floor of the finest level.
#include "core/geom/plant/tube_writer.h"

namespace seedmesh {
namespace {

// Rings are turned against each other where faces lean by at most one part in this number: the middles of
// their sides are nearer to the axis than their corners.
constexpr float least_lean = 2;

}  // namespace

/// Decides before each ring except the first whether it is turned by half a side against the ring before it, at
/// the distance `way`.
void TubeWriter::turn_on(float way, float radius) {
  if (section_.sides == finest_sides_ || has_contours()) return;
  if (way < least_lean * (1 - tables().half_side.x) * radius) return;
  is_turned_ = !is_turned_;
}

TubeWriter::Ring TubeWriter::turned(const Ring& ring) const {
  const glm::vec2 by = tables().half_side;
  Ring out = ring;
  out.side_u = ring.side_u * by.x + ring.side_v * by.y;
  out.side_v = ring.side_v * by.x - ring.side_u * by.y;
  out.normal_u = ring.normal_u * by.x + ring.normal_v * by.y;
  out.normal_v = ring.normal_v * by.x - ring.normal_u * by.y;
  out.is_turned = false;
  out.sides_on = 0.5F;
  return out;
}

/// A flat floor with vertices of its own, since bark and floor have different normals.
void TubeWriter::write_disc(const Ring& ring) {
  const glm::vec3 normal = -ring.tangent + 0.0F;
  const std::uint32_t centre = write_apex(ring.centre, normal, {0, 0});
  const std::size_t rim = here_->vertex;
  for (std::uint32_t k = 0; k < section_.sides; ++k) {
    const glm::vec2 at = has_contours() ? corner(ring, k).at : tables().circle[k];
    here_->position[rim + k] = (ring.centre + 0.0F) + ring.side_u * at.x + ring.side_v * at.y;
    here_->normal[rim + k] = normal;
    if (here_->uv) here_->uv[rim + k] = at * ring.radius;
  }
  write_bones(rim, section_.sides, ring.joint);
  here_->vertex += section_.sides;
  std::uint32_t* out = here_->index + here_->corner;
  for (std::uint32_t k = 0; k < section_.sides; ++k) {
    *out++ = centre;
    *out++ = static_cast<std::uint32_t>(rim) + (k + 1) % section_.sides;
    *out++ = static_cast<std::uint32_t>(rim) + k;
  }
  here_->corner += std::size_t{3} * section_.sides;
}

/// A face across a ring, in the direction of the limb (`way` 1) or against it (-1).
void TubeWriter::write_flat(const Ring& ring, float way) {
  const std::size_t rim = here_->vertex;
  for (std::uint32_t k = 0; k < section_.sides; ++k) {
    const glm::vec2 at = tables().circle[k];
    // The same operations as in write_ring(), so that the bits agree.
    here_->position[rim + k] = (ring.centre + 0.0F + ring.side_u * at.x) + ring.side_v * at.y;
    here_->normal[rim + k] = ring.tangent * way + 0.0F;
    if (here_->uv) here_->uv[rim + k] = at * ring.radius + 0.0F;
  }
  write_bones(rim, section_.sides, ring.joint);
  here_->vertex += section_.sides;
  std::uint32_t* out = here_->index + here_->corner;
  for (std::uint32_t k = 1; k + 1 < section_.sides; ++k) {
    *out++ = static_cast<std::uint32_t>(rim);
    *out++ = static_cast<std::uint32_t>(rim) + (way > 0 ? k : k + 1);
    *out++ = static_cast<std::uint32_t>(rim) + (way > 0 ? k + 1 : k);
  }
  here_->corner += std::size_t{3} * (section_.sides - 2);
}

}  // namespace seedmesh
