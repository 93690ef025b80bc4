#pragma once
/// One solid of several shapes.
#include <optional>
#include <span>

#include "core/generators/building/boolean.h"
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

constexpr std::size_t most_faces = 20'000;  ///< of a Boolean operation

enum class Joining : std::uint8_t {
  append,     ///< all faces, as they are
  unify,      ///< the union of closed solids, and all faces of others
  recompose,  ///< all faces, with shared corners
};

/// Joins pieces of a surface where they meet: corners within a micrometre become one, and corners on an edge of
/// another piece divide it. Faces that become inner ones are dropped.
Solid recomposed(const Solid& pieces, const Job& job);

/// Union, difference or intersection of two flat surfaces in one plane, with the normal of the first; nothing if they are
/// not in one plane.
std::optional<Solid> flat_boolean(const Solid& a, const Solid& b, BooleanKind kind, const Job& job);

/// Returns the geometry of these shapes in metres of the scope of `state`. Edges and points are left out, assets with
/// a warning at byte `offset` of the rules. Rejects more than most_faces. Without geometry it has no faces.
Solid united_solid(Derivation& d, std::uint32_t offset, const ShapeState& state,
                   std::span<const Shape> shapes, Joining joining);

}  // namespace seedmesh::building
