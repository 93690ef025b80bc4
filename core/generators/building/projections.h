#pragma once
/// Texture coordinates of flat shapes as projections, by sets 0 to 9. Only set 0 is drawn.
#include <array>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// Returns the projection of a set that was applied (projectUV), or else the one that was set up. If the set has
/// neither, u and v are metres along the scope from one of its corners: u along x, and v along y. On a lot, v is along
/// -z. On a face without extent along x, u is along -z.
Projection projection_of(const Derivation& d, const ShapeState& state, int set);
/// Whether a set has a projection, so that it means the same for all faces of a solid.
bool has_projection(const Derivation& d, const ShapeState& state, int set);
/// Applies a projection.
void use_projection(Derivation& d, ShapeState& state, int set, const Projection& projection);

/// Returns the number of the projection that a set has set up or applied; 0: none.
std::uint32_t projection_id(const Derivation& d, const ShapeState& state, int set, bool is_applied);
void set_projection_id(Derivation& d, ShapeState& state, int set, bool is_applied, std::uint32_t id);
/// Stores a projection and returns its number.
std::uint32_t add_projection(Derivation& d, const Projection& projection);

/// The range of u and v over a shape, and the metres along the surface for a change of u or v by 1.
struct UvRange {
  std::array<double, 2> low{}, high{}, metres{1, 1};
};
/// Returns the range of texture coordinates of a shape in one set.
UvRange uv_range(const Derivation& d, const ShapeState& state, int set);

}  // namespace seedmesh::building
