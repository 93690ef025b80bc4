#pragma once
/// Where a limb leaves another: the loop that both surfaces share.
#include <optional>
#include <span>
#include <vector>

#include "core/geom/graft_axis.h"

namespace seedmesh {

/// A point of the loop. `phase` is its angle about the child's axis, from the side of the parent's tip.
struct LoopPoint {
  glm::vec3 position{0};
  float phase = 0;
  float angle = 0;   ///< about the parent, from the opening's middle
  float height = 0;  ///< along the parent
  float reach = 0;   ///< along the child
};

struct Opening {
  std::uint32_t limb = 0;           ///< the child
  float at = 0, low = 0, high = 0;  ///< along the parent: the ring that it lies on, and all it takes
  float middle = 0, half = 0;       ///< angles about the parent
  float radius = 0;                 ///< of the child at the loop
  float child_reach = 0;            ///< from the joint: the child's next ring stands beyond
  bool is_fork = false;
  std::size_t piece = 0;  ///< of the parent, whose frame the angles are in
  glm::vec3 child_u{0};   ///< the direction of phase 0 at the child
  LoopPoint first, last;  ///< the ends, which lie on the ring
  /// In the caller's list of points, strictly between the two ends, by rising angle: those below the ring,
  /// then those above.
  std::size_t points = 0, lower = 0, upper = 0;
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  std::uint32_t next = none;  ///< opening on the same ring

  std::span<const LoopPoint> below(const std::vector<LoopPoint>& all) const {
    return std::span(all).subspan(points, lower);
  }
  std::span<const LoopPoint> above(const std::vector<LoopPoint>& all) const {
    return std::span(all).subspan(points + lower, upper);
  }
};

/// A corner of a cross-section: its angle about the axis.
struct Phase {
  float angle = 0, cosine = 1, sine = 0;
};

/// The angles at which a cross-section of so many sides has its corners: symmetric about 0, and with just one
/// corner farthest to either side. Reckoned when they are first asked for.
class Phases {
 public:
  const std::vector<Phase>& of(int sides);

 private:
  std::vector<std::vector<Phase>> by_sides_;
};

/// What is known of a child before its loop.
struct Bud {
  std::uint32_t limb = 0;
  glm::vec3 along{0};
  float radius = 0, length = 0;  ///< length of the whole child
  float first_length = 0;        ///< of its first piece
  float tip = 0;                 ///< length up to its last ring, or to what was looked at
  int sides = 3;
  Phases* phases = nullptr;
};

/// A collar on the parent's piece after (or, for a limb that points back, before) its point `at_point`;
/// nullopt where there is no room. Appends to `points`.
std::optional<Opening> collar(const GraftAxis& parent, std::size_t at_point, const Bud& bud,
                              std::vector<LoopPoint>& points);

/// A fork at an inner point of the parent.
std::optional<Opening> fork_at(const GraftAxis& parent, std::size_t at_point, const Bud& bud,
                               std::vector<LoopPoint>& points);

}  // namespace seedmesh
