#pragma once
/// The junction of a side limb with its parent: the closed loop of points that both surfaces share.
#include <optional>
#include <span>
#include <vector>

#include "core/geom/plant/graft/limb_axis.h"

namespace seedmesh {

// There are two kinds of junctions. A collar is the intersection of the tubes of a thin limb and its parent.
// A fork joins limbs of about the same thickness. It consists of three half rings that share two points: one
// across the incoming limb, one across the outgoing limb, and one in the crotch between them.

/// For a limb with at least this share of its parent's radius, a fork is tried before a collar.
constexpr float fork_share = 0.55F;
/// A limb with a radius below this number times Scale::thinnest stays a closed tube.
constexpr float least_opened_radius = 3;

/// A point of the loop. `phase` is its angle about the child's axis, measured from the side of the parent's
/// tip.
struct LoopPoint {
  glm::vec3 position{0};
  float phase = 0;
  float angle = 0;   ///< about the parent's axis, from the middle of the junction
  float height = 0;  ///< height along the parent
  float reach = 0;   ///< distance from the joint along the axis of the child
};

struct Junction {
  std::uint32_t limb = 0;  ///< the child
  /// `at` is the height along the parent of the ring on which the ends of the loop lie. `low` and `high` are
  /// the lowest and highest heights of the loop.
  float at = 0, low = 0, high = 0;
  float middle = 0, half_width = 0;  ///< angles about the parent
  float radius = 0;                  ///< radius of the child at the loop
  float child_reach = 0;             ///< greatest LoopPoint::reach; the next ring of the child lies beyond it
  bool is_fork = false;
  std::size_t piece = 0;  ///< piece of the parent; the angles are in its frame
  glm::vec3 child_u{0};   ///< the direction of phase 0 at the child
  LoopPoint first, last;  ///< the two ends, which lie on the ring
  /// The points strictly between the ends, in the caller's list, by rising angle: `lower` points below the
  /// ring from index `points` on, then `upper` points above it.
  std::size_t points = 0, lower = 0, upper = 0;
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::uint32_t next = none;  ///< the next junction on the same ring

  std::span<const LoopPoint> below(const std::vector<LoopPoint>& all) const {
    return std::span(all).subspan(points, lower);
  }
  std::span<const LoopPoint> above(const std::vector<LoopPoint>& all) const {
    return std::span(all).subspan(points + lower, upper);
  }
};

/// A corner of a cross-section: its angle about the axis.
struct LoopAngle {
  float angle = 0, cosine = 1, sine = 0;
};

/// The angles of the corners of a loop: symmetric about 0, and with exactly one corner farthest to either
/// side. Each number of sides is computed on first use.
class LoopAngles {
 public:
  const std::vector<LoopAngle>& of(int sides);

 private:
  std::vector<std::vector<LoopAngle>> by_sides_;
};

/// A side limb before its junction is made.
struct ChildLimb {
  std::uint32_t limb = 0;
  glm::vec3 along{0};  ///< direction of its first piece
  /// Radius of the first ring; length of the limb, or of the part that was read.
  float radius = 0, length = 0;
  float tip = 0;  ///< length up to its last ring, or up to what was read
  int sides = 3;
  LoopAngles* angles = nullptr;
};

/// Returns a collar at point `at_point` of the parent. It lies on the piece after the point, or on the piece before
/// it if the limb points backward. Appends its points to `points`. Returns nullopt where the limb leaves at too flat
/// an angle, or is too thick or too short.
std::optional<Junction> collar_at(const LimbAxis& parent, std::size_t at_point, const ChildLimb& child,
                                  std::vector<LoopPoint>& points);

/// Returns a fork at an inner point of the parent, after P. Brunt, proctree, 2012. Appends its points to `points`.
/// Returns nullopt where the radii differ too much, or where the tubes separate too far from the joint.
std::optional<Junction> fork_at(const LimbAxis& parent, std::size_t at_point, const ChildLimb& child,
                                std::vector<LoopPoint>& points);

}  // namespace seedmesh
