#pragma once
/// Limbs to meshes: one closed tube for each limb.
#include <cstdint>
#include <span>
#include <vector>

#include "core/geom/plant/contour.h"
#include "core/geom/plant/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// The number of corners of all rings of a limb.
struct LimbCorners {
  std::uint8_t current = 3;  ///< number of corners at this level of detail
  std::uint8_t finest = 3;   ///< number of corners at the finest level
};

struct SkinOptions {
  int sides = 8;   ///< corners of a cross-section of the thickest limb, 3..64
  int stacks = 1;  ///< pieces that an internode is cut into, 1..16
  /// Whether internodes whose radius does not change are also cut into these pieces.
  bool cuts_all = false;
  bool uv = true;
  /// Bone that moves the internode of each joint; fills Mesh::bone.
  std::span<const std::uint16_t> bones = {};
  /// For textures that repeat. u goes a whole number of times from 0 to 1 around each limb: once for each
  /// metre of its first circumference, at least once. v keeps the proportions of the texture as the limb
  /// becomes thinner.
  bool wrap = false;
  /// With `wrap`, below 1 for textures whose strips from 0 to each power of two down to this one also repeat. Around
  /// thin limbs, u goes from 0 to such a power; around thick limbs, it has strips_a_metre repetitions a metre.
  /// Towards the tip of a limb, the texture then shrinks less along the limb than around it.
  float least_repeats = 1;
  /// Whether limbs that begin thinner than the thickest one have fewer sides, in proportion to the root of their
  /// radius. Internodes shorter than a tenth of the model then have fewer rings.
  bool adapt = false;
  /// The cross-sections that Limbs::contour counts from 1. They follow the turtle's frame (Limbs::frame). A
  /// limb twists by at most 45 degrees an internode, and by at most its length divided by its radius. There
  /// are never fewer sides than points.
  std::span<const Contour> contours = {};
  /// For coarser levels of detail: the corners of the limb that begins with each joint (Chains::head), at
  /// most `sides`. Where not empty:
  /// - `adapt` applies to rings only;
  /// - a limb has no ring where it goes straight on;
  /// - where a limb has fewer corners than at the finest level, each ring is turned by half a side against
  ///   the ring before it. Half way between two rings the limb is then as wide from all sides as with twice
  ///   as many corners.
  std::span<const LimbCorners> corners = {};
};

/// Returns the least number of sides that a limb may have.
int least_sides_of(const SkinOptions& options);

/// Returns the sides of a limb with the first radius `radius`, where `most` is the largest first radius of the model.
int sides_of_limb(const SkinOptions& options, float radius, float most);

/// The bark of one colour index, as one mesh.
struct Bark {
  std::int16_t color = 0;
  Mesh mesh;
  int layer = 0;  ///< polygons() only: meshes of different layers must not be merged
};

/// Makes every limb a closed tube. Rings are mitred at joints and follow a frame of least rotation. Both ends
/// are closed. u runs around the limb and v along it, in metres, with one doubled seam. Triangles are
/// counter-clockwise seen from outside, in an order with at most 1.2 misses a vertex in a first-in-first-out
/// cache of 16 entries.
///
/// Rules:
/// - Radii. Where two internodes meet, the ring has the first radius of the later one. Where the later one
///   begins in a point, both are closed.
/// - Ends. A root begins with a flat floor, a side branch with a cone inside its parent. A free tip ends in a
///   cone within the drawn length. An end with branches, or at a bend that is not mitred, ends in a cone of
///   half the radius beyond the drawn length.
/// - Bends. A bend is mitred up to 120 degrees. At a larger bend the tube is closed and a new one begins. The same
///   happens if a face would face away from a normal. It also happens if the rings at both ends of an internode would
///   cross on its inner side.
/// - Small internodes. An internode is left out if its length is below 1e-5 of the model's diagonal. It is also
///   left out if its corners would be welded at 1e-6 of the diagonal.
/// - Repeated internodes. Of internodes that coincide (same ends in either order, same radii) the first is
///   written. What grows from a later one grows from the first.
/// - Colours. A limb that changes its colour continues in the other mesh with the same ring; together the
///   meshes are closed.
/// - Coincident rings are moved apart by a few hundredths of the radius, by a hash of the joint's key.
///
/// Guarantees: unit normals; no unused vertex, no triangle of zero area, no NaN, no -0. After welding at 1e-6
/// of the diagonal every edge belongs to two triangles that agree on the outside.
///
/// Needs finite positions and radii >= 0. Returns one Bark for each colour index in use, by rising index.
/// Spends Resource::triangles before it allocates. Runs on job.threads(); the result does not depend on
/// their number.
std::vector<Bark> skin(const Limbs& limbs, const SkinOptions& options, Job& job);

/// Returns the number of internodes that skin() leaves out because they are too thin for the size of the model.
std::uint64_t too_thin(const Limbs& limbs, int sides);

/// Returns the skeleton as line segments, two vertices a segment and shared along limbs; one mesh for each colour
/// index. Joints at one position share a vertex, unless the model has more than 131,072 joints and hardly any
/// coincide, or has more than 1,048,576. The second form reuses the memory of the limbs.
std::vector<Bark> wires(const Limbs& limbs, Job& job);
std::vector<Bark> wires(Limbs&& limbs, Job& job);

/// How a count treats repeated internodes: it counts them twice, or finds them, which takes ten times as long.
enum class RepeatMode { counted, found };

struct TubeCount {
  std::uint64_t vertices = 0, triangles = 0;
};

/// Returns the size of all that skin() would write; exact, except for repeated internodes. Spends nothing of the
/// job, but stops with it.
TubeCount skin_count(const Limbs& limbs, const SkinOptions& options, const Job& job,
                     RepeatMode repeats = RepeatMode::counted);

}  // namespace seedmesh
