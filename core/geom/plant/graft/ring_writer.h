#pragma once
/// Writes the rings of one limb: vertices of plain rings, and of rings that side limbs leave.
#include <vector>

#include "core/geom/plant/graft/bark_buffers.h"
#include "core/geom/plant/graft/graft_input.h"
#include "core/geom/plant/graft/ring_plan.h"
#include "core/geom/plant/graft/ring_strip.h"

namespace seedmesh {

/// The plane of a ring: `u` and `v` are the directions of the angles 0 and 90 degrees.
struct RingPlane {
  glm::vec3 centre{0}, u{0}, v{0}, tangent{0};
  float radius = 0, at = 0;  ///< `at`: length along the limb
  float v_at = 0;            ///< texture coordinate
  float slope = 0;           ///< decrease of the radius for each metre of the limb
};

/// A corner of an open ring before it becomes a vertex: a corner of the circle, or a point of a loop.
struct OpenCorner {
  float angle = 0;
  int corner = 0;                    ///< corner of the circle
  const LoopPoint* point = nullptr;  ///< null: a corner of the circle
  std::uint32_t group = Limbs::none;
  std::uint32_t vertex[2] = {Limbs::none, Limbs::none};  ///< vertices before the seam and after it
};

/// The limb that is being written. The seam of a limb is the angle where the texture begins: the vertices
/// there are doubled.
struct LimbWriter {
  LimbWriter(const GraftInput& input, BarkBuffers& bark) : in(input), out(bark) {}

  const GraftInput& in;
  BarkBuffers& out;
  LimbAxis axis;
  RingPlan plan;
  LoopAngles angles;
  RingCorners below;                     ///< the last ring, where the next strip begins
  RingCorners lower, upper;              ///< the new ring, as the strips below and above it see it
  bool below_has_loop = false;           ///< the last ring has vertices on loops
  std::size_t near_piece = 0;            ///< piece of the axis near the new ring
  std::uint32_t joint = Limbs::none;     ///< joint that new vertices move with
  glm::vec3 along{0, 1, 0}, on_axis{0};  ///< the limb's direction and centre at new vertices
  float seam = 0;
  glm::vec2 seam_turn{1, 0};            ///< cosine and sine of the seam
  int least_sides = 3, loop_sides = 0;  ///< loop_sides: corners of the loop that the limb begins with
  float turns = 0;                      ///< u for each radian where the texture wraps; 0: u is in metres
  // Scratch memory that is kept from ring to ring.
  std::vector<LoopVertex> loop_order;
  std::vector<OpenCorner> open_corners;
  RingCorners lower_order, upper_order;  ///< orders of open_corners
  std::vector<glm::vec3> ring_position, ring_normal;
  std::vector<glm::vec4> ring_tangent;
};

/// True where the limb has ribs: limbs of order 0 with GraftOptions::lobes.
inline bool has_ribs(const LimbWriter& w) { return w.axis.order == 0 && w.in.options.lobes != 0; }

/// Return the plane at the length `at` of a piece, and the plane of a planned ring. A ring at a bend halves the
/// angle.
RingPlane plane_at(const LimbAxis& axis, float at, std::size_t piece);
RingPlane plane_of(const LimbAxis& axis, const PlannedRing& ring);

/// Returns the number of corners of a ring of this radius. It follows from the radius, the ribs and the side limbs.
/// The number of the loop that the limb begins with is kept until the two differ by more than 1.
int sides_for(const LimbWriter& w, float radius);

void set_seam(LimbWriter& w, float angle);

/// Sets the joint that new vertices move with: that of the internode at the length `at`.
void set_joint(LimbWriter& w, float at);

/// Returns the texture coordinates of a vertex: u around the limb, v along it.
glm::vec2 texture_at(const LimbWriter& w, float radius, float angle, float at);

/// Adds one vertex; -0 becomes 0. Its tangent, if there are tangents, goes around the limb. `group`: Limbs::none for
/// vertices that are on no loop.
std::uint32_t add_vertex(LimbWriter& w, const glm::vec3& position, const glm::vec3& normal, glm::vec2 uv,
                         std::uint32_t group);

/// Writes a ring without junctions. `out` gets its corners by rising angle from the seam, the first one again
/// at the end as a vertex of its own.
void write_plain_ring(LimbWriter& w, const RingPlane& plane, RingCorners& out);

/// Writes a ring with junctions: w.lower gets the corners below the ring, w.upper those above it. Makes the
/// loops of the children.
void write_open_ring(LimbWriter& w, const RingPlane& plane, const PlannedRing& ring);

}  // namespace seedmesh
