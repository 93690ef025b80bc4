/// Properties of the material of a shape, and materials as arrays of names and values; see value_functions.h.
#include <algorithm>

#include "core/generators/building/value_functions.h"
#include "core/schema/color.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;

const Style& style_of(const Evaluation& at) { return at.d.out.styles[at.d.seen->style]; }

Color color_seen(const Evaluation& at) {
  const std::string* const text = at.d.out.texts.find(style_of(at).color);
  return (text == nullptr ? std::nullopt : color_of(text->substr(0, 7))).value_or(Color{255, 255, 255});
}
TaggedValue red(Evaluation& at, ValueArguments) { return number_value(color_seen(at).red / 255.0); }
TaggedValue green(Evaluation& at, ValueArguments) { return number_value(color_seen(at).green / 255.0); }
TaggedValue blue(Evaluation& at, ValueArguments) { return number_value(color_seen(at).blue / 255.0); }
TaggedValue color_text(Evaluation& at, ValueArguments) { return text_value(at, text_of(color_seen(at))); }
TaggedValue opacity(Evaluation& at, ValueArguments) {
  const std::string* const text = at.d.out.texts.find(style_of(at).color);
  if (text == nullptr || text->size() != 9) return number_value(1);
  const auto alpha = color_of("#0000" + text->substr(7));
  return number_value(alpha ? alpha->blue / 255.0 : 1);
}
TaggedValue material_name(Evaluation& at, ValueArguments) {
  const std::string* const text = at.d.out.texts.find(style_of(at).material);
  return text_value(at, text == nullptr ? std::string() : *text);
}

void add_row(Evaluation& at, ValueArray& rows, std::string_view name, const std::string& value) {
  rows.values.push_back(text_value(at, name));
  rows.values.push_back(text_value(at, value));
}

/// Rows of a name and a value, those of attributes that were set: their order is that of CityEngine.
TaggedValue get_material(Evaluation& at, ValueArguments a) {
  const bool is_all = a.size() > 1 && text_in(at, a[1]) == "all";
  ValueArray out;
  out.columns = 2;
  if (is_all || style_of(at).color != 0) {
    const Color color = color_seen(at);
    add_row(at, out, "color.b", text_of_number(color.blue / 255.0));
    add_row(at, out, "color.g", text_of_number(color.green / 255.0));
    add_row(at, out, "color.r", text_of_number(color.red / 255.0));
    add_row(at, out, "opacity", text_of_number(opacity(at, {}).number));
  }
  if (is_all || style_of(at).material != 0) add_row(at, out, "name", text_in(at, material_name(at, {})));
  return array_value(at, std::move(out));
}

/// A file of a material: the material of the request with the name of the file.
TaggedValue read_material(Evaluation& at, ValueArguments a) {
  const std::string path = text_in(at, a[0]);
  std::string name = path.substr(path.find_last_of('/') + 1);
  name = name.substr(0, name.find_last_of('.'));
  if (!std::ranges::binary_search(at.d.task.files, name)) {
    warn(at.d, at.offset,
         "the request has no material " + lang::in_quotes(name) + ", which would replace " +
             lang::in_quotes(path) + "; shapes have the plain material of this name");
  }
  ValueArray out;
  out.columns = 2;
  add_row(at, out, "name", name);
  return array_value(at, std::move(out));
}

/// Attributes of materials that the model does not have: always as CityEngine begins with them.
TaggedValue nothing(Evaluation&, ValueArguments) { return number_value(0); }
TaggedValue whole(Evaluation&, ValueArguments) { return number_value(1); }
TaggedValue no_map(Evaluation& at, ValueArguments) { return text_value(at, ""); }

#define SEEDMESH_UNUSED(name, value, number)                                                     \
  {                                                                                              \
    name, 0, 0, value, "",                                                                       \
        number ". `set` has no effect on it; `materials` of the request define the appearance.", \
        "A --> print(" name ") B."                                                               \
  }
constexpr ValueFunctionRow rows[] = {
    SEEDMESH_UNUSED("material.ambient.r", nothing, "0"),
    SEEDMESH_UNUSED("material.ambient.g", nothing, "0"),
    SEEDMESH_UNUSED("material.ambient.b", nothing, "0"),
    SEEDMESH_UNUSED("material.specular.r", nothing, "0"),
    SEEDMESH_UNUSED("material.specular.g", nothing, "0"),
    SEEDMESH_UNUSED("material.specular.b", nothing, "0"),
    SEEDMESH_UNUSED("material.emissive.r", nothing, "0"),
    SEEDMESH_UNUSED("material.emissive.g", nothing, "0"),
    SEEDMESH_UNUSED("material.emissive.b", nothing, "0"),
    SEEDMESH_UNUSED("material.shininess", nothing, "0"),
    SEEDMESH_UNUSED("material.reflectivity", nothing, "0"),
    SEEDMESH_UNUSED("material.bumpValue", nothing, "0"),
    SEEDMESH_UNUSED("material.metallic", nothing, "0"),
    SEEDMESH_UNUSED("material.roughness", whole, "1"),
    SEEDMESH_UNUSED("material.bumpmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.dirtmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.specularmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.opacitymap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.normalmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.emissivemap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.occlusionmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.roughnessmap", no_map, "The empty text"),
    SEEDMESH_UNUSED("material.metallicmap", no_map, "The empty text"),
    {"material.color.r", 0, 0, red, "", "The red channel of the colour, from 0 to 1.",
     "A --> report(\"x\", material.color.r) B."},
    {"material.color.g", 0, 0, green, "", "The green channel.", "A --> report(\"x\", material.color.g) B."},
    {"material.color.b", 0, 0, blue, "", "The blue channel.", "A --> report(\"x\", material.color.b) B."},
    {"material.color.a", 0, 0, opacity, "", "The opacity.", "A --> report(\"x\", material.color.a) B."},
    {"material.color.rgb", 0, 0, color_text, "", "The colour as \"#rrggbb\".",
     "A --> color(material.color.rgb) B."},
    {"material.color", 0, 0, color_text, "", "The colour as \"#rrggbb\".", "A --> color(material.color) B."},
    {"material.opacity", 0, 0, opacity, "", "The opacity.", "A --> report(\"x\", material.opacity) B."},
    {"material.name", 0, 0, material_name, "", "The name of the material.",
     "A --> label(\"m\" + material.name) B."},
    {"material.colormap", 0, 0, material_name, "", "The name of the material, which stands for its image.",
     "A --> label(\"m\" + material.colormap) B."},
    {"getMaterial", 0, 2, get_material, "used | shape | geometry, changed | all",
     "The colour, opacity and name of the material as an array with rows of a name and a value.",
     "A --> color(\"#ff0000\") report(\"rows\", nRows(getMaterial(used, changed))) B."},
    {"readMaterial", 1, 1, read_material, "path",
     "The material of the request that has the name of the file, as such an array.",
     "A --> setMaterial(readMaterial(\"walls/brick.cgamat\")) B."},
};
#undef SEEDMESH_UNUSED

}  // namespace

std::span<const ValueFunctionRow> material_functions() { return rows; }

}  // namespace seedmesh::building
