#include "core/generators/building/derivation.h"

#include <algorithm>
#include <charconv>

namespace seedmesh::building {
namespace {

constexpr std::uint64_t most_corners = 20'000'000;  ///< corners of all solids of a request
constexpr double flat_share = 1e-9;                 ///< a smaller share of the largest size is rounding

}  // namespace

Derivation::Derivation(const Task& given, const FirstPassIndex* first, Job& own_job)
    : task(given),
      grammar(*given.grammar),
      first_pass(first),
      job(own_job),
      meter(own_job),
      out(own_job),
      squares{square(0), square(1), square(2)},
      edits(given.edits) {
  slots.assign(grammar.first_parameter_slot + grammar.most_parameters + 1, {});
  for (const AssetBox& asset : task.assets) out.asset_names.push_back(asset.name);
  style_ids.emplace(Style{}, 0);
  part_option_ids.emplace(PartOptions{}, 0);
  out.texts = *task.texts;
  // The first edge of a lot in CityEngine runs along x at its front, as that of the top of a mass does here.
  auto& corners = squares[1].corners;
  if (grammar.is_cityengine) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
}

std::string text_of_number(double number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() ? std::string(text.data(), end) : std::string();
}

void reject(const Derivation& d, std::uint32_t offset, const std::string& message) {
  if (d.guarded_steps > 0) throw StepError{offset, message};
  d.job.refuse(issue_in_rules(d.task, IssueKind::evaluation, offset, message));
}

void warn(Derivation& d, std::uint32_t offset, const std::string& message) {
  if (d.warned.size() >= 100 || std::ranges::find(d.warned, offset) != d.warned.end()) return;
  d.warned.push_back(offset);
  const Issue issue = issue_in_rules(d.task, IssueKind::evaluation, offset, message);
  d.out.warnings.push_back({issue.pointer, issue.message, issue.line, issue.column});
}

std::uint32_t add_axes(Derivation& d, const glm::dmat3& axes) {
  d.out.axes.push_back(axes);
  return static_cast<std::uint32_t>(d.out.axes.size()) - 1;
}

std::uint32_t add_solid(Derivation& d, Solid solid) {
  d.solid_corners += solid.corners.size();
  if (d.solid_corners > most_corners) {
    d.job.refuse(limit_issue(
        {Resource::vertices, most_corners, d.solid_corners},
        "the solids that the rules cut and make have more than " + std::to_string(most_corners) + " corners",
        d.task.is_blueprint ? "/blueprint" : "/rules"));
  }
  d.out.solids.push_back(std::make_unique<const Solid>(std::move(solid)));
  return static_cast<std::uint32_t>(d.out.solids.size());
}

std::uint32_t style_with(Derivation& d, Style style) {
  const auto [found, is_new] =
      d.style_ids.try_emplace(style, static_cast<std::uint32_t>(d.out.styles.size()));
  if (is_new) d.out.styles.push_back(style);
  return found->second;
}

void edit_shape(Derivation& d, std::uint32_t index) {
  Shape& shape = d.out.shapes[index];
  const ShapeEdit* const edit = d.edits.visit(index, shape.parent, shape.symbol);
  d.out.symbols_before_edits.erase(index);  // of a shape that was taken back
  if (edit == nullptr) return;
  if (edit->is_removed) {
    shape.is_active = false;
    shape.is_leaf = true;
    d.out.has_removed_shape = true;
    return;
  }
  if (!edit->attributes.empty()) {
    Style style = d.out.styles[shape.style];
    std::vector<lang::TaggedValue> values = d.out.attribute_sets[style.attributes];
    for (const auto& [attribute, value] : edit->attributes)
      values[d.grammar.attributes[attribute].slot - d.grammar.first_attribute_slot] = value;
    const auto [set, is_new] =
        d.attribute_set_ids.try_emplace(values, static_cast<std::uint32_t>(d.out.attribute_sets.size()));
    if (is_new) d.out.attribute_sets.push_back(std::move(values));
    style.attributes = set->second;
    shape.style = style_with(d, style);
  }
  if (!edit->rule) return;
  d.out.symbols_before_edits.emplace(index, shape.symbol);
  shape.symbol = *edit->rule;
  shape.is_leaf = false;
}

double area_of(const Derivation& d, const ShapeState& state) {
  const glm::dvec3& s = state.size;
  if (!state.has_solid()) {
    if (s.x == 0) return s.y * s.z;
    if (s.y == 0) return s.x * s.z;
    if (s.z == 0) return s.x * s.y;
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
  }
  return area_of(d.out.solid_of(state.geometry), s);
}

double volume_of(const Derivation& d, const ShapeState& state) {
  if (!state.has_solid()) return state.size.x * state.size.y * state.size.z;
  return volume_of(d.out.solid_of(state.geometry), state.size);
}

const Solid& flat_solid(const Derivation& d, const ShapeState& state) {
  if (state.geometry == box_geometry) return d.squares[static_cast<std::size_t>(flat_axis(state.size))];
  return d.out.solid_of(state.geometry);
}

Solid solid_of(const Derivation& d, const ShapeState& state) {
  if (state.geometry != box_geometry) return d.out.solid_of(state.geometry);
  return dimension(state.size) == 3 ? unit_box() : flat_solid(d, state);
}

void take_solid(Derivation& d, ShapeState& state, Solid solid) {
  glm::dvec3 low, extent;
  fit(solid, low, extent);
  state.origin += d.out.axes[state.axes] * low;
  state.size = extent;
  state.geometry = add_solid(d, std::move(solid));
}

void reframe(Derivation& d, ShapeState& state, const glm::dmat3& axes) {
  if (state.has_asset() || dimension(state.size) < 2) return;
  const glm::dmat3 before = d.out.axes[state.axes], back = glm::transpose(axes) * before;
  Solid solid = solid_of(d, state);
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
  state.axes = add_axes(d, axes);
  state.size = size;
  // A box that fills its new scope stays a box.
  const bool fills = was_box && std::ranges::all_of(solid.points, [](const glm::dvec3& p) {
                       for (int axis = 0; axis < 3; ++axis) {
                         if (p[axis] > 1e-9 && p[axis] < 1 - 1e-9) return false;
                       }
                       return true;
                     });
  state.geometry = fills ? box_geometry : add_solid(d, std::move(solid));
}

}  // namespace seedmesh::building
