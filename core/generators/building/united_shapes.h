#pragma once
/// One solid of several shapes.
#include <optional>
#include <span>

#include "core/generators/building/boolean.h"
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

constexpr std::size_t most_faces = 20'000;  ///< greatest number of faces of a Boolean operation

enum class UnionMode : std::uint8_t {
  append,     ///< all faces, as they are
  unify,      ///< the union of closed solids, and all faces of others
  recompose,  ///< all faces, with shared corners
};

/// Returns the surface of pieces, joined where they meet. Corners within a micrometre become one, and corners on
/// an edge of another piece divide that edge. Faces that become inner ones are removed.
Solid recomposed(const Solid& pieces, const Job& job);

/// Returns the union, difference or intersection of two flat surfaces in one plane, with the normal of the first;
/// nullopt if they are not in one plane.
std::optional<Solid> flat_boolean(const Solid& a, const Solid& b, BooleanKind kind, const Job& job);

/// Returns the geometry of these shapes in metres of the scope of `state`. Edges and points are left out; assets
/// are left out with a warning at byte `offset` of the rules. Rejects more than most_faces faces. The result has
/// no faces if the shapes have no geometry.
Solid united_solid(Derivation& d, std::uint32_t offset, const ShapeState& state,
                   std::span<const Shape> shapes, UnionMode joining);

}  // namespace seedmesh::building
