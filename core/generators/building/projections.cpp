#include "core/generators/building/projections.h"

#include <algorithm>

namespace seedmesh::building {

std::uint32_t projection_id(const Derivation& d, const ShapeState& state, int set, bool is_applied) {
  const Style& style = d.out.styles[state.style];
  if (set == 0) return is_applied ? style.projection : style.projection_set_up;
  const UvSets& sets = d.out.uv_sets[style.uv_sets];
  const auto at = static_cast<std::size_t>(set - 1);
  return is_applied ? sets.applied[at] : sets.set_up[at];
}

void set_projection_id(Derivation& d, ShapeState& state, int set, bool is_applied, std::uint32_t id) {
  Style style = d.out.styles[state.style];
  if (set == 0) {
    (is_applied ? style.projection : style.projection_set_up) = id;
  } else {
    UvSets sets = d.out.uv_sets[style.uv_sets];
    const auto at = static_cast<std::size_t>(set - 1);
    (is_applied ? sets.applied : sets.set_up)[at] = id;
    const auto [found, is_new] =
        d.uv_set_ids.try_emplace(sets, static_cast<std::uint32_t>(d.out.uv_sets.size()));
    if (is_new) {
      d.job.spend(Resource::shapes, 1);
      d.out.uv_sets.push_back(sets);
    }
    style.uv_sets = found->second;
  }
  state.style = style_with(d, style);
}

std::uint32_t add_projection(Derivation& d, const Projection& projection) {
  d.job.spend(Resource::shapes, 1);
  d.out.projections.push_back(projection);
  return static_cast<std::uint32_t>(d.out.projections.size());
}

bool has_projection(const Derivation& d, const ShapeState& state, int set) {
  return projection_id(d, state, set, true) != 0 || projection_id(d, state, set, false) != 0;
}

Projection projection_of(const Derivation& d, const ShapeState& state, int set) {
  std::uint32_t id = projection_id(d, state, set, true);
  if (id == 0) id = projection_id(d, state, set, false);
  if (id != 0) return d.out.projections[id - 1];
  const glm::dmat3& axes = d.out.axes[state.axes];
  const int flat = dimension(state.size) == 2 ? flat_axis(state.size) : 2;
  Projection made;
  made.u = flat == 0 ? -axes[2] : axes[0];
  made.v = flat == 1 ? -axes[2] : axes[1];
  const glm::dvec3 corner = state.origin + (flat == 1   ? axes[2] * state.size.z
                                            : flat == 0 ? axes[2] * state.size.z
                                                        : glm::dvec3(0));
  made.u_at = -glm::dot(made.u, corner);
  made.v_at = -glm::dot(made.v, corner);
  return made;
}

void use_projection(Derivation& d, ShapeState& state, int set, const Projection& projection) {
  set_projection_id(d, state, set, true, add_projection(d, projection));
}

UvRange uv_range(const Derivation& d, const ShapeState& state, int set) {
  const Projection projection = projection_of(d, state, set);
  const glm::dmat3& axes = d.out.axes[state.axes];
  UvRange range;
  const auto add = [&](const glm::dvec3& share, bool is_first) {
    const glm::dvec3 p = state.origin + axes * (share * state.size);
    const std::array<double, 2> uv{glm::dot(projection.u, p) + projection.u_at,
                                   glm::dot(projection.v, p) + projection.v_at};
    for (std::size_t i = 0; i < 2; ++i) {
      range.low[i] = is_first ? uv[i] : std::min(range.low[i], uv[i]);
      range.high[i] = is_first ? uv[i] : std::max(range.high[i], uv[i]);
    }
  };
  if (state.has_solid()) {
    bool is_first = true;
    for (const glm::dvec3& p : d.out.solid_of(state.geometry).points) {
      add(p, is_first);
      is_first = false;
    }
  } else {
    for (int corner = 0; corner < 8; ++corner)
      add(glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1), corner == 0);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    glm::dvec3 along = i == 0 ? projection.u : projection.v;
    if (dimension(state.size) == 2) {
      const glm::dvec3 normal = axes[flat_axis(state.size)];
      along -= normal * glm::dot(normal, along);
    }
    const double steep = glm::length(along);
    range.metres[i] = steep > 1e-12 ? 1 / steep : 0;
  }
  return range;
}

}  // namespace seedmesh::building
