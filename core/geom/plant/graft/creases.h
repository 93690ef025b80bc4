#pragma once
/// Creases: faces with vertices of their own, at corners where no single normal makes an acute angle with all
/// adjacent faces.
#include <vector>

#include "core/geom/plant/graft/bark_buffers.h"
#include "core/geom/plant/graft/graft_input.h"

namespace seedmesh {

/// A triangle that gets vertices of its own. `triangle`, `first` and `last` are triangle indices in the
/// joined bark; the limb has the triangles `first` to `last - 1`.
struct Crease {
  std::uint32_t triangle = 0, first = 0, last = 0;
};

/// Returns whether a face that points away from its normals may get a crease. Faces between limbs that meet at a
/// narrow angle may. A face that is folded over to the other side of its limb or junction may get one only if it is
/// invisibly small.
bool can_be_creased(const GraftInput& in, const BarkBuffers& bark, std::uint32_t triangle, std::size_t limb);

/// Returns the creased triangles, by their numbers in the buffers, that still belong to a limb.
std::vector<Crease> remaining_creases(const BarkBuffers& bark, std::vector<std::uint32_t> creased);

/// Gives each creased triangle a vertex of its own, with the normal of the face, at each corner whose normal
/// it faces away from. Adjacent triangles with about the same normal share it.
void write_creases(const std::vector<Crease>& creases, JoinedBark& bark);

}  // namespace seedmesh
