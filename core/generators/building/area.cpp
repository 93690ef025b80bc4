/// Operations that measure areas: splits into cells of so many square metres, and rectangles inside a face.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/generators/building/deriver.h"
#include "core/generators/building/inner_rectangle.h"

namespace seedmesh::building {

/// splitArea(x){ 20: A | ~1: B }: cells as of a split whose whole is the area; where to cut is found by
/// halving, since the area below a cut only grows.
void Deriver::split_area(const Step& step, const State& state, const Frame& frame, std::uint64_t key) {
  if (dimension(state.size) != 2 || (state.geometry & asset_bit) != 0)
    reject(step.offset, "splitArea takes a face");
  const int axis = step.axis;
  const double whole = state.size[axis], all = area(state);
  if (!(whole > 0)) {
    warn(step.offset, "the shape has no size along the axis of this split, so that nothing comes of it");
    return;
  }
  std::vector<Cut> cuts = cuts_of(step, all);
  if (state.geometry == box_geometry) {
    for (Cut& each : cuts) each = {each.start / all * whole, each.size / all * whole, each.part};
  } else {
    const Solid& solid = out_.solid_of(state.geometry);
    const auto place_of_area = [&](double wanted) {
      if (wanted <= 1e-9 * all) return 0.0;
      if (wanted >= all * (1 - 1e-9)) return whole;
      double low = 0, high = 1;
      for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (area_of(clipped(solid, axis, middle, 1), state.size) < wanted ? low : high) = middle;
      }
      job_.check();
      return 0.5 * (low + high) * whole;
    };
    for (Cut& each : cuts) {
      const double from = place_of_area(each.start), to = place_of_area(each.start + each.size);
      each = {from, to - from, each.part};
    }
  }
  pieces(step, state, frame, key, cuts, axis);
}

/// innerRectangle(scope){ shape: A | remainder: B }: the largest rectangle inside a face, and what is left of
/// it beside, below and above.
void Deriver::inner_rectangle(const Step& step, const State& given, const Frame& frame, std::uint64_t key) {
  if (dimension(given.size) != 2 || (given.geometry & asset_bit) != 0)
    reject(step.offset, "innerRectangle takes a face");
  const std::string word =
      step.argument_count > 0 ? grammar_.words[grammar_.arguments[step.first_argument].word] : "scope";
  if (word != "scope" && word != "edge")
    reject(step.offset, "found " + lang::in_quotes(word) + ", expected scope or edge");
  State state = given;
  InnerRectangle best;
  const auto look = [&](const State& each) {
    const int w = flat_axis(each.size), u = (w + 1) % 3, v = (w + 2) % 3;
    const Solid solid = solid_of(each);
    InnerRectangle most;
    for (const Face& face : solid.faces) {
      std::vector<std::vector<glm::dvec2>> rings;
      for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
        std::vector<glm::dvec2>& ring = rings.emplace_back();
        for (std::uint32_t i = 0; i < solid.loops[l].count; ++i) {
          const glm::dvec3 p = solid.points[solid.corners[solid.loops[l].first + i]] * each.size;
          ring.emplace_back(p[u], p[v]);
        }
      }
      const InnerRectangle own = seedmesh::building::inner_rectangle(rings, job_);
      if (own.area() > most.area()) most = own;
    }
    return most;
  };
  if (word == "scope") {
    best = look(state);
  } else {
    const int w = flat_axis(given.size);
    const glm::dmat3 axes = out_.axes[given.axes];
    const Solid solid = solid_of(given);
    double longest = 0;
    std::vector<glm::dvec3> edges;
    for (const Loop& loop : solid.loops) {
      for (std::uint32_t i = 0; i < loop.count; ++i) {
        const glm::dvec3 a = solid.points[solid.corners[loop.first + i]],
                         b = solid.points[solid.corners[loop.first + (i + 1) % loop.count]];
        edges.push_back((b - a) * given.size);
        longest = std::max(longest, glm::length(edges.back()));
      }
    }
    for (const glm::dvec3& edge : edges) {
      if (glm::length(edge) < 0.25 * longest) continue;
      State turned = given;
      glm::dmat3 own(1);
      own[w] = axes[w];
      own[(w + 1) % 3] = axes * (edge / glm::length(edge));
      own[(w + 2) % 3] = glm::cross(own[w], own[(w + 1) % 3]);
      reframe(turned, own);
      const InnerRectangle found = look(turned);
      if (found.area() <= best.area() * (1 + 1e-9)) continue;
      best = found;
      state = turned;
    }
  }
  if (!(best.area() > 0)) return;
  Frame own = frame;
  const int w = flat_axis(state.size), u = (w + 1) % 3, v = (w + 2) % 3;
  std::uint64_t place = 0;
  for (std::uint32_t p = 0; p < step.part_count; ++p) {
    const Part& part = grammar_.parts[step.first_part + p];
    std::vector<State> made;
    if (!part.is_remainder) {
      State piece = state;
      glm::dvec3 at(0);
      at[u] = best.low.x;
      at[v] = best.low.y;
      piece.origin += out_.axes[state.axes] * at;
      piece.size[u] = best.high.x - best.low.x;
      piece.size[v] = best.high.y - best.low.y;
      piece.geometry = box_geometry;
      made.push_back(piece);
    } else {
      const Solid whole = solid_of(state);
      const auto add = [&](Solid rest) {
        if (rest.faces.empty()) return;
        glm::dvec3 from, extent;
        fit(rest, from, extent);
        State piece = state;
        piece.origin += out_.axes[state.axes] * (from * state.size);
        piece.size = extent * state.size;
        if (dimension(piece.size) != 2) return;
        piece.geometry = add_solid(std::move(rest));
        made.push_back(piece);
      };
      const auto cut = [&](const Solid& solid, int axis, double at, double sign) {
        const double share = at / state.size[axis];
        if (sign > 0 && share <= 1e-9) return Solid{};
        if (sign < 0 && share >= 1 - 1e-9) return Solid{};
        return clipped(solid, axis, share, sign);
      };
      const Solid right = best.low.x > 1e-9 * state.size[u] ? cut(whole, u, best.low.x, -1) : whole;
      const Solid middle = best.high.x < (1 - 1e-9) * state.size[u] ? cut(right, u, best.high.x, 1) : right;
      add(cut(whole, u, best.low.x, 1));
      add(cut(middle, v, best.low.y, 1));
      add(cut(middle, v, best.high.y, -1));
      add(cut(whole, u, best.high.x, -1));
    }
    for (std::uint32_t i = 0; i < made.size(); ++i) {
      made[i].comp_index = i;
      made[i].comp_total = static_cast<std::uint32_t>(made.size());
      own.key = key_at(key, place++);
      run_body(part.body, made[i], own);
    }
  }
}

}  // namespace seedmesh::building
