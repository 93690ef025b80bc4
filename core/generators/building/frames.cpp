/// Scopes turned while their geometry stays, and the texture space that splits along u and v follow.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/deriver.h"

namespace seedmesh::building {
namespace {

constexpr double flat_share = 1e-9;  ///< of the largest size: less is no size but rounding

/// The turn that brings one direction to another by the shortest way.
glm::dmat3 turn_between(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 axis = glm::cross(from, to);
  const double sine = glm::length(axis), cosine = glm::dot(from, to);
  if (sine < 1e-12) {
    if (cosine > 0) return glm::dmat3(1);
    // Half a turn about anything aside.
    glm::dvec3 aside = glm::cross(from, glm::dvec3(1, 0, 0));
    if (glm::dot(aside, aside) < 1e-6) aside = glm::cross(from, glm::dvec3(0, 0, 1));
    aside = math::unit(aside, glm::dvec3(0, 0, 1));
    return 2.0 * glm::outerProduct(aside, aside) - glm::dmat3(1);
  }
  const glm::dvec3 n = axis / sine;
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x), glm::dvec3(n.y, -n.x, 0));
  return cosine * glm::dmat3(1) + sine * cross + (1 - cosine) * glm::outerProduct(n, n);
}

/// A row of words for a message.
int up_axis(const std::string& word) {
  return word == "xUp" ? 0 : word == "yUp" ? 1 : word == "zUp" ? 2 : -1;
}

/// Axes with `up` on the named axis and `along` on the next one that lies level in the face: x, or y where x
/// is up.
glm::dmat3 axes_with(int axis, const glm::dvec3& up, const glm::dvec3& along) {
  glm::dmat3 out(1);
  out[axis] = up;
  const int level = axis == 0 ? 1 : 0, last = 3 - axis - level;
  out[level] = along;
  out[last] = glm::cross(out[(last + 1) % 3], out[(last + 2) % 3]);
  return out;
}

}  // namespace

/// The geometry of a state as a solid in its unit cube.
Solid Deriver::solid_of(const State& state) {
  if (state.geometry != box_geometry) return out_.solid_of(state.geometry);
  return dimension(state.size) == 3 ? unit_box() : flat_solid(state);
}

/// Another scope around the same geometry: its axes are the columns of `axes` in the world.
void Deriver::reframe(State& state, const glm::dmat3& axes) {
  if ((state.geometry & asset_bit) != 0 || dimension(state.size) < 2) return;
  const glm::dmat3 before = out_.axes[state.axes], back = glm::transpose(axes) * before;
  Solid solid = solid_of(state);
  glm::dvec3 low(1e300), high(-1e300);
  for (glm::dvec3& p : solid.points) {
    p = back * (p * state.size);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 extent = high - low;
  const double largest = std::max({extent.x, extent.y, extent.z});
  for (glm::dvec3& p : solid.points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (extent[axis] < flat_share * largest) p[axis] = low[axis];
    }
  }
  glm::dvec3 from, size;
  const bool was_box = state.geometry == box_geometry;
  fit(solid, from, size);
  state.origin += axes * from;
  state.axes = add_axes(axes);
  state.size = size;
  // A box that fills its new scope stays a box.
  const bool fills = was_box && std::ranges::all_of(solid.points, [](const glm::dvec3& p) {
                       for (int axis = 0; axis < 3; ++axis) {
                         if (p[axis] > 1e-9 && p[axis] < 1 - 1e-9) return false;
                       }
                       return true;
                     });
  state.geometry = fills ? box_geometry : add_solid(std::move(solid));
}

/// alignScopeToAxes(), alignScopeToAxes(y): to the world's axes, or one axis to the upright of the world.
void Deriver::align_to_axes(const Step& step, State& state) {
  if (step.argument_count == 0) return reframe(state, glm::dmat3(1));
  const std::string& word = grammar_.words[grammar_.arguments[step.first_argument].word];
  if (word.size() != 1 || word[0] < 'x' || word[0] > 'z')
    reject(step.offset, "found the axis " + lang::in_quotes(word) + ", expected x, y or z");
  const glm::dmat3 axes = out_.axes[state.axes];
  reframe(state, turn_between(axes[word[0] - 'x'], glm::dvec3(0, 1, 0)) * axes);
}

/// alignScopeToGeometry(zUp, 0, longest): the named axis out of a face, the level one along an edge of it.
/// alignScopeToGeometryBBox(zUp): so that the box around a face is as small as can be.
void Deriver::align_to_geometry(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  const auto word = [&](std::uint32_t i) {
    return i < step.argument_count ? grammar_.words[a[i].word] : std::string("any");
  };
  const int up = up_axis(word(0));
  if (up < 0) reject(step.offset, "found " + lang::in_quotes(word(0)) + ", expected xUp, yUp or zUp");
  if ((state.geometry & asset_bit) != 0 || dimension(state.size) < 2) return;
  const auto number_of = [&](const std::string& text, std::size_t count) -> std::size_t {
    if (text == "any") return 0;
    std::size_t value = 0;
    for (const char c : text) {
      if (c < '0' || c > '9' || value > 1'000'000)
        reject(step.offset,
               "found " + lang::in_quotes(text) + ", expected a number, any, largest or longest");
      value = value * 10 + static_cast<std::size_t>(c - '0');
    }
    return std::min(value, count - 1);
  };
  const Solid solid = solid_of(state);
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
  } else {
    chosen = number_of(word(1), solid.faces.size());
  }
  const Face& face = solid.faces[chosen];
  const glm::dmat3 axes = out_.axes[state.axes];
  const glm::dvec3 normal = axes * math::unit(area_vector(solid, face, state.size), glm::dvec3(0, 1, 0));
  const Loop& outer = solid.loops[face.first_loop];
  std::vector<glm::dvec3> corners;
  for (std::uint32_t i = 0; i < outer.count; ++i)
    corners.push_back(axes * (solid.points[solid.corners[outer.first + i]] * state.size));
  const auto edge = [&](std::size_t i) { return corners[(i + 1) % corners.size()] - corners[i]; };
  std::size_t best = 0;
  if (is_box) {
    // The smallest rectangle around a polygon lies along one of its edges (Freeman and Shapira 1975).
    double least = 1e300;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec3 x = math::unit(edge(i), glm::dvec3(1, 0, 0)), y = glm::cross(normal, x);
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
  } else if (word(2) == "longest") {
    for (std::size_t i = 1; i < corners.size(); ++i) {
      if (glm::length(edge(i)) > glm::length(edge(best)) * (1 + 1e-9)) best = i;
    }
  } else {
    best = number_of(word(2), corners.size());
  }
  glm::dvec3 along = edge(best);
  along = math::unit(along - normal * glm::dot(along, normal), axes[0]);
  reframe(state, axes_with(up, normal, along));
}

/// setupProjection(0, scope.xy, ~2, 1.5, 0, 0): what u and v will be. It waits until projectUV.
void Deriver::setup_projection(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  if (number(a[0].value) != 0) reject(a[0].value.offset, "there is one set of texture coordinates, number 0");
  const std::string& word = grammar_.words[a[1].word];
  const std::size_t dot = word.find('.');
  const std::string frame = word.substr(0, dot),
                    letters = dot == std::string::npos ? "" : word.substr(dot + 1);
  const bool is_sound = (frame == "scope" || frame == "world") && letters.size() == 2 &&
                        letters[0] != letters[1] && letters[0] >= 'x' && letters[0] <= 'z' &&
                        letters[1] >= 'x' && letters[1] <= 'z';
  if (!is_sound)
    reject(step.offset, "found " + lang::in_quotes(word) + ", expected scope.xy, world.xz and their like");
  const glm::dmat3 axes = frame == "scope" ? out_.axes[state.axes] : glm::dmat3(1);
  const glm::dvec3 origin = frame == "scope" ? state.origin : glm::dvec3(0);
  Projection made;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const int axis = letters[i] - 'x';
    const Argument& size = a[2 + i];
    const double whole = frame == "scope" ? state.size[axis] : 1;
    double tile = number(size.value);
    if (size.measure == Measure::relative) tile *= whole;
    if (!(tile > 0)) reject(size.value.offset, "the size of a tile is above 0");
    if (size.measure == Measure::floating && whole > 0)
      tile = whole / std::max(1.0, std::floor(whole / tile + 0.5));
    const double shift = 4 + i < step.argument_count ? number(a[4 + i].value) : 0;
    glm::dvec3& along = i == 0 ? made.u : made.v;
    along = axes[axis] / tile;
    (i == 0 ? made.u_at : made.v_at) = shift / tile - glm::dot(along, origin);
  }
  out_.projections.push_back(made);
  job_.spend(Resource::shapes, 1);
  Style style = out_.styles[state.style];
  style.projection_set_up = static_cast<std::uint32_t>(out_.projections.size());
  state.style = style_with(style);
}

/// projectUV(0): from here on shapes have the coordinates that were set up.
void Deriver::project_uv(const Step& step, State& state) {
  if (number(grammar_.arguments[step.first_argument].value) != 0)
    reject(step.offset, "there is one set of texture coordinates, number 0");
  Style style = out_.styles[state.style];
  if (style.projection_set_up == 0)
    reject(step.offset, "projectUV has nothing to project: no setupProjection came before");
  style.projection = style.projection_set_up;
  state.style = style_with(style);
}

/// The state with an axis along u or v, and how many metres along it are 1 of the split's unit.
Deriver::State Deriver::along_texture(const Step& step, const State& state, int& axis, double& unit) {
  const bool is_u = step.axis == axis_u;
  const Style& style = out_.styles[state.style];
  const std::uint32_t place = style.projection != 0 ? style.projection : style.projection_set_up;
  const glm::dmat3 axes = out_.axes[state.axes];
  const glm::dvec3 gradient = place != 0
                                  ? (is_u ? out_.projections[place - 1].u : out_.projections[place - 1].v)
                                  : axes[is_u ? 0 : 1];
  glm::dvec3 along = gradient;
  const int flat = dimension(state.size) == 2 ? flat_axis(state.size) : -1;
  if (flat >= 0) along -= axes[flat] * glm::dot(axes[flat], along);
  const double steep = glm::length(along);
  if (!(steep > 1e-9))
    reject(step.offset, "the shape lies across the texture space, so that u or v is the same all over it");
  along /= steep;
  unit = step.in_metres ? 1 : 1 / steep;
  for (axis = 0; axis < 3; ++axis) {
    if (glm::dot(axes[axis], along) > 1 - 1e-12) return state;
  }
  State turned = state;
  glm::dvec3 z = flat >= 0 ? axes[flat] : glm::cross(along, glm::dvec3(0, 1, 0));
  if (glm::dot(z, z) < 1e-6) z = glm::cross(along, glm::dvec3(1, 0, 0));
  z = math::unit(z - along * glm::dot(z, along), glm::dvec3(0, 0, 1));
  reframe(turned, {along, glm::cross(z, along), z});
  axis = 0;
  return turned;
}

}  // namespace seedmesh::building
