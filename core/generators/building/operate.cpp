/// Operations on the scope, on geometry as a whole, and on what shapes inherit.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/deriver.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/turned.h"
#include "core/schema/color.h"

namespace seedmesh::building {
namespace {

constexpr std::uint64_t most_corners = 20'000'000;  ///< of all solids of a request

/// For the message: every name that i() knows.
std::string part_names() {
  std::string names = "cube, cylinder, cone, sphere, pyramid, prism, triangular_prism";
  for (const PartRow& row : part_rows()) {
    if (names.find(row.name) == std::string::npos) names += ", " + std::string(row.name);
  }
  return names;
}

std::string channel(double value) {
  constexpr char digits[] = "0123456789abcdef";
  const int byte = math::to_int32(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
  return {digits[byte >> 4], digits[byte & 15]};
}

}  // namespace

std::uint32_t Deriver::add_axes(const glm::dmat3& axes) {
  out_.axes.push_back(axes);
  return static_cast<std::uint32_t>(out_.axes.size()) - 1;
}

std::uint32_t Deriver::add_solid(Solid solid) {
  solid_corners_ += solid.corners.size();
  if (solid_corners_ > most_corners)
    Job::refuse("cut and made solids have more than " + std::to_string(most_corners) + " corners",
                plan_.is_blueprint ? "/blueprint" : "/rules");
  out_.solids.push_back(std::make_unique<const Solid>(std::move(solid)));
  return static_cast<std::uint32_t>(out_.solids.size());
}

std::uint32_t Deriver::style_with(Style style) {
  const auto [found, is_new] = styles_.try_emplace(style, static_cast<std::uint32_t>(out_.styles.size()));
  if (is_new) out_.styles.push_back(style);
  return found->second;
}

double Deriver::area(const State& state) const {
  const glm::dvec3& s = state.size;
  if (state.geometry == box_geometry || (state.geometry & asset_bit) != 0) {
    if (s.x == 0) return s.y * s.z;
    if (s.y == 0) return s.x * s.z;
    if (s.z == 0) return s.x * s.y;
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
  }
  return area_of(out_.solid_of(state.geometry), s);
}

double Deriver::volume(const State& state) const {
  if (state.geometry == box_geometry || (state.geometry & asset_bit) != 0)
    return state.size.x * state.size.y * state.size.z;
  return volume_of(out_.solid_of(state.geometry), state.size);
}

void Deriver::translate(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  glm::dvec3 by(0);
  for (int axis = 0; axis < 3; ++axis) by[axis] = length(a[axis], state.size[axis]);
  state.origin += out_.axes[state.axes] * by;
}

void Deriver::resize(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  glm::dvec3 size(0);
  for (int axis = 0; axis < 3; ++axis) size[axis] = length(a[axis], state.size[axis]);
  unsigned mirror = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] >= 0) continue;
    state.origin += out_.axes[state.axes][axis] * size[axis];
    size[axis] = -size[axis];
    mirror |= 1U << static_cast<unsigned>(axis);
  }
  // A polygon that gets a height is a prism, as a rectangle that gets one is a box.
  const int flat = flat_axis(state.size);
  const bool is_own = state.geometry != box_geometry && (state.geometry & asset_bit) == 0;
  if (is_own && dimension(state.size) == 2 && size[flat] != 0) state.geometry = prism_over(state, flat);
  if (mirror != 0 && state.geometry != box_geometry && (state.geometry & asset_bit) == 0)
    state.geometry = add_solid(mirrored(out_.solid_of(state.geometry), mirror));
  state.size = size;
}

void Deriver::rotate(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  glm::dmat3 m(1);
  for (int axis = 0; axis < 3; ++axis) {
    const double angle = number(a[axis].value);
    if (angle != 0) m = turned(axis, angle) * m;
  }
  const glm::dmat3 before = out_.axes[state.axes];
  glm::dvec3 pivot(0);
  if (step.argument_count > 3) {
    const std::string& word = grammar_.words[a[3].word];
    if (word == "scopeCenter")
      pivot = 0.5 * state.size;
    else if (word != "scopeOrigin")
      reject(step.offset, "found the centre \"" + word + "\", expected scopeOrigin or scopeCenter");
  }
  const glm::dmat3 after = before * m;
  state.origin += before * pivot - after * pivot;
  state.axes = add_axes(after);
}

void Deriver::center(const Step& step, State& state, const Frame& frame) {
  const State& whole = frame.before;
  const glm::dmat3 axes = out_.axes[whole.axes];
  const glm::dvec3 middle = whole.origin + axes * (0.5 * whole.size);
  const glm::dvec3 own = state.origin + out_.axes[state.axes] * (0.5 * state.size);
  const glm::dvec3 by = glm::transpose(axes) * (middle - own);
  for (int axis = 0; axis < 3; ++axis) {
    if ((step.axis >> axis & 1) != 0) state.origin += axes[axis] * by[axis];
  }
}

void Deriver::mirror(State& state) {
  glm::dmat3 axes = out_.axes[state.axes];
  state.origin += axes[0] * state.size.x + axes[2] * state.size.z;
  axes[0] = -axes[0];
  axes[2] = -axes[2];
  state.axes = add_axes(axes);
  if (state.geometry != box_geometry && (state.geometry & asset_bit) == 0) {
    Solid turned = out_.solid_of(state.geometry);
    for (glm::dvec3& p : turned.points)
      p = {state.size.x > 0 ? 1 - p.x : 0, p.y, state.size.z > 0 ? 1 - p.z : 0};
    state.geometry = add_solid(std::move(turned));
  }
}

/// The flat geometry of a state as a solid.
const Solid& Deriver::flat_solid(const State& state) {
  if (state.geometry == box_geometry) return squares_[static_cast<std::size_t>(flat_axis(state.size))];
  return out_.solid_of(state.geometry);
}

/// The prism over a flat polygon, made once.
std::uint32_t Deriver::prism_over(const State& state, int axis) {
  const auto [found, is_new] = made_solids_.try_emplace({state.geometry, axis}, none);
  if (is_new) found->second = add_solid(extruded(out_.solid_of(state.geometry), axis));
  return found->second;
}

void Deriver::extrude(const Step& step, State& state) {
  const double height = number(grammar_.arguments[step.first_argument].value);
  if (dimension(state.size) != 2 || (state.geometry & asset_bit) != 0) {
    if (dimension(state.size) == 3)
      reject(step.offset, "extrude takes a face, found a solid; use comp(f) first, or s with a height of 0");
    return;
  }
  if (height == 0) return;
  const int axis = flat_axis(state.size);
  if (state.geometry != box_geometry) state.geometry = prism_over(state, axis);
  if (height < 0) state.origin += out_.axes[state.axes][axis] * height;
  state.size[axis] = std::abs(height);
}

void Deriver::taper(const Step& step, State& state) {
  const double height = number(grammar_.arguments[step.first_argument].value);
  if (dimension(state.size) != 2 || (state.geometry & asset_bit) != 0)
    reject(step.offset,
           "taper takes a face, found a shape of " + std::to_string(dimension(state.size)) + " dimensions");
  if (!(height > 0)) reject(step.offset, "the height of taper is not above 0");
  const int axis = flat_axis(state.size);
  const auto [found, is_new] = made_solids_.try_emplace({state.geometry, axis + 3}, none);
  if (is_new) found->second = add_solid(tapered(flat_solid(state), axis));
  state.geometry = found->second;
  state.size[axis] = height;
}

std::uint32_t Deriver::named_solid(std::string_view name) {
  struct Named {
    std::string_view name;
    Solid (*make)();
  };
  static constexpr Named bodies[] = {{"cylinder", cylinder}, {"pyramid", pyramid},
                                     {"prism", prism},       {"triangular_prism", triangular_prism},
                                     {"sphere", sphere},     {"cone", cone}};
  if (name == "cube" || name == "box") return box_geometry;
  const auto found = named_.find(name);
  if (found != named_.end()) return found->second;
  for (const Named& body : bodies) {
    if (body.name != name) continue;
    const std::uint32_t made = add_solid(body.make());
    named_.emplace(std::string(name), made);
    return made;
  }
  return none;
}

/// Sizes of 0 follow from the others: the formulas of the CGA reference (insert).
void Deriver::insert(const Step& step, State& state) {
  std::string name = text(grammar_.arguments[step.first_argument]);
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) name.resize(dot);
  glm::dvec3 own(1), low(0);
  std::uint32_t geometry = none;
  const std::size_t given_assets = plan_.own_assets;
  for (std::size_t i = 0; i < plan_.assets.size() && geometry == none; ++i) {
    // Bodies that can be cut come before parts that cannot, and after what the request brings.
    if (i == given_assets && (geometry = named_solid(name)) != none) break;
    if (plan_.assets[i].name != name) continue;
    geometry = asset_bit | static_cast<std::uint32_t>(i);
    own = plan_.assets[i].size;
    low = plan_.assets[i].low;
  }
  if (geometry == none)
    reject(step.offset, "there is no part " + lang::in_quotes(name) +
                            ": neither an asset of the request nor one of " + part_names());
  const bool is_part = (geometry & asset_bit) != 0 && (geometry & ~asset_bit) >= given_assets;
  if (step.argument_count > 1 && !is_part)
    warn(step.offset, lang::in_quotes(name) + " is no part that is made for its size: the numbers behind " +
                          "its name have no effect");
  const int given = dimension(state.size);
  glm::dvec3 size = state.size;
  if (given == 0) {
    size = own;
    state.origin += out_.axes[state.axes] * low;
  } else if (given < 3) {
    double scale = 0;
    for (int axis = 0; axis < 3; ++axis)
      scale += size[axis] != 0 && own[axis] > 0 ? size[axis] / own[axis] : 0;
    scale /= given;
    for (int axis = 0; axis < 3; ++axis) {
      if (size[axis] == 0) size[axis] = scale * own[axis];
    }
  }
  state.size = size;
  state.geometry = geometry;
  state.roof_up = no_roof;
  const std::uint32_t options = (geometry & asset_bit) != 0 ? options_of(step) : 0;
  if (options == out_.styles[state.style].options) return;
  Style style = out_.styles[state.style];
  style.options = options;
  state.style = style_with(style);
}

/// i("stairs", 12), i("window", 6, 0.08), i("tower", 0, 0, 60): what can be turned about a part.
std::uint32_t Deriver::options_of(const Step& step) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  PartOptions options;
  const auto given = [&](std::uint32_t i, double most, const char* what) {
    if (i >= step.argument_count) return 0.0;
    const double given_value = value(a[i].value);
    if (given_value >= 0 && given_value <= most) return given_value;
    const std::string* const word = out_.texts.of(given_value);
    reject(a[i].value.offset,
           std::string(what) + " lies between 0 (by the size) and " + text_of_number(most) + ", found " +
               (word != nullptr ? "the text " + lang::in_quotes(*word) : text_of_number(given_value)));
  };
  options.count = math::to_int32(given(1, 1'000, "the count of a part"));
  options.frame = given(2, 10, "the frame of a part");
  options.angle = math::radians(given(3, 85, "the angle of a part"));
  const auto [found, is_new] =
      part_options_.try_emplace(options, static_cast<std::uint32_t>(out_.part_options.size()));
  if (is_new) out_.part_options.push_back(options);
  return found->second;
}

void Deriver::color(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  Style style = out_.styles[state.style];
  if (step.op == Op::label) {
    style.label = text_number(a[0]);
  } else if (step.op == Op::material) {
    style.material = text_number(a[0]);
  } else if (step.argument_count == 3) {
    std::string code = "#";
    for (int i = 0; i < 3; ++i) code += channel(number(a[i].value));
    style.color = out_.texts.number_of(code);
  } else {
    const std::string& code = text(a[0]);
    if (!color_of(code))
      reject(a[0].value.offset, "found " + lang::in_quotes(code) + ", expected a colour as \"#rrggbb\"");
    style.color = text_number(a[0]);
  }
  state.style = style_with(style);
}

void Deriver::set(const Step& step, State& state) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  const std::string& name = grammar_.words[a[0].word];
  Style style = out_.styles[state.style];
  if (name == "material.name" || name == "material.color") {
    const double given = text_number(a[1]);
    if (name == "material.color" && !color_of(*out_.texts.of(given)))
      reject(a[1].value.offset,
             "found " + lang::in_quotes(*out_.texts.of(given)) + ", expected a colour as \"#rrggbb\"");
    (name == "material.name" ? style.material : style.color) = given;
  } else {
    const auto found = std::ranges::find(grammar_.attributes, name, &Attribute::name);
    if (found == grammar_.attributes.end() || found->is_constant)
      reject(step.offset, "there is no attribute \"" + name + "\" that could be set");
    double given = value(a[1].value);
    if (out_.texts.of(given) == nullptr) given = number(a[1].value);
    std::vector<double> values = out_.attribute_sets[style.attributes];
    values[found->slot - grammar_.first_attribute_slot] = given;
    const auto [set, is_new] =
        attribute_sets_.try_emplace(values, static_cast<std::uint32_t>(out_.attribute_sets.size()));
    if (is_new) {
      job_.spend(Resource::shapes, 1 + values.size() / 16);
      out_.attribute_sets.push_back(std::move(values));
    }
    style.attributes = set->second;
  }
  state.style = style_with(style);
}

void Deriver::report(const Step& step) {
  const Argument* a = &grammar_.arguments[step.first_argument];
  const std::string& key = text(a[0]);
  const double amount = step.argument_count > 1 ? number(a[1].value) : 1;
  if (out_.reports.size() >= 10'000 && !out_.reports.contains(key))
    reject(step.offset, "more than 10,000 keys of reports");
  Report& report = out_.reports[key];
  report.least = report.count == 0 ? amount : std::min(report.least, amount);
  report.greatest = report.count == 0 ? amount : std::max(report.greatest, amount);
  ++report.count;
  report.sum += amount;
}

void Deriver::snap(const Step& step, const State& state) {
  const glm::dmat3 axes = out_.axes[state.axes];
  for (int axis = 0; axis < 3; ++axis) {
    if ((step.axis >> axis & 1) == 0 || snaps_.size() >= 10'000) continue;
    for (const double at : {0.0, state.size[axis]}) {
      const double distance = glm::dot(axes[axis], state.origin) + at;
      snaps_.push_back({axes[axis], distance});
    }
  }
}

}  // namespace seedmesh::building
