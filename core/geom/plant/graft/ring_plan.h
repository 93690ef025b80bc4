#pragma once
/// The plan of one limb: which rings it has, and which junctions with side limbs lie on them.
///
/// The steps are: begin_plan(); add_junction() for each side limb, thick ones first; complete_plan().
#include <vector>

#include "core/geom/plant/graft/graft.h"
#include "core/geom/plant/graft/junction.h"

namespace seedmesh {

/// A ring is kept where the axis has turned by more than 9 degrees since the last ring; straight_cosine is the cosine
/// of that angle. It is also kept where the radius differs by more than the share radius_tolerance from an even
/// taper.
constexpr float straight_cosine = 0.9877F, radius_tolerance = 0.05F;

struct PlannedRing {
  float at = 0, low = 0, high = 0;  ///< length along the limb, and the extent of the junctions on the ring
  std::size_t piece = 0;            ///< piece of the axis
  bool is_bend = false;             ///< lies at the point where `piece` begins, across both pieces
  /// First and last junction of a list that is linked by Junction::next.
  std::uint32_t first = Junction::none, last = Junction::none;
  bool is_open() const { return first != Junction::none; }
};

struct RingPlan {
  std::vector<Junction> junction;
  std::vector<LoopPoint> loop_point;                        ///< loop points of all junctions
  std::vector<PlannedRing> ring;                            ///< rings, sorted by ascending `at`
  float start = 0, tip = 0, least_distance = 0, bulge = 0;  ///< arguments of begin_plan()
  std::vector<PlannedRing> scratch;
};

/// Empties the plan. Rings may lie from the length `start` up to `tip`. `least_distance` is Scale::apart.
/// `bulge` is the distance between the circle and the side of a cross-section, as a share of the radius:
/// loops lie on the circle, so rings keep that distance from them.
void begin_plan(RingPlan& plan, float start, float tip, float least_distance, float bulge);

/// Adds a junction for a child at point `at_point` of the axis: a fork for a thick child, else a collar. It may share
/// the ring of another junction. Returns false where no kind of junction fits; the child is then written as a closed
/// tube.
bool add_junction(RingPlan& plan, const LimbAxis& axis, std::size_t at_point, const ChildLimb& child);

/// Adds the rings that bends, changes of radius and colour borders need, and the last ring, unless
/// `options.pointed` makes a thin end a point. `has_first`: also a ring soon after the beginning.
void complete_plan(RingPlan& plan, const LimbAxis& axis, bool has_first, const GraftOptions& options);

}  // namespace seedmesh
