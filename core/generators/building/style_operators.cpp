/// Operations on what shapes inherit (colour, material, attributes, texture space), reports and snap lines.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/projections.h"
#include "core/generators/building/shape_grammar/rotation.h"
#include "core/generators/building/value_functions.h"
#include "core/schema/color.h"

namespace seedmesh::building::operators {
namespace {

std::string channel(double value) {
  constexpr char digits[] = "0123456789abcdef";
  const int byte = math::to_int32(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
  return {digits[byte >> 4], digits[byte & 15]};
}

bool is_code(const std::string& code) {
  const bool has_opacity = code.size() == 9 && color_of("#0000" + code.substr(7));
  return color_of(has_opacity ? code.substr(0, 7) : code).has_value();
}

/// The text of a colour such as "#aa8866". Names of CSS and codes without the sign become such texts.
std::uint32_t color_id_of(Derivation& d, std::uint32_t offset, std::uint32_t id) {
  const std::string code = *d.out.texts.find(id);
  if (is_code(code)) return id;
  if (is_code("#" + code)) return d.out.texts.id_of("#" + code);
  std::string name = code;
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (const std::optional<Color> named = color_named(name)) return d.out.texts.id_of(text_of(*named));
  reject(d, offset, "found " + lang::in_quotes(code) + ", expected a colour as \"#rrggbb\" or a name of CSS");
}
std::uint32_t color_id_of(Derivation& d, const Argument& argument) {
  return color_id_of(d, argument.value.offset, text_id_of(d, argument));
}

/// The channel of the colour that an attribute of the material is; 4 for other attributes.
std::size_t channel_named(std::string_view name) {
  constexpr std::string_view names[] = {"color.r", "color.g", "color.b", "color.a"};
  const auto* found = std::ranges::find(names, name == "opacity" ? "color.a" : name);
  return static_cast<std::size_t>(found - std::begin(names));
}

void set_channel(Derivation& d, std::size_t at, double value, Style& style) {
  const std::string* const before = d.out.texts.find(style.color);
  std::string code = before == nullptr ? "#ffffff" : *before;
  if (code.size() == 7) code += "ff";
  code.replace(1 + 2 * at, 2, channel(value));
  style.color = d.out.texts.id_of(code.ends_with("ff") ? code.substr(0, 7) : code);
}

/// set(material.colormap, "brick.jpg"): the image of a material. Other maps have no counterpart.
void set_map(Derivation& d, const Step& step, ShapeState& state, const std::string& name,
             const std::string& path) {
  if (name == "colormap" || name == "map") {
    use_image(d, step, state, path);
  } else {
    warn(d, step.offset,
         "setting " + lang::in_quotes("material." + name) +
             " has no effect here: materials of the request have the other images");
  }
}

/// An attribute of the material by its name without `material.`, whose value is a text.
void set_by_text(Derivation& d, const Step& step, ShapeState& state, const std::string& name,
                 std::uint32_t id) {
  Style style = d.out.styles[state.style];
  if (name == "name") {
    style.material = id;
  } else if (name == "color" || name == "color.rgb" || name == "color.rgba") {
    style.color = color_id_of(d, step.offset, id);
  } else if (name.ends_with("map")) {
    const std::string path = *d.out.texts.find(id);  // a copy: the image can add texts
    return set_map(d, step, state, name, path);
  } else {
    warn(d, step.offset, "setting " + lang::in_quotes("material." + name) + " has no effect here");
  }
  state.style = style_with(d, style);
}

/// set(material.NAME, value).
void set_of_material(Derivation& d, const Step& step, ShapeState& state, const std::string& name,
                     const Argument& argument) {
  const std::size_t channel = channel_named(name);
  if (channel < 4) {
    Style style = d.out.styles[state.style];
    set_channel(d, channel, number_of(d, argument.value), style);
    state.style = style_with(d, style);
  } else if (name == "name" || name.ends_with("map") || name == "color" || name.starts_with("color.rgb")) {
    set_by_text(d, step, state, name, text_id_of(d, argument));
  } else {
    evaluate(d, argument.value);
    warn(d, step.offset, "setting " + lang::in_quotes("material." + name) + " has no effect here");
  }
}

/// 0 to 8 for scope.tx, ..., scope.rx, ..., scope.sx, ...; -1 for other names.
int scope_member(std::string_view name) {
  if (name.size() != 8 || !name.starts_with("scope.") || name[7] < 'x' || name[7] > 'z') return -1;
  const std::size_t group = std::string_view("trs").find(name[6]);
  return group == std::string_view::npos ? -1 : static_cast<int>(3 * group) + name[7] - 'x';
}

void set_scope(Derivation& d, ShapeState& state, int member, double value) {
  const int axis = member % 3;
  if (member < 3) {
    state.origin[axis] = value;
  } else if (member < 6) {
    glm::dvec3 angles(0);
    angles[axis] = value;
    state.axes = add_axes(d, rotation_xyz(angles));
  } else {
    state.size[axis] = std::abs(value);
  }
}

/// Attributes of CityEngine that serve other renderers, other shapes or trimming.
bool has_no_effect(std::string_view name) {
  return name.starts_with("trim.") || name.starts_with("pivot.") || name.starts_with("initialShape.") ||
         name == "seedian";
}

}  // namespace

void style(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  Style style = d.out.styles[state.style];
  if (step.op == Op::label) {
    style.label = text_id_of(d, a[0]);
  } else if (step.op == Op::material) {
    style.material = text_id_of(d, a[0]);
  } else if (step.argument_count >= 3) {
    std::string code = "#";
    for (std::uint32_t i = 0; i < 3; ++i) code += channel(number_of(d, a[i].value));
    if (step.argument_count == 4) code += channel(number_of(d, a[3].value));
    if (code.size() == 9 && code.ends_with("ff")) code.resize(7);
    style.color = d.out.texts.id_of(code);
  } else {
    style.color = color_id_of(d, a[0]);
  }
  state.style = style_with(d, style);
}

void set(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const std::string& name = d.grammar.words[a[0].word];
  if (name.starts_with("material.")) {
    set_of_material(d, step, state, name.substr(9), a[1]);
  } else if (const int scope = scope_member(name); scope >= 0) {
    set_scope(d, state, scope, number_of(d, a[1].value));
  } else if (has_no_effect(name)) {
    evaluate(d, a[1].value);
    warn(d, step.offset, "setting " + lang::in_quotes(name) + " has no effect here");
  } else {
    Style style = d.out.styles[state.style];
    const auto found = std::ranges::find(d.grammar.attributes, name, &Attribute::name);
    if (d.grammar.attributes.end() == found || found->is_constant) {
      reject(d, step.offset,
             "found " + lang::in_quotes(name) + " in set, expected an attribute of the rules");
    }
    std::vector<lang::TaggedValue> values = d.out.attribute_sets[style.attributes];
    values[found->slot - d.grammar.first_attribute_slot] = number_or_text(d, a[1].value);
    const auto [set, is_new] =
        d.attribute_set_ids.try_emplace(values, static_cast<std::uint32_t>(d.out.attribute_sets.size()));
    if (is_new) {
      d.job.spend(Resource::shapes, 1 + values.size() / 16);
      d.out.attribute_sets.push_back(std::move(values));
    }
    style.attributes = set->second;
    state.style = style_with(d, style);
  }
}

/// setupProjection(0, scope.xy, ~2, 1.5, 0, 0): the u and v that projectUV will use.
void setup_projection(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const int set = uv_set_at(d, step, 0);
  const std::string& word = d.grammar.words[a[1].word];
  const std::size_t dot = word.find('.');
  const std::string frame = word.substr(0, dot),
                    letters = dot == std::string::npos ? "" : word.substr(dot + 1);
  const bool is_valid = (frame == "scope" || frame == "world") && letters.size() == 2 &&
                        letters[0] != letters[1] && letters[0] >= 'x' && letters[0] <= 'z' &&
                        letters[1] >= 'x' && letters[1] <= 'z';
  if (!is_valid) {
    reject(d, step.offset,
           "found " + lang::in_quotes(word) + ", expected scope or world with two axes, as in scope.xy");
  }
  const glm::dmat3 axes = frame == "scope" ? d.out.axes[state.axes] : glm::dmat3(1);
  const glm::dvec3 origin = frame == "scope" ? state.origin : glm::dvec3(0);
  Projection made;
  for (std::uint32_t i = 0; i < 2; ++i) {
    const int axis = letters[i] - 'x';
    const Argument& size = a[2 + i];
    const double whole = frame == "scope" ? state.size[axis] : 1;
    double tile = number_of(d, size.value);
    if (size.measure == Measure::relative) tile *= whole;
    if (!(tile > 0))
      reject(d, size.value.offset, "found a tile of " + text_of_number(tile) + " m, expected a size above 0");
    if (size.measure == Measure::floating && whole > 0)
      tile = whole / std::max(1.0, std::floor(whole / tile + 0.5));
    const double shift = 4 + i < step.argument_count ? number_of(d, a[4 + i].value) : 0;
    glm::dvec3& along = i == 0 ? made.u : made.v;
    along = axes[axis] / tile;
    (i == 0 ? made.u_at : made.v_at) = shift / tile - glm::dot(along, origin);
  }
  if (step.argument_count > 6) {
    const int third = 3 - (letters[0] - 'x') - (letters[1] - 'x');
    const double factor = number_of(d, a[6].value);
    const glm::dvec3 more = axes[third] * (factor * glm::length(made.u));
    made.u += more;
    made.u_at -= glm::dot(more, origin);
  }
  set_projection_id(d, state, set, false, add_projection(d, made));
}

/// projectUV(0): from here on shapes have the texture coordinates of the last setupProjection.
void project_uv(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const int set = uv_set_at(d, step, 0);
  const std::uint32_t id = projection_id(d, state, set, false);
  if (id == 0) {
    warn(d, step.offset, "projectUV has no effect without a setupProjection of its set before it");
    return;
  }
  set_projection_id(d, state, set, true, id);
}

void reset_material(Derivation& d, const Step&, ShapeState& state, const StepContext&) {
  Style style = d.out.styles[state.style];
  style.color = style.material = 0;
  state.style = style_with(d, style);
}

/// setMaterial("brick"), or an array of names and values as getMaterial and readMaterial return it.
void set_material(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const Argument& argument = argument_at(d, step, 0);
  const lang::TaggedValue value = argument.word == none ? evaluate(d, argument.value) : lang::TaggedValue{};
  if (!is_array(value)) {
    Style style = d.out.styles[state.style];
    style.material = d.out.texts.id_of(word_at(d, step, 0));
    state.style = style_with(d, style);
    return;
  }
  const Evaluation at{d, step.offset};
  const std::vector<lang::TaggedValue> values = array_in(at, value).values;
  for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
    const std::string name = text_in(at, values[i]);
    const std::string text = text_in(at, values[i + 1]);
    const std::size_t channel = channel_named(name);
    if (channel < 4) {
      double number = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
      if (error != std::errc() || end != text.data() + text.size())
        reject(d, step.offset, "found " + lang::in_quotes(text) + " for " + name + ", expected a number");
      Style style = d.out.styles[state.style];
      set_channel(d, channel, number, style);
      state.style = style_with(d, style);
    } else {
      set_by_text(d, step, state, name, d.out.texts.id_of(text));
    }
  }
}

void print(Derivation& d, const Step& step, ShapeState&, const StepContext&) {
  const Argument& argument = argument_at(d, step, 0);
  if (argument.word != none) return warn(d, step.offset, "print: " + d.grammar.words[argument.word]);
  const Evaluation at{d, step.offset};
  warn(d, step.offset, "print: " + text_in(at, evaluate(d, argument.value)));
}

void report(Derivation& d, const Step& step, ShapeState&, const StepContext&) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const std::string key = text_of(d, a[0]);  // a copy: the value can add texts
  double amount = 1;
  if (step.argument_count > 1 && a[1].word == none) {
    const lang::TaggedValue value = evaluate(d, a[1].value);
    // Texts are counted. Numbers that are not finite are rejected as elsewhere.
    if (!value.is_text()) amount = std::isfinite(value.number) ? value.number : number_of(d, a[1].value);
  }
  if (d.out.reports.size() >= 10'000 && !d.out.reports.contains(key))
    reject(d, step.offset, "the rules report under more than 10,000 keys");
  Report& report = d.out.reports[key];
  report.least = report.count == 0 ? amount : std::min(report.least, amount);
  report.greatest = report.count == 0 ? amount : std::max(report.greatest, amount);
  ++report.count;
  report.sum += amount;
}

void snap(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const glm::dmat3 axes = d.out.axes[state.axes];
  for (int axis = 0; axis < 3; ++axis) {
    if ((step.axis >> axis & 1) == 0 || d.snap_planes.size() >= 10'000) continue;
    for (const double at : {0.0, state.size[axis]}) {
      const double distance = glm::dot(axes[axis], state.origin) + at;
      d.snap_planes.push_back({axes[axis], distance});
    }
  }
}

}  // namespace seedmesh::building::operators
