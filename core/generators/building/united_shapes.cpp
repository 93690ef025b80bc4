#include "core/generators/building/united_shapes.h"

#include <cmath>
#include <map>

#include "core/base/math.h"

#include "core/generators/building/boolean.h"
#include "core/generators/building/solid_tools.h"
#include "core/generators/building/tags.h"

namespace seedmesh::building {
namespace {

/// The geometry of a leaf in metres of the scope of `state`; empty for edges, points and assets.
Solid in_scope(Derivation& d, std::uint32_t offset, const ShapeState& state, const Shape& leaf) {
  if (leaf.has_asset()) {
    warn(d, offset, "inserted parts and assets cannot be joined with other shapes and are left out");
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

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

template <class Body>
void each_edge(const Solid& solid, const Face& face, const Body& body) {
  for (const Loop& loop : loops_of(solid, face)) {
    const std::span<const std::uint32_t> points = points_of(solid, loop);
    for (std::size_t i = 0; i < points.size(); ++i)
      body(DirectedEdge{points[i], points[(i + 1) % points.size()]});
  }
}

/// Drops faces inside a solid: all their edges have two other faces that fit together, as the underside of an
/// extrusion of one face has.
void drop_inner_faces(Solid& solid) {
  std::map<DirectedEdge, int> uses;
  for (const Face& face : solid.faces) each_edge(solid, face, [&](const DirectedEdge& e) { ++uses[e]; });
  std::erase_if(solid.faces, [&](const Face& face) {
    bool is_inner = true;
    each_edge(solid, face, [&](const DirectedEdge& e) {
      const auto back = uses.find({e.second, e.first});
      is_inner &= back != uses.end() && back->second > 0 && uses[e] > back->second;
    });
    if (is_inner) each_edge(solid, face, [&](const DirectedEdge& e) { --uses[e]; });
    return is_inner;
  });
}

}  // namespace

Solid recomposed(const Solid& pieces, const Job& job) {
  constexpr double near = 1e-6;
  Solid all = with_shared_corners(welded(pieces, near), near, job);
  drop_inner_faces(all);
  all = welded(all, 0);  // without the loops of the dropped faces
  all.is_closed = is_watertight(all);
  return all;
}

std::optional<Solid> flat_boolean(const Solid& a, const Solid& b, BooleanKind kind, const Job& job) {
  if (a.faces.empty() || b.faces.empty() || a.is_closed || b.is_closed) return std::nullopt;
  if (a.faces.size() + b.faces.size() > most_faces) return std::nullopt;
  constexpr double near = 1e-6;
  const glm::dvec3 normal = math::unit(area_vector(a, a.faces[0], glm::dvec3(1)), glm::dvec3(0, 1, 0));
  const double height = glm::dot(normal, a.points[a.corners[a.loops[a.faces[0].first_loop].first]]);
  Solid operands[2] = {a, b};
  for (Solid& operand : operands) {
    const double side =
        glm::dot(normal, area_vector(operand, operand.faces[0], glm::dvec3(1))) < 0 ? -1.0 : 1.0;
    for (const Face& face : operand.faces) {
      const glm::dvec3 own = math::unit(area_vector(operand, face, glm::dvec3(1)), glm::dvec3(0));
      if (glm::dot(own, normal) * side < 1 - near) return std::nullopt;
      for (const std::uint32_t point : points_of(operand, operand.loops[face.first_loop])) {
        if (std::abs(glm::dot(normal, operand.points[point]) - height) > near) return std::nullopt;
      }
    }
    // Both become prisms of one height on the same side, and the upper faces of the result are flat again.
    operand = welded(operand, near);
    operand = extruded_by(operand, std::vector<glm::dvec3>(operand.points.size(), normal * side));
    if (side < 0) {
      for (glm::dvec3& p : operand.points) p += normal;
    }
    if (!operand.is_closed) return std::nullopt;
  }
  Solid made = boolean(operands[0], operands[1], kind, job);
  std::erase_if(made.faces, [&](const Face& face) {
    return glm::dot(math::unit(area_vector(made, face, glm::dvec3(1)), glm::dvec3(0)), normal) < 1 - near;
  });
  for (glm::dvec3& p : made.points) p -= normal;
  made = without_straight_corners(with_joined_faces(welded(made, near), near), near);
  made.is_closed = false;
  return made;
}

Solid united_solid(Derivation& d, std::uint32_t offset, const ShapeState& state,
                   std::span<const Shape> leaves, UnionMode joining) {
  Solid all, open;
  all.is_closed = true;
  for (const Shape& leaf : leaves) {
    Solid own = in_scope(d, offset, state, leaf);
    if (own.faces.empty()) continue;
    if (joining == UnionMode::unify && own.is_closed) {
      if (all.faces.size() + own.faces.size() > most_faces)
        reject(d, offset, "the Boolean operation has more than 20,000 faces");
      if (all.faces.empty()) {
        append(all, own);
      } else {
        all = boolean(all, own, BooleanKind::unite, d.job);
      }
    } else if (joining == UnionMode::unify) {
      if (std::optional<Solid> flat = flat_boolean(open, own, BooleanKind::unite, d.job)) {
        open = std::move(*flat);
      } else {
        append(open, own);
      }
    } else {
      all.is_closed &= own.is_closed;
      append(all, own);
    }
  }
  if (!open.faces.empty()) {
    all.is_closed = false;
    append(all, open);
  }
  if (joining == UnionMode::recompose) all = recomposed(all, d.job);
  if (all.faces.empty()) all.is_closed = false;
  return all;
}

}  // namespace seedmesh::building
