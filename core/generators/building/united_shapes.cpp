#include "core/generators/building/united_shapes.h"

#include "core/generators/building/boolean.h"
#include "core/generators/building/solid_tools.h"
#include "core/generators/building/tags.h"

namespace seedmesh::building {
namespace {

/// The geometry of a leaf in metres of the scope of `state`; empty for edges, points and assets.
Solid in_scope(Derivation& d, std::uint32_t offset, const ShapeState& state, const Shape& leaf) {
  if (leaf.has_asset()) {
    warn(d, offset, "inserted parts and assets cannot become a part of one shape, and are left out");
    return {};
  }
  if (dimension(leaf.size) < 2) return {};
  Solid solid = solid_of(d, leaf);
  if (leaf.geometry == box_geometry && dimension(leaf.size) == 3) solid.is_closed = true;
  const glm::dmat3 back = glm::transpose(d.out.axes[state.axes]);
  for (glm::dvec3& p : solid.points)
    p = back * (leaf.origin + d.out.axes[leaf.axes] * (p * leaf.size) - state.origin);
  const std::uint32_t tags = d.out.styles[leaf.style].tags;
  for (Face& face : solid.faces) face.tags = joined_tags(d, face.tags, tags);
  return solid;
}

}  // namespace

Solid united_solid(Derivation& d, std::uint32_t offset, const ShapeState& state,
                   std::span<const Shape> leaves, Joining joining) {
  Solid all, open;
  all.is_closed = true;
  for (const Shape& leaf : leaves) {
    Solid own = in_scope(d, offset, state, leaf);
    if (own.faces.empty()) continue;
    if (joining == Joining::unify && own.is_closed) {
      if (all.faces.size() + own.faces.size() > most_faces)
        reject(d, offset, "the Boolean operation has more than 20,000 faces");
      if (all.faces.empty()) {
        append(all, own);
      } else {
        all = boolean(all, own, BooleanKind::unite, d.job);
      }
    } else if (joining == Joining::unify) {
      append(open, own);
    } else {
      all.is_closed &= own.is_closed;
      append(all, own);
    }
  }
  if (!open.faces.empty()) {
    all.is_closed = false;
    append(all, open);
  }
  if (joining == Joining::recompose) {
    all = welded(all, 1e-6);
    all.is_closed = is_watertight(all);
  }
  if (all.faces.empty()) all.is_closed = false;
  return all;
}

}  // namespace seedmesh::building
