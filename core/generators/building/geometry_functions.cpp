/// Properties of the geometry of a shape; see value_functions.h. Definitions as in the CGA reference.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/math.h"
#include "core/generators/building/components.h"
#include "core/generators/building/projections.h"
#include "core/generators/building/solid_faces.h"
#include "core/generators/building/tags.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;

constexpr double planar_share = 1e-6;  ///< of the size: a point this near to a plane lies in it

const ShapeState& seen(const Evaluation& at) { return *at.d.seen; }

/// The geometry in metres of the scope; empty for edges, points and assets.
Solid geometry_of(const Evaluation& at) {
  const ShapeState& state = seen(at);
  if (state.has_asset() || dimension(state.size) < 2) return {};
  Solid solid = solid_of(at.d, state);
  for (glm::dvec3& p : solid.points) p *= state.size;
  return solid;
}

/// The faces that a selector such as side or world.up takes.
std::vector<ShapeState> faces_taken(Evaluation& at, ValueArguments a) {
  std::uint32_t classes = face_all;
  std::uint8_t frame = frame_scope;
  if (!a.empty() && !read_selector(text_in(at, a[0]), classes, frame)) {
    reject(at,
           "found " + lang::in_quotes(text_in(at, a[0])) + ", expected a selector such as side or world.up");
  }
  std::vector<ShapeState> out;
  const ShapeState state = seen(at);
  if (state.has_asset() || dimension(state.size) < 2) return out;
  for (const Component& each : components_of(at.d, state, component_faces)) {
    if ((each.classes[frame] & classes) != 0) out.push_back(each.state);
  }
  return out;
}

TaggedValue area(Evaluation& at, ValueArguments a) {
  if (a.empty()) return number_value(area_of(at.d, seen(at)));
  double sum = 0;
  for (const ShapeState& face : faces_taken(at, a)) sum += area_of(at.d, face);
  return number_value(sum);
}
TaggedValue volume(Evaluation& at, ValueArguments) { return number_value(volume_of(at.d, seen(at))); }

TaggedValue face_count(Evaluation& at, ValueArguments a) {
  if (a.empty()) return number_value(static_cast<double>(geometry_of(at).faces.size()));
  return number_value(static_cast<double>(faces_taken(at, a).size()));
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::map<Edge, int> edge_uses(const Solid& solid) {
  std::map<Edge, int> uses;
  for (const Loop& loop : solid.loops) {
    const std::span<const std::uint32_t> points = points_of(solid, loop);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t a = points[i], b = points[(i + 1) % points.size()];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  return uses;
}

TaggedValue edge_count(Evaluation& at, ValueArguments) {
  if (dimension(seen(at).size) == 1) return number_value(1);
  return number_value(static_cast<double>(edge_uses(geometry_of(at)).size()));
}

TaggedValue vertex_count(Evaluation& at, ValueArguments) {
  const Solid solid = geometry_of(at);
  const std::set<std::uint32_t> used(solid.corners.begin(), solid.corners.end());
  if (used.empty()) return number_value(dimension(seen(at).size) == 1 ? 2 : 1);
  return number_value(static_cast<double>(used.size()));
}

TaggedValue hole_count(Evaluation& at, ValueArguments) {
  double holes = 0;
  const Solid solid = geometry_of(at);
  for (const Face& face : solid.faces) holes += face.loop_count - 1;
  return number_value(holes);
}

TaggedValue boundary_length(Evaluation& at, ValueArguments) {
  const Solid solid = geometry_of(at);
  if (solid.faces.empty()) return number_value(dimension(seen(at).size) == 1 ? seen(at).size.x : 0);
  double sum = 0;
  for (const auto& [edge, uses] : edge_uses(solid)) {
    if (uses == 1) sum += glm::length(solid.points[edge.second] - solid.points[edge.first]);
  }
  return number_value(sum);
}

TaggedValue is_closed(Evaluation& at, ValueArguments) {
  const Solid solid = geometry_of(at);
  const std::map<Edge, int> uses = edge_uses(solid);
  return truth_value(!uses.empty() &&
                     std::ranges::all_of(uses, [](const auto& each) { return each.second == 2; }));
}

bool is_flat(const Solid& solid) {
  for (const Face& face : solid.faces) {
    const glm::dvec3 n = unit_normal(solid, face);
    const glm::dvec3 base = solid.points[solid.corners[solid.loops[face.first_loop].first]];
    double size = 0, off = 0;
    for (const Loop& loop : loops_of(solid, face)) {
      for (const std::uint32_t point : points_of(solid, loop)) {
        size = std::max(size, glm::length(solid.points[point] - base));
        off = std::max(off, std::abs(glm::dot(solid.points[point] - base, n)));
      }
    }
    if (off > planar_share * size) return false;
  }
  return true;
}
TaggedValue is_planar(Evaluation& at, ValueArguments) { return truth_value(is_flat(geometry_of(at))); }

/// A face with a hole or a corner that turns inwards.
TaggedValue is_concave(Evaluation& at, ValueArguments) {
  const Solid solid = geometry_of(at);
  for (const Face& face : solid.faces) {
    if (face.loop_count > 1) return truth_value(true);
    const glm::dvec3 n = unit_normal(solid, face);
    const std::span<const std::uint32_t> points = points_of(solid, solid.loops[face.first_loop]);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 a = solid.points[points[i]], b = solid.points[points[(i + 1) % points.size()]],
                       c = solid.points[points[(i + 2) % points.size()]];
      if (glm::dot(glm::cross(b - a, c - b), n) < -1e-9 * glm::length(b - a) * glm::length(c - b))
        return truth_value(true);
    }
  }
  return truth_value(false);
}

/// Whether every face has four corners, each within an angle of 90 degrees; the default is 1 degree.
TaggedValue is_rectangular(Evaluation& at, ValueArguments a) {
  const double slack =
      math::sin(math::radians(a.empty() ? 1.0 : std::clamp(number_in(at, a[0]), 0.0, 90.0))) + 1e-12;
  const Solid solid = geometry_of(at);
  for (const Face& face : solid.faces) {
    const std::span<const std::uint32_t> points = points_of(solid, solid.loops[face.first_loop]);
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < points.size(); ++i) {  // straight corners do not count
      const glm::dvec3 p = solid.points[points[i]],
                       before = solid.points[points[(i + points.size() - 1) % points.size()]],
                       next = solid.points[points[(i + 1) % points.size()]];
      const double sine = glm::length(glm::cross(math::unit(p - before, {}), math::unit(next - p, {})));
      if (sine > 1e-6) corners.push_back(p);
    }
    if (face.loop_count > 1 || corners.size() != 4) return truth_value(false);
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3 in = math::unit(corners[i] - corners[(i + 3) % 4], {}),
                       out = math::unit(corners[(i + 1) % 4] - corners[i], {});
      if (std::abs(glm::dot(in, out)) > slack) return truth_value(false);
    }
  }
  return truth_value(!solid.faces.empty());
}

/// Whether some face of the shape, or with another selector all of them, has a direction.
TaggedValue is_oriented(Evaluation& at, ValueArguments a) {
  return truth_value(!a.empty() && !faces_taken(at, a).empty());
}

TaggedValue is_instanced(Evaluation& at, ValueArguments) { return truth_value(seen(at).has_asset()); }

/// The angle of the normal of the first face, or of an edge: zenith from the vertical, azimuth about it from +x towards -z.
TaggedValue angle(Evaluation& at, ValueArguments a) {
  const std::string kind = text_in(at, a[0]);
  glm::dvec3 n = at.d.out.axes[seen(at).axes][dimension(seen(at).size) == 1 ? 0 : 2];
  if (const std::vector<ShapeState> faces = faces_taken(at, {}); !faces.empty())
    n = at.d.out.axes[faces[0].axes][2];
  if (kind == "zenith" || kind == "maxSlope")
    return number_value(math::degrees(math::acos(std::clamp(n.y, -1.0, 1.0))));
  if (kind == "azimuth") return number_value(math::degrees(math::atan2(-n.z, n.x)));
  reject(at, "found " + lang::in_quotes(kind) + ", expected zenith or azimuth");
}

TaggedValue height(Evaluation& at, ValueArguments) {
  const ShapeState& state = seen(at);
  double low = 0, high = 0;
  const glm::dmat3& axes = at.d.out.axes[state.axes];
  for (int axis = 0; axis < 3; ++axis) (axes[axis].y > 0 ? high : low) += axes[axis].y * state.size[axis];
  return number_value(high - low);
}

int set_in(const Evaluation& at, ValueArguments a) {
  const double set = a.empty() ? 0 : number_in(at, a[0]);
  if (!(set >= 0 && set <= 9 && set == std::floor(set)))
    reject(at, "found a number of a set of texture coordinates that is not a whole number from 0 to 9");
  return static_cast<int>(set);
}

/// The length along u or v in tiles (uvSpace), or in metres of the surface.
template <int axis>
TaggedValue uv_length(Evaluation& at, ValueArguments a) {
  const UvRange range = uv_range(at.d, seen(at), set_in(at, a));
  const bool in_metres = a.size() < 2 || text_in(at, a[1]) != "uvSpace";
  return number_value((range.high[axis] - range.low[axis]) * (in_metres ? range.metres[axis] : 1));
}
template <int axis>
TaggedValue uv_low(Evaluation& at, ValueArguments a) {
  return number_value(uv_range(at.d, seen(at), set_in(at, a)).low[axis]);
}
template <int axis>
TaggedValue uv_high(Evaluation& at, ValueArguments a) {
  return number_value(uv_range(at.d, seen(at), set_in(at, a)).high[axis]);
}

/// The tags of a shape and of its faces.
std::uint32_t tags_of(Derivation& d, const ShapeState& state) {
  std::uint32_t set = d.out.styles[state.style].tags;
  if (state.geometry == box_geometry || state.has_asset()) return set;
  // A copy: a new set of tags moves the solids of the derivation nowhere, but may add sets.
  for (const Face& face : std::vector<Face>(d.out.solid_of(state.geometry).faces))
    set = joined_tags(d, set, face.tags);
  return set;
}

TaggedValue is_tagged(Evaluation& at, ValueArguments a) {
  const std::string name = text_in(at, a[0]);
  const ShapeState& state = at.d.component != nullptr ? at.d.component->state : seen(at);
  return truth_value(has_tag(at.d, tags_of(at.d, state), name, std::min(dimension(state.size), 2)));
}

TaggedValue tags(Evaluation& at, ValueArguments) {
  ValueArray out;
  for (const std::uint32_t id : at.d.out.tag_sets[tags_of(at.d, seen(at))])
    out.values.push_back(text_value(at, std::string(name_of_tag(*at.d.out.texts.find(id)))));
  return array_value(at, std::move(out));
}

TaggedValue has_tags(Evaluation& at, ValueArguments a) {
  if (!a.empty()) return is_tagged(at, a);
  return truth_value(!at.d.out.tag_sets[tags_of(at.d, seen(at))].empty());
}

TaggedValue has_uvs(Evaluation& at, ValueArguments a) {
  const double set = a.empty() ? 0 : number_in(at, a[0]);
  return truth_value(set >= 0 && set <= 9 && projection_id(at.d, seen(at), static_cast<int>(set), true) != 0);
}

TaggedValue no_names(Evaluation& at, ValueArguments) { return array_value(at, {}); }

#define SEEDMESH_EXAMPLE(expression) "A --> report(\"x\", " expression ") B."
constexpr ValueFunctionRow rows[] = {
    {"geometry.area", 0, 1, area, "selector",
     "The area of all faces, or of those that a selector takes, in square metres.",
     SEEDMESH_EXAMPLE("geometry.area(side)")},
    {"geometry.volume", 0, 0, volume, "", "Cubic metres; 0 if the geometry is not closed.",
     SEEDMESH_EXAMPLE("geometry.volume()")},
    {"geometry.nFaces", 0, 1, face_count, "selector", "The number of faces.",
     SEEDMESH_EXAMPLE("geometry.nFaces")},
    {"geometry.nEdges", 0, 0, edge_count, "", "The number of edges.", SEEDMESH_EXAMPLE("geometry.nEdges")},
    {"geometry.nVertices", 0, 0, vertex_count, "", "The number of vertices.",
     SEEDMESH_EXAMPLE("geometry.nVertices")},
    {"geometry.nHoles", 0, 0, hole_count, "", "The number of holes in faces.",
     SEEDMESH_EXAMPLE("geometry.nHoles")},
    {"geometry.boundaryLength", 0, 0, boundary_length, "", "The length of all edges with one face.",
     "A --> s('1, 0, '1) report(\"x\", geometry.boundaryLength) B."},
    {"geometry.isClosedSurface", 0, 0, is_closed, "", "Whether every edge has two faces.",
     SEEDMESH_EXAMPLE("geometry.isClosedSurface")},
    {"geometry.isConcave", 0, 0, is_concave, "", "Whether a face has a hole or a corner that turns inwards.",
     SEEDMESH_EXAMPLE("geometry.isConcave()")},
    {"geometry.isPlanar", 0, 1, is_planar, "", "Whether the corners of each face lie in a plane.",
     SEEDMESH_EXAMPLE("geometry.isPlanar()")},
    {"geometry.isRectangular", 0, 1, is_rectangular, "angle",
     "Whether each face has four corners within an angle of 90 degrees.",
     SEEDMESH_EXAMPLE("geometry.isRectangular(15)")},
    {"geometry.isOriented", 1, 1, is_oriented, "selector", "Whether a selector takes some face.",
     SEEDMESH_EXAMPLE("geometry.isOriented(world.south)")},
    {"geometry.isInstanced", 0, 0, is_instanced, "", "Whether the geometry is an inserted part or asset.",
     SEEDMESH_EXAMPLE("geometry.isInstanced")},
    {"geometry.angle", 1, 1, angle, "zenith | azimuth",
     "The angle of the normal of the first face: from the vertical (zenith), or about it from +x towards -z "
     "(azimuth).",
     "A --> s('1, 0, '1) report(\"x\", geometry.angle(zenith)) B."},
    {"geometry.height", 0, 1, height, "", "The extent along the vertical of the world.",
     SEEDMESH_EXAMPLE("geometry.height")},
    {"geometry.du", 0, 2, uv_length<0>, "set, unitSpace | uvSpace",
     "The extent along u in metres, or in tiles.",
     "A --> comp(f){ front: report(\"x\", geometry.du(0, unitSpace)) B. }"},
    {"geometry.dv", 0, 2, uv_length<1>, "set, unitSpace | uvSpace",
     "The extent along v in metres, or in tiles.",
     "A --> comp(f){ front: report(\"x\", geometry.dv(0, unitSpace)) B. }"},
    {"geometry.uMin", 0, 1, uv_low<0>, "set", "The lowest u.",
     "A --> comp(f){ front: report(\"x\", geometry.uMin(0)) B. }"},
    {"geometry.uMax", 0, 1, uv_high<0>, "set", "The highest u.",
     "A --> comp(f){ front: report(\"x\", geometry.uMax(0)) B. }"},
    {"geometry.vMin", 0, 1, uv_low<1>, "set", "The lowest v.",
     "A --> comp(f){ front: report(\"x\", geometry.vMin(0)) B. }"},
    {"geometry.vMax", 0, 1, uv_high<1>, "set", "The highest v.",
     "A --> comp(f){ front: report(\"x\", geometry.vMax(0)) B. }"},
    {"geometry.groups", 0, 0, no_names, "",
     "The names of groups of an asset, which no geometry of rules has.",
     "A --> report(\"x\", size(geometry.groups)) B."},
    {"geometry.materials", 0, 0, no_names, "",
     "The names of materials of an asset, which no geometry of rules has.",
     "A --> report(\"x\", size(geometry.materials)) B."},
    {"geometry.tags", 0, 0, tags, "", "The tags of the shape as an array.",
     "A --> tag(\"a\") report(\"x\", size(geometry.tags)) B."},
    {"geometry.hasTags", 0, 1, has_tags, "tag", "Whether the shape has any tag, or one of a name.",
     "A --> tag(\"a\") D  D --> case geometry.hasTags(\"a\"): B. else: C."},
    {"geometry.hasUVs", 0, 1, has_uvs, "set", "Whether a set has texture coordinates.",
     "A --> comp(f){ front: tileUV(0, 1, 1) D }  D --> case geometry.hasUVs(0): B. else: C."},
    {"geometry.isTagged", 1, 1, is_tagged, "tag", "Whether the shape has a tag.",
     SEEDMESH_EXAMPLE("geometry.isTagged(\"a\")")},
    {"isTagged", 1, 1, is_tagged, "tag", "In a selector: whether the component has a tag.",
     "A --> tag(\"a\") comp(f){ isTagged(\"a\"): B. }"},
};
#undef SEEDMESH_EXAMPLE

}  // namespace

std::span<const ValueFunctionRow> geometry_functions() { return rows; }

}  // namespace seedmesh::building
