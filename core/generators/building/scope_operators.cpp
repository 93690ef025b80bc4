/// Operations that move, resize and rotate the scope.
#include <algorithm>

#include "core/base/math.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/lifted_faces.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/raised_solids.h"
#include "core/generators/building/shape_grammar/rotation.h"

namespace seedmesh::building::operators {
namespace {

/// The shortest rotation from one direction to another.
glm::dmat3 turn_between(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  if (sine < 1e-12) {
    if (cosine > 0) return glm::dmat3(1);
    // A half turn about any direction at right angles.
    glm::dvec3 across = glm::cross(from, glm::dvec3(1, 0, 0));
    if (glm::dot(across, across) < 1e-6) across = glm::cross(from, glm::dvec3(0, 0, 1));
    across = math::unit(across, glm::dvec3(0, 0, 1));
    return 2.0 * glm::outerProduct(across, across) - glm::dmat3(1);
  }
  const glm::dvec3 n = axis / sine;
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x), glm::dvec3(n.y, -n.x, 0));
  return cosine * glm::dmat3(1) + sine * cross + (1 - cosine) * glm::outerProduct(n, n);
}

/// 0 for xUp, 1 for yUp, 2 for zUp, else -1.
int up_axis(const std::string& word) {
  return word == "xUp" ? 0 : word == "yUp" ? 1 : word == "zUp" ? 2 : -1;
}

/// Axes with `up` on the given axis, and `along` on x, or on y if x is up.
glm::dmat3 axes_with(int axis, const glm::dvec3& up, const glm::dvec3& along) {
  glm::dmat3 out(1);
  out[axis] = up;
  const int level = axis == 0 ? 1 : 0, last = 3 - axis - level;
  out[level] = along;
  out[last] = glm::cross(out[(last + 1) % 3], out[(last + 2) % 3]);
  return out;
}

/// A component by its number, `any` for the first.
std::size_t component_of(const Derivation& d, const Step& step, const std::string& text, std::size_t count) {
  if (text == "any") return 0;
  std::size_t value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9' || value > 1'000'000) {
      reject(d, step.offset,
             "found " + lang::in_quotes(text) + ", expected a number, any, largest, longest or world.lowest");
    }
    value = value * 10 + static_cast<std::size_t>(c - '0');
  }
  return std::min(value, count - 1);
}
/// The edge of a polygon along which the smallest rectangle around it lies (Freeman and Shapira, 1975).
std::size_t edge_of_smallest_box(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 x = math::unit(corners[(i + 1) % corners.size()] - corners[i], glm::dvec3(1, 0, 0)),
                     y = glm::cross(normal, x);
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::dvec3& p : corners) {
      const glm::dvec2 q(glm::dot(p, x), glm::dot(p, y));
      low = glm::min(low, q);
      high = glm::max(high, q);
    }
    const double area = (high.x - low.x) * (high.y - low.y);
    if (area < least * (1 - 1e-9)) {
      least = area;
      best = i;
    }
  }
  return best;
}

/// The mean height of the corners of a face, above the origin of its scope.
double height_of(const Solid& solid, const Face& face, const glm::dmat3& axes, const glm::dvec3& size) {
  double sum = 0, count = 0;
  for (const std::uint32_t corner : points_of(solid, solid.loops[face.first_loop])) {
    sum += (axes * (solid.points[corner] * size)).y;
    ++count;
  }
  return sum / std::max(count, 1.0);
}

/// Makes a solid the face that it covers, seen along an axis: a solid that is squeezed would have faces without area.
void flatten(Derivation& d, ShapeState& state, int axis) {
  Solid outline = outline_along(d.out.solid_of(state.geometry), axis, 1);
  if (outline.faces.empty()) return;
  state.geometry = add_solid(d, std::move(outline));
  state.roof_up = no_roof;
}

}  // namespace

void translate(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  glm::dvec3 by(0);
  for (int axis = 0; axis < 3; ++axis) by[axis] = length_of(d, a[axis], state.size[axis]);
  state.origin += d.out.axes[state.axes] * by;
}

void resize(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  glm::dvec3 size(0);
  for (int axis = 0; axis < 3; ++axis) size[axis] = length_of(d, a[axis], state.size[axis]);
  unsigned mirror = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] >= 0) continue;
    state.origin += d.out.axes[state.axes][axis] * size[axis];
    size[axis] = -size[axis];
    mirror |= 1U << static_cast<unsigned>(axis);
  }
  const int flat = flat_axis(state.size);
  if (dimension(state.size) == 2 && size[flat] != 0 && !state.has_asset()) {
    if (d.grammar.turns_scopes && dimension(size) == 3) {
      lift_face(d, state, flat);
    } else if (
        state.has_solid()) {  // a polygon with a height is a prism, as a rectangle with a height is a box
      make_prism_of(d, state, flat);
    }
  }
  if (dimension(state.size) == 3 && dimension(size) == 2 && state.has_solid())
    flatten(d, state, flat_axis(size));
  if (mirror != 0 && state.has_solid())
    state.geometry = add_solid(d, mirrored(d.out.solid_of(state.geometry), mirror));
  state.size = size;
}

void rotate(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  // r(x, y, z), r(scopeCenter, x, y, z), or the centre last
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const std::string* centre = nullptr;
  glm::dvec3 angles(0);
  int axis = 0;
  for (std::uint32_t i = 0; i < step.argument_count; ++i) {
    if (a[i].word != none) {
      centre = &d.grammar.words[a[i].word];
    } else if (axis < 3) {
      angles[axis++] = number_of(d, a[i].value);
    }
  }
  if (axis < 3 || (step.argument_count == 4 && centre == nullptr))
    reject(d, step.offset, "expected three angles, and perhaps scopeCenter or scopeOrigin");
  const glm::dmat3 m = rotation_xyz(angles);
  const glm::dmat3 before = d.out.axes[state.axes];
  glm::dvec3 pivot(0);
  if (centre != nullptr) {
    const std::string& word = *centre;
    if (word == "scopeCenter") {
      pivot = 0.5 * state.size;
    } else if (word != "scopeOrigin") {
      reject(d, step.offset,
             "found the centre " + lang::in_quotes(word) + ", expected scopeOrigin or scopeCenter");
    }
  }
  const glm::dmat3 after = before * m;
  state.origin += before * pivot - after * pivot;
  state.axes = add_axes(d, after);
}

void center(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  const ShapeState& whole = site.frame.before;
  const glm::dmat3 axes = d.out.axes[whole.axes];
  const glm::dvec3 middle = whole.origin + axes * (0.5 * whole.size);
  const glm::dvec3 own = state.origin + d.out.axes[state.axes] * (0.5 * state.size);
  const glm::dvec3 by = glm::transpose(axes) * (middle - own);
  for (int axis = 0; axis < 3; ++axis) {
    if ((step.axis >> axis & 1) != 0) state.origin += axes[axis] * by[axis];
  }
}

/// The geometry keeps its place; the axes along which the scope is flipped begin at the other end.
void mirror_scope(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  glm::bvec3 flipped(true, false, true);  // without arguments
  for (std::uint32_t i = 0; i < step.argument_count; ++i)
    flipped[static_cast<int>(i)] = number_or(d, step, i, 0) != 0;
  const int count = static_cast<int>(flipped.x) + static_cast<int>(flipped.y) + static_cast<int>(flipped.z);
  if (count % 2 != 0) {
    warn(d, step.offset,
         "mirrorScope along one axis or all three would make the axes of the scope left-handed, and has no "
         "effect");
    return;
  }
  glm::dmat3 axes = d.out.axes[state.axes];
  for (int axis = 0; axis < 3; ++axis) {
    if (!flipped[axis]) continue;
    state.origin += axes[axis] * state.size[axis];
    axes[axis] = -axes[axis];
  }
  state.axes = add_axes(d, axes);
  if (state.has_solid()) {
    Solid turned = d.out.solid_of(state.geometry);
    for (glm::dvec3& p : turned.points) {
      for (int axis = 0; axis < 3; ++axis) {
        if (flipped[axis]) p[axis] = state.size[axis] > 0 ? 1 - p[axis] : 0;
      }
    }
    state.geometry = add_solid(d, std::move(turned));
  }
}

void align_to_axes(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  if (step.argument_count == 0) return reframe(d, state, glm::dmat3(1));
  const std::string& word = d.grammar.words[d.grammar.arguments[step.first_argument].word];
  if (word.size() != 1 || word[0] < 'x' || word[0] > 'z')
    reject(d, step.offset, "found the axis " + lang::in_quotes(word) + ", expected x, y or z");
  const glm::dmat3 axes = d.out.axes[state.axes];
  reframe(d, state, turn_between(axes[word[0] - 'x'], glm::dvec3(0, 1, 0)) * axes);
}

void align_to_geometry(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const auto word = [&](std::uint32_t i) {
    return i < step.argument_count ? d.grammar.words[a[i].word] : std::string("any");
  };
  const int up = up_axis(word(0));
  if (up < 0) reject(d, step.offset, "found " + lang::in_quotes(word(0)) + ", expected xUp, yUp or zUp");
  if (state.has_asset() || dimension(state.size) < 2) return;
  const Solid solid = solid_of(d, state);
  std::size_t chosen = 0;
  const bool is_box = step.op == Op::align_to_box;
  if (is_box || word(1) == "largest") {
    double most = -1;
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
      const double area = glm::length(area_vector(solid, solid.faces[i], state.size));
      if (area > most * (1 + 1e-9)) {
        most = area;
        chosen = i;
      }
    }
  } else if (word(1) == "world.lowest" || word(1) == "object.lowest") {
    double least = 1e300;
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
      const double height = height_of(solid, solid.faces[i], d.out.axes[state.axes], state.size);
      if (height >= least - 1e-9) continue;
      least = height;
      chosen = i;
    }
  } else {
    chosen = component_of(d, step, word(1), solid.faces.size());
  }
  const Face& face = solid.faces[chosen];
  const glm::dmat3 axes = d.out.axes[state.axes];
  const glm::dvec3 normal = axes * math::unit(area_vector(solid, face, state.size), glm::dvec3(0, 1, 0));
  const Loop& outer = solid.loops[face.first_loop];
  std::vector<glm::dvec3> corners;
  for (std::uint32_t i = 0; i < outer.count; ++i)
    corners.push_back(axes * (solid.points[solid.corners[outer.first + i]] * state.size));
  const auto edge = [&](std::size_t i) { return corners[(i + 1) % corners.size()] - corners[i]; };
  std::size_t best = 0;
  if (is_box) {
    best = edge_of_smallest_box(corners, normal);
  } else if (word(2) == "world.lowest" || word(2) == "object.lowest") {
    const auto height = [&](std::size_t i) { return corners[i].y + corners[(i + 1) % corners.size()].y; };
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (height(i) < height(best) - 1e-9) best = i;
    }
  } else if (word(2) == "longest") {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (glm::length(edge(i)) > glm::length(edge(best)) * (1 + 1e-9)) best = i;
    }
  } else {
    best = component_of(d, step, word(2), corners.size());
  }
  glm::dvec3 along = edge(best);
  along = math::unit(along - normal * glm::dot(along, normal), axes[0]);
  reframe(d, state, axes_with(up, normal, along));
}

}  // namespace seedmesh::building::operators
