/// Operations that give a shape other geometry.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/containment.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/raised_solids.h"
#include "core/texture/rooms.h"

namespace seedmesh::building {

void make_prism_of(Derivation& d, ShapeState& state, int axis) {
  const auto [found, is_new] = d.raised_solids.try_emplace({state.geometry, axis}, none);
  if (is_new) found->second = add_solid(d, extruded(d.out.solid_of(state.geometry), axis));
  state.geometry = found->second;
}

void make_pyramid_of(Derivation& d, ShapeState& state, int axis) {
  const auto [found, is_new] = d.raised_solids.try_emplace({state.geometry, axis + 3}, none);
  if (is_new) found->second = add_solid(d, tapered(flat_solid(d, state), axis));
  state.geometry = found->second;
}

namespace {

/// Every name that i() accepts, for a message.
std::string part_names() {
  std::string names = "cube, cylinder, cone, sphere, pyramid, prism, triangular_prism";
  for (const PartRow& row : part_rows()) {
    if (names.find(row.name) == std::string::npos) names += ", " + std::string(row.name);
  }
  return names;
}

/// The geometry of a built-in solid that can be cut; none for other names.
std::uint32_t named_solid(Derivation& d, std::string_view name) {
  struct Named {
    std::string_view name;
    Solid (*make)();
  };
  static constexpr Named bodies[] = {{"cylinder", cylinder}, {"pyramid", pyramid},
                                     {"prism", frustum},     {"triangular_prism", triangular_prism},
                                     {"sphere", sphere},     {"cone", cone}};
  if (name == "cube" || name == "box") return box_geometry;
  const auto found = d.named_solids.find(name);
  if (found != d.named_solids.end()) return found->second;
  for (const Named& body : bodies) {
    if (body.name != name) continue;
    const std::uint32_t made = add_solid(d, body.make());
    d.named_solids.emplace(std::string(name), made);
    return made;
  }
  return none;
}

/// Whether a name is that of a file, which the request may not have.
bool is_path(std::string_view name) {
  const std::size_t dot = name.find_last_of('.');
  return name.find('/') != std::string_view::npos || name.find('\\') != std::string_view::npos ||
         (dot != std::string_view::npos && dot + 2 < name.size() && name.size() - dot <= 5);
}

/// A name without directories, "builtin:" and ending.
std::string stem_of(std::string name) {
  if (name.starts_with("builtin:")) {
    name = name.substr(8, name.find(':', 8) - 8);
    return name == "notfound" ? "cube" : name;
  }
  if (const std::size_t slash = name.find_last_of("/\\"); slash != std::string::npos)
    name = name.substr(slash + 1);
  if (const std::size_t dot = name.find('.'); dot != std::string::npos) name.resize(dot);
  return name;
}

/// What i() puts into a scope: geometry, and the box that it has without a scope.
struct Insert {
  std::uint32_t geometry = none;
  glm::dvec3 low{0}, size{1};
};

Insert insert_named(Derivation& d, const Step& step, const std::string& given) {
  Insert insert;
  const std::string name = stem_of(given);
  for (std::size_t i = 0; i < d.task.assets.size(); ++i) {
    // Solids that can be cut come before parts that cannot, and after the assets of the request.
    if (i == d.task.own_assets && (insert.geometry = named_solid(d, name)) != none) return insert;
    const AssetBox& asset = d.task.assets[i];
    if (asset.name == name) return {asset_bit | static_cast<std::uint32_t>(i), asset.low, asset.size};
  }
  if (is_path(given) || given.empty()) {
    // As in CityEngine, a plain body replaces an asset that is missing.
    warn(d, step.offset,
         "the request has no asset " + lang::in_quotes(name) + " for " + lang::in_quotes(given) +
             "; a box stands for it: give the model in \"assets\"");
    insert.geometry = box_geometry;
    return insert;
  }
  reject(d, step.offset,
         "there is no part " + lang::in_quotes(name) + ": neither an asset of the request nor one of " +
             part_names());
}

/// The options of a part: i("stairs", 12), i("window", 6, 0.08), i("tower", 0, 0, 60).
std::uint32_t options_of(Derivation& d, const Step& step) {
  const Argument* a = &d.grammar.arguments[step.first_argument];
  PartOptions options;
  if (step.op == Op::insert_along_uv || (step.argument_count > 1 && a[1].word != none)) return 0;
  const auto given = [&](std::uint32_t i, double most, const char* what) {
    if (i >= step.argument_count) return 0.0;
    const lang::TaggedValue given_value = evaluate(d, a[i].value);
    if (!given_value.is_text() && given_value.number >= 0 && given_value.number <= most)
      return given_value.number;
    reject(d, a[i].value.offset,
           "found " +
               (given_value.is_text() ? "the text " + lang::in_quotes(*d.out.texts.find(given_value.text))
                                      : text_of_number(given_value.number)) +
               " for " + what + ", expected a number from 0 (by the size) to " + text_of_number(most));
  };
  options.count = math::to_int32(given(1, 1'000, "the count of a part"));
  options.frame = given(2, 10, "the frame of a part");
  options.angle = math::radians(given(3, 85, "the angle of a part"));
  options.room = math::to_int32(given(4, texture::room_count - 1, "the room behind a window"));
  const auto [found, is_new] =
      d.part_option_ids.try_emplace(options, static_cast<std::uint32_t>(d.out.part_options.size()));
  if (is_new) d.out.part_options.push_back(options);
  return found->second;
}

/// The words of i() in CityEngine: how the asset is placed.
struct InsertWords {
  bool are_given = false;
  bool keep_size = false;
  bool keep_position = false;
};

InsertWords insert_words(Derivation& d, const Step& step) {
  InsertWords words;
  for (std::uint32_t i = 1; i < step.argument_count; ++i) {
    if (!is_word(d, step, i)) continue;
    words.are_given = true;
    const std::string& word = word_at(d, step, i);
    if (word == "zUp") {
      warn(d, step.offset, "`zUp` has no effect: assets have y up");
    } else if (word == "keepSizeAndPosition" || word == "keepSizeAlignPosition") {
      words.keep_size = true;
      words.keep_position = word == "keepSizeAndPosition";
    } else if (word != "yUp" && word != "alignSizeAndPosition" && word != "adjustSizeAndPosition") {
      reject(d, step.offset,
             "found " + lang::in_quotes(word) +
                 ", expected yUp, zUp, alignSizeAndPosition, keepSizeAndPosition or keepSizeAlignPosition");
    }
  }
  return words;
}

/// Sizes of 0 follow from the others, by the formulas of the CGA reference (insert).
void insert_geometry(Derivation& d, const Step& step, ShapeState& state, const std::string& name) {
  const Insert found = insert_named(d, step, name);
  const auto& [geometry, low, own] = found;
  const bool is_part = (geometry & asset_bit) != 0 && (geometry & ~asset_bit) >= d.task.own_assets;
  const InsertWords words = step.op != Op::insert_along_uv ? insert_words(d, step) : InsertWords{};
  if (step.argument_count > 1 && !is_part && !words.are_given && step.op != Op::insert_along_uv) {
    warn(d, step.offset,
         "the numbers after " + lang::in_quotes(name) + " have no effect: only built-in parts have options");
  }
  const int given = dimension(state.size);
  glm::dvec3 size = state.size;
  if (given == 0 || words.keep_size) {
    size = own;
    if (!words.keep_size || words.keep_position) state.origin += d.out.axes[state.axes] * low;
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
  const std::uint32_t options = (geometry & asset_bit) != 0 ? options_of(d, step) : 0;
  if (options == d.out.styles[state.style].options) return;
  Style style = d.out.styles[state.style];
  style.options = options;
  state.style = style_with(d, style);
}

}  // namespace

void insert_named_geometry(Derivation& d, const Step& step, ShapeState& state, const std::string& name) {
  insert_geometry(d, step, state, name);
}

namespace operators {

void extrude(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const bool has_word = is_word(d, step, 0);
  const std::string direction = has_word ? word_at(d, step, 0) : std::string("face.normal");
  if (has_word && step.argument_count < 2)
    reject(d, step.offset, "extrude takes (direction, height), found no height");
  const double height = number_or(d, step, has_word ? 1 : 0, 0);
  if (state.has_asset() || dimension(state.size) < 2) return;
  if (height == 0) return;
  if (dimension(state.size) == 3) {
    const bool is_box = state.geometry == box_geometry || d.out.solid_of(state.geometry).is_closed;
    if (is_box) {
      warn(d, step.offset,
           "extrude finds a closed solid, and extrudes each of its faces; use comp(f) to choose one");
    }
    return extrude_in(d, step, state,
                      is_box     ? "face.normal"
                      : has_word ? direction
                                 : "vertex.normal",
                      height);
  }
  if (has_word) {
    const glm::dvec3 normal = d.out.axes[state.axes][flat_axis(state.size)];
    const bool is_normal =
        direction == "face.normal" || direction == "vertex.normal" ||
        ((direction == "world.up" || direction == "world.up.flatTop" || direction == "world.y") &&
         normal.y > 1 - 1e-12);
    if (!is_normal) return extrude_in(d, step, state, direction, height);
  }
  if (height == 0) return;
  const int axis = flat_axis(state.size);
  if (state.geometry != box_geometry) make_prism_of(d, state, axis);
  if (height < 0) state.origin += d.out.axes[state.axes][axis] * height;
  state.size[axis] = std::abs(height);
}

void taper(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const double height = number_of(d, d.grammar.arguments[step.first_argument].value);
  if (dimension(state.size) != 2 || state.has_asset()) {
    reject(d, step.offset,
           "found a shape of " + std::to_string(dimension(state.size)) +
               " dimensions, expected a face for taper");
  }
  if (!(height > 0)) {
    reject(d, step.offset,
           "found a height of " + text_of_number(height) + " for taper, expected a number above 0");
  }
  const int axis = flat_axis(state.size);
  make_pyramid_of(d, state, axis);
  state.size[axis] = height;
}

void insert(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  const std::string name = text_of(d, d.grammar.arguments[step.first_argument]);
  insert_geometry(d, step, state, name);
}

void place(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  ShapeState placed = state;
  const std::string name = text_of(d, d.grammar.arguments[step.first_argument]);
  insert_geometry(d, step, placed, name);
  check_containment(d, site.frame.shape, placed, step.offset);
  add_leaf(d, placed, site.frame, site.key, d.out.shapes[site.frame.shape].symbol);
}

}  // namespace operators

}  // namespace seedmesh::building
