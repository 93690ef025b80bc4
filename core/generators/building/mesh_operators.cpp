/// Operations on the corners and faces of the geometry. Definitions as in the CGA reference.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/solid_tools.h"

namespace seedmesh::building::operators {
namespace {

bool has_faces(const ShapeState& state) { return !state.has_asset() && dimension(state.size) >= 2; }

/// Gives the state other geometry in the same unit cube.
void replace(Derivation& d, ShapeState& state, Solid solid) {
  state.geometry = add_solid(d, std::move(solid));
}

/// Twice the areas of the triangles of a corner with its neighbours, which say how little it matters (Visvalingam and
/// Whyatt, 1993).
double weight_of_corner(const std::vector<glm::dvec3>& ring, std::size_t i) {
  const std::size_t n = ring.size();
  return glm::length(glm::cross(ring[i] - ring[(i + n - 1) % n], ring[(i + 1) % n] - ring[i]));
}

/// The corners of an outline whose edges within `slack` of a right angle to the longest one are made exactly so.
std::vector<glm::dvec2> rectified(const std::vector<glm::dvec2>& ring, double slack) {
  const std::size_t n = ring.size();
  std::size_t longest = 0;
  const auto edge = [&](std::size_t i) { return ring[(i + 1) % n] - ring[i]; };
  for (std::size_t i = 1; i < n; ++i) {
    if (glm::length(edge(i)) > glm::length(edge(longest)) * (1 + 1e-9)) longest = i;
  }
  const glm::dvec2 x = edge(longest) / glm::length(edge(longest)), y(-x.y, x.x);
  struct Line {
    glm::dvec2 at, along;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 e = edge(i) / std::max(glm::length(edge(i)), 1e-300);
    const double a = glm::dot(e, x), b = glm::dot(e, y), limit = math::sin(slack);
    glm::dvec2 along = e;
    if (std::abs(b) <= limit) {
      along = a > 0 ? x : -x;
    } else if (std::abs(a) <= limit) {
      along = b > 0 ? y : -y;
    }
    lines.push_back({0.5 * (ring[i] + ring[(i + 1) % n]), along});
  }
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i < n; ++i) {
    const Line &before = lines[(i + n - 1) % n], &here = lines[i];
    const double cross = before.along.x * here.along.y - before.along.y * here.along.x;
    if (std::abs(cross) < 0.05) {  // almost parallel: the corner stays, on the line of its edge
      out.push_back(here.at + here.along * glm::dot(ring[i] - here.at, here.along));
      continue;
    }
    const glm::dvec2 to = here.at - before.at;
    out.push_back(before.at + before.along * ((to.x * here.along.y - to.y * here.along.x) / cross));
  }
  return out;
}

}  // namespace

void mirror(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  unsigned axes = 0;
  for (std::uint32_t i = 0; i < step.argument_count; ++i) {
    if (is_word(d, step, i)) {  // mirror(xz)
      for (const char c : word_at(d, step, i))
        axes |= c >= 'x' && c <= 'z' ? 1U << static_cast<unsigned>(c - 'x') : 0U;
    } else if (i < 3 && number_or(d, step, i, 0) != 0) {
      axes |= 1U << i;
    }
  }
  if (axes == 0) return;
  if (state.has_asset())
    return warn(d, step.offset, "an inserted part or asset cannot be mirrored and does not change");
  if (!state.has_solid()) return;  // a box is its own mirror image
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (state.size[static_cast<int>(axis)] == 0) axes &= ~(1U << axis);
  }
  replace(d, state, mirrored(d.out.solid_of(state.geometry), axes));
}

void reverse_normals(Derivation& d, const Step&, ShapeState& state, const StepContext&) {
  if (!has_faces(state)) return;
  Solid solid = solid_of(d, state);
  for (const Loop& loop : solid.loops)
    std::reverse(solid.corners.begin() + loop.first, solid.corners.begin() + loop.first + loop.count);
  solid.is_closed = false;
  replace(d, state, std::move(solid));
}

void cleanup(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (!state.has_solid() || dimension(state.size) < 2) return;
  const std::string what = word_or(d, step, 0, "all");
  if (what != "all" && what != "faces" && what != "edges" && what != "vertices" && what != "uvs")
    reject(d, step.offset, "found " + lang::in_quotes(what) + ", expected all, faces, edges or vertices");
  const double distance = number_or(d, step, 1, 0);
  if (distance < 0)
    reject(d, step.offset, "found a distance of " + text_of_number(distance) + " m, expected 0 or more");
  Solid solid = solid_in_metres(d, state);
  const bool all = what == "all";
  if (all || what == "vertices") solid = welded(solid, distance);
  if (all || what == "faces" || what == "edges") solid = with_joined_faces(solid, distance);
  if (all || what == "vertices") solid = without_straight_corners(solid, distance);
  if (solid.faces.empty()) return;
  take_solid(d, state, std::move(solid));
}

void convexify(Derivation& d, const Step&, ShapeState& state, const StepContext&) {
  if (!state.has_solid() || dimension(state.size) < 2) return;
  replace(d, state, convex_faces(d.out.solid_of(state.geometry), d.job));
}

void delete_holes(Derivation& d, const Step&, ShapeState& state, const StepContext&) {
  if (!state.has_solid() || dimension(state.size) < 2) return;
  Solid solid = d.out.solid_of(state.geometry);
  bool has_holes = false;
  for (Face& face : solid.faces) {
    has_holes |= face.loop_count > 1;
    face.loop_count = 1;
  }
  if (!has_holes) return;
  Solid kept;  // without the corners of the holes
  kept.points = solid.points;
  for (const Face& face : solid.faces) {
    Face copy = face;
    copy.first_loop = static_cast<std::uint32_t>(kept.loops.size());
    add_loop(kept, points_of(solid, solid.loops[face.first_loop]));
    kept.faces.push_back(copy);
  }
  kept.is_closed = solid.is_closed && is_watertight(kept);
  replace(d, state, std::move(kept));
}

void rectify(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const double angle = number_or(d, step, 0, 15);
  if (!(angle >= 0 && angle <= 45)) {
    reject(d, step.offset,
           "found an angle of " + text_of_number(angle) + ", expected one from 0 to 45 degrees");
  }
  if (!state.has_solid() || dimension(state.size) != 2) return;
  Solid solid = solid_in_metres(d, state);
  const int w = flat_axis(state.size), u = (w + 1) % 3, v = (w + 2) % 3;
  for (const Face& face : solid.faces) {
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<glm::dvec2> ring;
      const std::span<const std::uint32_t> points = points_of(solid, loop);
      for (const std::uint32_t point : points)
        ring.emplace_back(solid.points[point][u], solid.points[point][v]);
      const std::vector<glm::dvec2> made = rectified(ring, math::radians(angle));
      for (std::size_t i = 0; i < points.size(); ++i) {
        solid.points[points[i]][u] = made[i].x;
        solid.points[points[i]][v] = made[i].y;
      }
    }
  }
  take_solid(d, state, std::move(solid));
}

void reduce(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const double share = number_or(d, step, 0, 0);
  if (!(share >= 0 && share <= 1))
    reject(d, step.offset, "found a share of " + text_of_number(share) + ", expected one from 0 to 1");
  if (!has_faces(state) || share == 0) return;
  if (dimension(state.size) == 3) {
    return warn(d, step.offset,
                "reduceGeometry has no effect on solids, whose faces share corners; use output.lods");
  }
  const Solid solid = solid_in_metres(d, state);
  Solid out;
  for (const Face& face : solid.faces) {
    Face copy = face;
    copy.first_loop = static_cast<std::uint32_t>(out.loops.size());
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<glm::dvec3> ring;
      for (const std::uint32_t point : points_of(solid, loop)) ring.push_back(solid.points[point]);
      auto left =
          static_cast<std::size_t>(math::to_int64(std::round(share * static_cast<double>(ring.size()))));
      for (; left > 0 && ring.size() > 3; --left) {
        std::size_t least = 0;
        for (std::size_t i = 1; i < ring.size(); ++i) {
          if (weight_of_corner(ring, i) < weight_of_corner(ring, least)) least = i;
        }
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
        if ((left & 255U) == 0) d.job.check();
      }
      out.loops.push_back(
          {static_cast<std::uint32_t>(out.corners.size()), static_cast<std::uint32_t>(ring.size())});
      for (const glm::dvec3& p : ring) {
        out.corners.push_back(static_cast<std::uint32_t>(out.points.size()));
        out.points.push_back(p);
      }
    }
    out.faces.push_back(copy);
  }
  take_solid(d, state, std::move(out));
}

/// setNormals(soft | hard | ...) and softenNormals(angle)
void set_normals(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (!state.has_solid() || dimension(state.size) < 3) return;
  std::string mode = "soften";
  double angle = 20;
  if (is_word(d, step, 0)) {
    mode = word_at(d, step, 0);
    angle = number_or(d, step, 1, mode == "soft" ? 180 : angle);
  } else {
    angle = number_or(d, step, 0, angle);
  }
  if (mode == "soft") angle = 180;
  if (mode == "hard" || mode == "conform") angle = -1;
  if (mode != "soft" && mode != "hard" && mode != "auto" && mode != "conform" && mode != "soften")
    reject(d, step.offset, "found " + lang::in_quotes(mode) + ", expected soft, hard, auto or conform");
  const Solid metres = solid_in_metres(d, state);
  Solid solid = d.out.solid_of(state.geometry);
  const double least = angle < 0 ? 2 : math::cos(math::radians(std::min(angle, 180.0))) - 1e-9;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first;
  std::vector<glm::dvec3> normals;
  for (const Face& face : metres.faces)
    normals.push_back(math::unit(area_vector(metres, face, glm::dvec3(1)), glm::dvec3(0, 1, 0)));
  for (Face& face : solid.faces) face.is_round = false;
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const std::uint32_t a = solid.corners[loop.first + i],
                            b = solid.corners[loop.first + (i + 1) % loop.count];
        const auto [found, is_new] = first.try_emplace({std::min(a, b), std::max(a, b)}, f);
        if (is_new || glm::dot(normals[found->second], normals[f]) < least) continue;
        solid.faces[f].is_round = solid.faces[found->second].is_round = true;
      }
    }
  }
  replace(d, state, std::move(solid));
}

void reset_geometry(Derivation& d, const Step&, ShapeState& state, const StepContext&) {
  const Shape& first = d.out.shapes[0];
  state.origin = first.origin;
  state.size = first.size;
  state.axes = first.axes;
  state.geometry = first.geometry;
  state.roof_up = no_roof;
}

}  // namespace seedmesh::building::operators
