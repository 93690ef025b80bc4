#pragma once
/// Limbs -> Mesh: tubes that follow limbs.
#include <cstdint>
#include <span>
#include <vector>

#include "core/geom/contour.h"
#include "core/geom/limbs.h"
#include "core/model/mesh.h"

namespace seedmesh {

/// The corners that all rings of a limb have.
struct LimbCorners {
  std::uint8_t now = 3;     ///< at this level of detail
  std::uint8_t finest = 3;  ///< and at the finest one
};

struct SkinOptions {
  int sides = 8;   ///< corners of a cross-section of the thickest limb, 3..64
  int stacks = 1;  ///< rings an internode is cut into, 1..16; only where the radius changes along it
  bool uv = true;
  std::span<const std::uint16_t> bones = {};  ///< of each joint: what moves its internode; fills Mesh::bone
  /// For pictures that repeat: u goes a whole number of times from 0 to 1 round each limb, once a metre of
  /// circumference where it begins and at least once, and v keeps the picture's proportions as the limb grows
  /// thinner.
  bool wrap = false;
  /// Fewer sides for limbs that begin thinner than the thickest (by the root of the ratio), fewer rings for
  /// internodes shorter than a tenth of the model.
  bool adapt = false;
  /// What Limbs::contour counts from 1. They follow the turtle's frame (Limbs::frame), by which a limb may
  /// twist 45 degrees an internode and as much as it is long for its radius; sides are never fewer than
  /// points.
  std::span<const Contour> contours = {};
  /// For coarser levels of detail: of each joint that begins a limb (Chains::head), its corners, at most
  /// `sides`. Where not empty, `adapt` decides about rings alone; a limb has no ring where it goes straight
  /// on, and one of fewer corners than at the finest level has its rings turned by half a side, each against
  /// the one before: half way between them it is as wide from all sides as if it had twice the corners.
  std::span<const LimbCorners> corners = {};
};

/// The fewest corners that a limb may have.
int least_sides_of(const SkinOptions& options);

/// Sides of a limb that begins with `radius`, the thickest of the model beginning with `most`.
int sides_of_limb(const SkinOptions& options, float radius, float most);

/// The bark of one colour index, as one mesh.
struct Bark {
  std::int16_t color = 0;
  Mesh mesh;
  int layer =
      0;  ///< of polygons() only: barks of different layers must not be joined into one mesh of the answer
};

/// Skins every limb as one closed tube: rings are mitred at joints and turn without twist along the limb,
/// both ends are closed, u runs round the limb and v along it, both in metres, with one doubled seam.
/// Triangles are counter- clockwise outside and come in cache order (at most 1.2 misses a vertex with 16
/// entries, first in first out).
///
/// What is decided here:
/// - Where two internodes of a limb meet, the ring has the base radius of the later one: every internode
/// begins as thick as it
///   was drawn and tapers to the next. Where the later one begins in a point, both are closed.
/// - A root begins with a flat floor; a side branch with a cone that lies inside its parent; a free tip ends
/// in a cone within
///   the drawn length; an end that branches grow from, or a bend, in a cone that stands out by half the
///   radius.
/// - A bend is mitred up to 120 degrees, unless the rings at both ends of an internode would then cross on
/// its inner side or a
///   face would look against a normal; else the limb is closed and a new tube starts.
/// - Internodes of no length (a hundred-thousandth of the model's diagonal) or no radius (too thin to be told
/// from a line when
///   vertices are welded at a millionth of the diagonal) are passed over. An internode that lies exactly on
///   another (same ends in either order, same radii) is skinned once; what grows from it grows from the
///   first.
/// - A limb that changes its colour goes on in the other mesh with the same ring: joined, the meshes are
/// closed.
/// - Rings that would lie on top of others' are moved apart by a few hundredths of the radius, by the hash of
/// the joint's key.
///
/// Guarantees: unit normals, no unused vertex, no triangle of zero area, no NaN, no -0; welded at a millionth
/// of the diagonal, every edge is in two triangles that agree on the outside. In: limbs with finite positions
/// and radii >= 0. Out: one Bark for each colour index in use, rising. Spends Resource::triangles before it
/// allocates. Runs on job.threads(); the result does not depend on it.
std::vector<Bark> skin(const Limbs& limbs, const SkinOptions& options, Job& job);

/// How many internodes skin() passes over because they are too thin for the size of the whole.
std::uint64_t too_thin(const Limbs& limbs, int sides);

/// The same skeleton as line segments (two vertices a segment, shared along limbs), one mesh for each colour
/// index. Joints at one place share a vertex, except in models of more than 131,072 joints where next to none
/// do and of more than 1,048,576. Limbs that are given away lend their memory to the mesh.
std::vector<Bark> wires(const Limbs& limbs, Job& job);
std::vector<Bark> wires(Limbs&& limbs, Job& job);

/// Are internodes that lie on others looked for where triangles are counted? That takes ten times as long.
enum class Redrawn { counted, found };

/// How many triangles `skin` would make, without making them; exact but for internodes drawn twice, where
/// these are counted.
std::uint64_t skin_triangles(const Limbs& limbs, const SkinOptions& options,
                             Redrawn repeats = Redrawn::counted);

}  // namespace seedmesh
