/// Faces, edges and vertices as shapes; see components.h.
#include "core/generators/building/components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/generators/building/tags.h"

namespace seedmesh::building {
namespace {

/// A face of a box: the origin of its own scope as a share of the size of the box, its axes, and the axes of
/// the box that give its sizes.
struct Side {
  glm::dvec3 at;
  glm::dmat3 axes;
  int u, v;
};
// Front, right, back, left, top, bottom; x runs counter-clockwise around the box, y up, z out of the face.
const std::array<Side, 6> sides = {{
    {{0, 0, 1}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, 1},
    {{1, 0, 1}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}, 2, 1},
    {{1, 0, 0}, {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, 0, 1},
    {{0, 0, 0}, {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}, 2, 1},
    {{0, 1, 1}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, 0, 2},
    {{0, 0, 0}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, 0, 2},
}};

// Sines of 11.25 and 78.75 degrees, which separate horizontal, sloping and vertical faces.
constexpr double sine_low = 0.19509032201612825, sine_high = 0.98078528040323043;

/// The frame of a face with this normal: x is horizontal, or along the first edge if the face is horizontal.
glm::dmat3 frame_of(const glm::dvec3& normal, const glm::dvec3& first_edge) {
  glm::dvec3 x = glm::cross(glm::dvec3(0, 1, 0), normal);
  if (glm::dot(x, x) < 1e-12) x = first_edge - normal * glm::dot(normal, first_edge);
  x = math::unit(x, glm::dvec3(1, 0, 0));
  return {x, glm::cross(normal, x), normal};
}

/// A direction in the scope that is taken apart. Faces of a roof follow the vertical of the world, whichever axis
/// of the scope that is.
glm::dvec3 normal_in_scope(const Derivation& d, const ShapeState& whole, const glm::dvec3& normal) {
  const glm::dvec3 n = glm::transpose(d.out.axes[whole.axes]) * normal;
  if (whole.roof_up == no_roof) return n;
  const int up = whole.roof_up, u = (up + 1) % 3, v = (up + 2) % 3;
  return up == 1 ? glm::dvec3(n.x, normal.y, n.z) : glm::dvec3(n[u], normal.y, -n[v]);
}

/// The classes of a direction.
std::uint32_t classes_of(const glm::dvec3& n) {
  std::uint32_t classes = face_all;
  const glm::dvec3 a = glm::abs(n);
  if (a.y >= a.x && a.y >= a.z) {
    classes |= n.y > 0 ? face_top : face_bottom;
  } else {
    classes |= face_side;
    if (a.z >= a.x) {
      classes |= n.z > 0 ? face_front : face_back;
    } else {
      classes |= n.x > 0 ? face_right : face_left;
    }
  }
  if (a.y > sine_high) {
    classes |= face_horizontal;
  } else if (n.y > sine_low) {
    classes |= face_aslant;
  } else if (n.y < -sine_low) {
    classes |= face_nutant;
  } else {
    classes |= face_vertical;
  }
  return classes;
}

void add_box_faces(Derivation& d, const ShapeState& state, std::vector<ShapeState>& out) {
  const int flat = dimension(state.size) == 2 ? flat_axis(state.size) : -1;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Side& side = sides[i];
    const int normal = 3 - side.u - side.v;
    if (flat >= 0 && (normal != flat || side.axes[2][normal] < 0)) continue;
    const std::uint64_t key = static_cast<std::uint64_t>(state.axes) << 3U | i;
    const auto [found, is_new] = d.side_axes.try_emplace(key, 0);
    if (is_new) found->second = add_axes(d, d.out.axes[state.axes] * side.axes);
    ShapeState face = state;
    face.axes = found->second;
    face.origin = state.origin + d.out.axes[state.axes] * (side.at * state.size);
    face.size = {state.size[side.u], state.size[side.v], 0};
    out.push_back(face);
  }
}

void add_solid_faces(Derivation& d, const ShapeState& state, std::vector<ShapeState>& out) {
  const Solid& solid = d.out.solid_of(state.geometry);
  for (const Face& each : solid.faces) {
    const glm::dvec3 normal = math::unit(area_vector(solid, each, state.size), glm::dvec3(0, 1, 0));
    const Loop& outer = solid.loops[each.first_loop];
    const glm::dvec3 base = solid.points[solid.corners[outer.first]] * state.size;
    const glm::dvec3 edge = solid.points[solid.corners[outer.first + 1]] * state.size - base;
    const glm::dmat3 frame = frame_of(normal, edge);
    Solid face;
    for (const Loop& loop : loops_of(solid, each)) {
      face.loops.push_back({static_cast<std::uint32_t>(face.corners.size()), loop.count});
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        face.corners.push_back(static_cast<std::uint32_t>(face.points.size()));
        glm::dvec3 p =
            glm::transpose(frame) * (solid.points[solid.corners[loop.first + i]] * state.size - base);
        p.z = 0;
        face.points.push_back(p);
      }
    }
    face.faces.push_back({0, each.loop_count, false});
    glm::dvec3 low, extent;
    fit(face, low, extent);
    if (extent.x == 0 || extent.y == 0) continue;
    ShapeState made = state;
    made.roof_up = no_roof;
    made.origin = state.origin + d.out.axes[state.axes] * (base + frame * low);
    made.axes = add_axes(d, d.out.axes[state.axes] * frame);
    made.size = {extent.x, extent.y, 0};
    const bool is_rectangle =
        face.points.size() == 4 && std::ranges::all_of(face.points, [](const glm::dvec3& p) {
          return (p.x < 1e-9 || p.x > 1 - 1e-9) && (p.y < 1e-9 || p.y > 1 - 1e-9);
        });
    made.geometry = is_rectangle ? box_geometry : add_solid(d, std::move(face));
    made.tag = each.tag;
    if (each.tags != 0) {
      Style style = d.out.styles[state.style];
      style.tags = joined_tags(d, style.tags, each.tags);
      made.style = style_with(d, style);
    }
    out.push_back(made);
  }
}

/// An undirected edge with the faces on both sides.
struct SharedEdge {
  std::uint32_t from = 0, to = 0;  ///< as the first face runs along it
  std::vector<std::uint32_t> faces;
};

std::vector<SharedEdge> edges_of(const Solid& solid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> places;
  std::vector<SharedEdge> edges;
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t a = solid.corners[loop.first + i],
                            b = solid.corners[loop.first + (i + 1) % loop.count];
        const auto [found, is_new] = places.try_emplace({std::min(a, b), std::max(a, b)}, edges.size());
        if (is_new) edges.push_back({a, b, {}});
        edges[found->second].faces.push_back(f);
      }
    }
  }
  return edges;
}

/// The normals of all faces, and a point of each, in the scope.
struct Facets {
  std::vector<glm::dvec3> normal;
  explicit Facets(const Solid& solid, const glm::dvec3& size) {
    for (const Face& face : solid.faces)
      normal.push_back(math::unit(area_vector(solid, face, size), glm::dvec3(0, 1, 0)));
  }
};

/// eave, hip, valley or ridge. `up` is the vertical in the scope. Where a roof has a cover, the edges of
/// its body do not count.
std::vector<std::uint32_t> roof_classes(const Solid& solid, const glm::dvec3& size,
                                        const std::vector<SharedEdge>& edges, const Facets& facets,
                                        const glm::dvec3& up) {
  std::vector<std::uint32_t> out(edges.size(), 0);
  std::vector<std::uint8_t> at_eave(solid.points.size(), 0);
  const auto is_slope = [&](std::uint32_t face) {
    return solid.faces[face].tag != face_is_covered && glm::dot(facets.normal[face], up) > sine_low;
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const glm::dvec3 along = (solid.points[edges[e].to] - solid.points[edges[e].from]) * size;
    if (std::abs(glm::dot(math::unit(along, up), up)) > sine_low) continue;
    if (std::ranges::count_if(edges[e].faces, is_slope) != 1) continue;
    // The slope rises away from its eave.
    const std::uint32_t face = *std::ranges::find_if(edges[e].faces, is_slope);
    glm::dvec3 middle(0);
    double corners = 0;
    for (const std::uint32_t point : points_of(solid, solid.loops[solid.faces[face].first_loop])) {
      middle += solid.points[point] * size;
      ++corners;
    }
    if (glm::dot(middle / corners - solid.points[edges[e].from] * size, up) <= 0) continue;
    out[e] = edge_eave;
    at_eave[edges[e].from] = at_eave[edges[e].to] = 1;
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (out[e] != 0 || edges[e].faces.size() != 2 || !std::ranges::all_of(edges[e].faces, is_slope)) continue;
    // Concave if the second face lies above the plane of the first: the edge runs along the first face.
    const glm::dvec3 along = (solid.points[edges[e].to] - solid.points[edges[e].from]) * size;
    const glm::dvec3 a = facets.normal[edges[e].faces[0]], b = facets.normal[edges[e].faces[1]];
    if (glm::dot(glm::cross(a, b), along) < -1e-9 * glm::length(along)) {
      out[e] = edge_valley;
    } else {
      out[e] = at_eave[edges[e].from] != 0 || at_eave[edges[e].to] != 0 ? edge_hip : edge_ridge;
    }
  }
  return out;
}

Solid solid_or_box(const Derivation& d, const ShapeState& state) {
  if (state.geometry != box_geometry) return d.out.solid_of(state.geometry);
  return dimension(state.size) == 3 ? unit_box() : d.squares[static_cast<std::size_t>(flat_axis(state.size))];
}

/// A straight component from a to b (or a point, if they are equal) with its z axis.
ShapeState straight(Derivation& d, const ShapeState& state, const glm::dvec3& a, const glm::dvec3& b,
                    const glm::dvec3& z) {
  glm::dmat3 frame = frame_of(z, glm::dvec3(1, 0, 0));
  if (a != b) {
    const glm::dvec3 x = math::unit(b - a, glm::dvec3(1, 0, 0));
    const glm::dvec3 up = math::unit(z - x * glm::dot(x, z), frame[1]);
    frame = {x, glm::cross(up, x), up};
  }
  ShapeState made = state;
  made.geometry = box_geometry;
  made.roof_up = no_roof;
  made.tag = 0;
  made.origin = state.origin + d.out.axes[state.axes] * a;
  made.axes = add_axes(d, d.out.axes[state.axes] * frame);
  made.size = {glm::length(b - a), 0, 0};
  return made;
}

/// The class of each edge as part of a roof, and whether it is a border.
std::vector<std::uint32_t> edge_classes(const Derivation& d, const ShapeState& state, const Solid& solid,
                                        const std::vector<SharedEdge>& edges, const Facets& facets) {
  const glm::dvec3 up = glm::transpose(d.out.axes[state.axes])[1];
  std::vector<std::uint32_t> out = roof_classes(solid, state.size, edges, facets, up);
  for (std::size_t e = 0; e < edges.size(); ++e)
    out[e] |= edges[e].faces.size() == 1 ? face_border : face_inside;
  return out;
}

/// Each edge once: z is the mean of the normals of its faces.
void add_edges(Derivation& d, const ShapeState& state, std::vector<Component>& out) {
  const Solid solid = solid_or_box(d, state);
  const Facets facets(solid, state.size);
  const std::vector<SharedEdge> edges = edges_of(solid);
  const std::vector<std::uint32_t> classes = edge_classes(d, state, solid, edges, facets);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    glm::dvec3 normal(0);
    for (const std::uint32_t face : edges[e].faces) normal += facets.normal[face];
    Component made;
    made.state = straight(d, state, solid.points[edges[e].from] * state.size,
                          solid.points[edges[e].to] * state.size, math::unit(normal, glm::dvec3(0, 1, 0)));
    made.classes[0] = made.classes[1] = classes[e];
    made.state.style = style_of_edge(d, solid, edges[e].faces, state.style);
    out.push_back(made);
  }
}

/// The edges of each face of their own: z points out of the face, in its plane.
void add_face_edges(Derivation& d, const ShapeState& state, bool are_points, std::vector<Component>& out) {
  const Solid solid = solid_or_box(d, state);
  const Facets facets(solid, state.size);
  const std::vector<SharedEdge> edges = edges_of(solid);
  const std::vector<std::uint32_t> classes = edge_classes(d, state, solid, edges, facets);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> class_of;
  for (std::size_t e = 0; e < edges.size(); ++e)
    class_of[std::minmax(edges[e].from, edges[e].to)] = classes[e];
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t from = solid.corners[loop.first + i],
                            to = solid.corners[loop.first + (i + 1) % loop.count];
        const glm::dvec3 a = solid.points[from] * state.size, b = solid.points[to] * state.size;
        Component made;
        if (!are_points) made.classes[0] = made.classes[1] = class_of[std::minmax(from, to)];
        made.state = are_points ? straight(d, state, a, a, facets.normal[f])
                                : straight(d, state, a, b, glm::cross(b - a, facets.normal[f]));
        out.push_back(made);
      }
    }
  }
}

void add_vertices(Derivation& d, const ShapeState& state, std::vector<Component>& out) {
  const Solid solid = solid_or_box(d, state);
  const Facets facets(solid, state.size);
  std::vector<glm::dvec3> normal(solid.points.size(), glm::dvec3(0));
  std::vector<std::uint32_t> order;
  std::vector<std::uint8_t> is_known(solid.points.size(), 0);
  for (std::size_t f = 0; f < solid.faces.size(); ++f) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (const std::uint32_t point : points_of(solid, loop)) {
        normal[point] += facets.normal[f];
        if (is_known[point]++ == 0) order.push_back(point);
      }
    }
  }
  for (const std::uint32_t point : order) {
    const glm::dvec3 at = solid.points[point] * state.size;
    Component made;
    made.state = straight(d, state, at, at, math::unit(normal[point], glm::dvec3(0, 1, 0)));
    out.push_back(made);
  }
}

/// The holes of flat faces, filled.
void add_holes(Derivation& d, const ShapeState& state, std::vector<ShapeState>& out) {
  if (state.geometry == box_geometry) return;
  const Solid& solid = d.out.solid_of(state.geometry);
  Solid holes;
  holes.points = solid.points;
  for (const Face& face : solid.faces) {
    for (const Loop& loop : loops_of(solid, face).subspan(1)) {
      const std::span<const std::uint32_t> own = points_of(solid, loop);
      add_face(holes, std::vector<std::uint32_t>(own.rbegin(), own.rend()));
    }
  }
  if (holes.faces.empty()) return;
  ShapeState whole = state;
  whole.geometry = add_solid(d, std::move(holes));
  add_solid_faces(d, whole, out);
}

}  // namespace

std::vector<Component> components_of(Derivation& d, const ShapeState& state, std::uint8_t kind) {
  std::vector<Component> out;
  std::vector<ShapeState> faces;
  switch (kind) {
    case component_edges:
      add_edges(d, state, out);
      break;
    case component_vertices:
      add_vertices(d, state, out);
      break;
    case component_face_edges:
    case component_face_vertices:
      add_face_edges(d, state, kind == component_face_vertices, out);
      break;
    case component_groups:
    case component_materials:
      faces.push_back(state);
      break;
    case component_holes:
      add_holes(d, state, faces);
      break;
    default:
      if (state.geometry == box_geometry) {
        add_box_faces(d, state, faces);
      } else {
        add_solid_faces(d, state, faces);
      }
  }
  for (const ShapeState& face : faces) out.push_back({face, {0, 0}});
  const bool is_closed =
      state.geometry == box_geometry ? dimension(state.size) == 3 : d.out.solid_of(state.geometry).is_closed;
  const bool is_whole = kind == component_groups || kind == component_materials;
  for (Component& each : out) {
    const std::uint32_t own = each.classes[0];
    const glm::dvec3 normal = d.out.axes[each.state.axes][2];
    std::uint32_t in_scope =
        is_whole ? std::uint32_t{face_all} : classes_of(normal_in_scope(d, state, normal));
    std::uint32_t in_world = is_whole ? std::uint32_t{face_all} : classes_of(normal);
    if (each.state.tag == face_is_inside) in_scope |= face_inside;
    if (each.state.tag == face_is_border) in_scope |= face_border;
    if (kind == component_faces && each.state.tag == 0) in_scope |= is_closed ? face_inside : face_border;
    each.classes[frame_scope] = in_scope | own;
    each.classes[frame_world] = in_world | own;
  }
  return out;
}

}  // namespace seedmesh::building
