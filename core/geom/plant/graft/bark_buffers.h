#pragma once
/// The arrays that welded bark is written to: vertices, triangles, loops, and which limb owns what.
///
/// A vertex on a loop belongs to a group. At one point of a loop, the parent's vertices have the group 2n and the
/// child's vertices the group 2n + 1. In the end, both share the normal of group 2n.
#include <span>
#include <utility>
#include <vector>

#include "core/geom/mesh/vec3x4.h"
#include "core/geom/plant/graft/graft.h"

namespace seedmesh {

/// A point of a loop as the child needs it.
struct LoopVertex {
  glm::vec3 position{0};
  float angle = 0, reach = 0;  ///< LoopPoint::phase and ::reach
  std::uint32_t group = Limbs::none;
  std::uint32_t joint = Limbs::none;  ///< joint of the parent; the rim moves with it
};

/// The loop that a limb begins with: elements of BarkBuffers::loop_vertices.
struct Loop {
  std::uint32_t first = Limbs::none, count = 0;
  /// `radius` is that of the child at the loop. `reach` is that of the point of the loop farthest along the child.
  float radius = 0, reach = 0;
  glm::vec3 u{0};  ///< the direction of angle 0 at the child
  bool is_fork = false;
};

/// The normal of a group, or the sum that it is computed from, in the first three lanes.
struct GroupNormal {
  Float4 row{};
  glm::vec3 get() const { return {row[0], row[1], row[2]}; }
  void set(const glm::vec3& normal) { row = spread_out(normal); }
};

/// The sizes of the buffers at one moment.
struct BarkSizes {
  std::uint32_t vertex = 0, triangle = 0, group = 0;
  std::uint32_t loop_triangle = 0;
  std::uint32_t corners = 0, wide_corners = 0;
};

/// What one limb has written; `first_end`: the end of the triangles at the loop that it begins with.
struct LimbRange {
  BarkSizes begin, end;
  std::uint32_t first_end = 0;
};

/// How a limb begins.
enum class LimbStart : std::uint8_t { none, root, collar, fork, closed };

/// The first and last vertex of a ring with ribs, which have the same position.
using RibSeam = std::pair<std::uint32_t, std::uint32_t>;

struct BarkBuffers {
  BarkBuffers(const GraftOptions& options, std::size_t limbs, std::size_t joints_expected, Job& job);

  bool has_tangents, has_joints, has_colors;
  float v_scale;
  Mesh mesh;  ///< its arrays have more capacity than `vertices`, so that four floats can be read anywhere
  std::size_t vertices = 0;               ///< written so far
  Array<std::uint32_t> group;             ///< group of each vertex, or Limbs::none
  Array<std::uint8_t> twin;               ///< 1 for each vertex whose position an earlier vertex has
  Array<std::uint32_t> joints;            ///< joint of each vertex, as GraftOptions::joints
  Array<std::int16_t> colors;             ///< colour of each triangle, as GraftOptions::colors
  Array<std::uint32_t> loop_triangles;    ///< triangles with a vertex on a loop, rising
  Array<GroupNormal> group_normal;        ///< normal of each group
  std::vector<std::uint32_t> group_limb;  ///< child limb of each pair of groups
  std::vector<Loop> loops;                ///< loop of each limb
  Array<LoopVertex> loop_vertices;
  std::vector<RibSeam> rib_seams;  ///< rising
  std::vector<LimbRange> range;    ///< range of each limb
  std::vector<LimbStart> start;    ///< start of each limb
  std::size_t corners = 0;         ///< vertices on rings
  /// Number of corners on rings of more corners than a small vertex cache holds.
  std::size_t wide_corners = 0;
  Meter triangles;              ///< spends triangles of the request
  bool is_part = false;         ///< one of several buffers that are joined later and spent then
  std::uint64_t uncharged = 0;  ///< triangles of a part

  const std::uint32_t* corners_of(std::uint32_t triangle) const {
    return mesh.index.wide.data() + std::size_t{3} * triangle;
  }
};

/// Returns the present sizes of the buffers.
BarkSizes sizes_of(const BarkBuffers& bark);

/// Returns the sum of one size over all limbs.
std::uint32_t sum_of(std::span<const LimbRange> ranges, std::uint32_t BarkSizes::*size);

/// Sets the capacity for vertices; new elements are not initialised.
void resize_vertices(BarkBuffers& bark, std::size_t vertices);

/// Provides capacity for `count` more vertices and for the vertices that blocks of four write beyond them.
inline void reserve_vertices(BarkBuffers& bark, std::size_t count) {
  if (bark.vertices + count + Vec3x4::size > bark.mesh.position.size())
    resize_vertices(bark, bark.vertices + bark.vertices / 2 + count + 64);
}

/// Spends `count` triangles and returns where their 3 * `count` corners go.
std::uint32_t* add_triangles(BarkBuffers& bark, std::size_t count);

/// Adds the triangles from number `first` on that have a vertex on a loop to the list of loop triangles.
void note_loop_triangles(BarkBuffers& bark, std::size_t first);

/// Projects the tangent of a vertex to the plane at right angles to its normal. If nothing is left of it, it gets
/// any direction in that plane.
void level_tangent(Mesh& mesh, std::size_t vertex);

/// The bark of all limbs in the order of limbs, without the remains of earlier rounds.
struct JoinedBark {
  Mesh mesh;
  Array<std::uint32_t> joints;
  Array<std::uint8_t> twin;
  Array<std::int16_t> colors;
};
/// Moves the bark out of the buffers. Uses all threads of the job. `spare_triangles`: capacity to leave for
/// triangles that get vertices of their own.
JoinedBark take_bark(BarkBuffers& bark, std::size_t spare_triangles, const Job& job);

}  // namespace seedmesh
