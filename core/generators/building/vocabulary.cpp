/// The words of the rules, for GET /v1/vocabulary: operations, and what is no operation.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/generators/building/blueprints/blueprints.h"
#include "core/generators/building/building.h"
#include "core/generators/building/materials.h"
#include "core/generators/building/operations.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/syntax.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

struct WordRow {
  std::string_view kind, name, text, example;
};

constexpr WordRow words[] = {
    {"keyword", "attr", "Declares an attribute, which a request can set.", "attr height = 9  A --> B."},
    {"keyword", "const", "Declares a constant.", "const w = 2  A --> s(w, '1, '1) B."},
    {"keyword", "case", "Begins a successor with a condition; the first one that holds is chosen.",
     "A --> case scope.sx > 3: B. else: C."},
    {"keyword", "else", "The successor if no case holds, or for the rest of percentages.",
     "A --> 30%: B. else: C."},
    {"keyword", "NIL", "Removes the shape.", "A --> comp(f){ side: B. | all: NIL }"},
    {"keyword", "import", "Makes the rules and values of another file of the request known with a prefix.",
     "A --> B."},
    {"keyword", "start", "Marks the start rule; the name `start` means it.", "B --> C.  start A --> B"},
    {"keyword", "extension", "Marks a rule that an import can redefine.", "extension A --> B."},
    {"keyword", "style", "Begins declarations that `start` selects as Modern$Lot.",
     "attr w = 1  A --> B.  style Modern  attr w = 2"},
    {"keyword", "version", "The version of the language, which has no effect.",
     "version \"2025.0\"  A --> B."},
    {"keyword", "with", "Values that a successor reads: with (name := value).",
     "A --> with (w := 2) s(w, '1, '1) B."},
    {"keyword", "PRIORITY",
     "The rules behind it come before those with higher numbers, in derivations with single steps.",
     "PRIORITY 1: A ~> B  PRIORITY 2: B ~> C."},
    {"keyword", "byHeight", "The height of a roof instead of its angle.",
     "A --> s('1, 0, '1) roofGable(byHeight(3), 0.4) B."},
    {"keyword", "byAngle", "The angle of a roof; the same as the angle alone.",
     "A --> s('1, 0, '1) roofHip(byAngle(30)) B."},
    {"annotation", "@Range", "The least and the greatest value of an attribute.",
     "@Range(1, 9) attr floors = 3  A --> B."},
    {"annotation", "@Enum", "The values that an attribute can have.",
     "@Enum(\"old\", \"new\") attr style = \"old\"  A --> B."},
    {"annotation", "@StartRule", "The rule behind it is the start rule.", "B --> C.  @StartRule A --> B"},
    {"annotation", "@KeepScopes",
     "Scopes of raised faces keep the axes of the face, as in rules without version.",
     "@StartRule @KeepScopes A --> extrude(3) B."},
    {"annotation", "@Group", "The group of an attribute in a form.", "@Group(\"Size\") attr w = 1  A --> B."},
    {"annotation", "@Order", "The position of an attribute in a form.", "@Order(2) attr w = 1  A --> B."},
    {"annotation", "@Hidden", "A form does not show the attribute.", "@Hidden attr w = 1  A --> B."},
    {"annotation", "@Description", "The text of an attribute in a form.",
     "@Description(\"Metres.\") attr w = 1  A --> B."},
    {"annotation", "@Color", "The attribute is a colour.", "@Color attr c = \"#aabbcc\"  A --> color(c) B."},
    {"selector", "eave", "Level edges at which a slope begins.",
     "A --> s('1, 0, '1) roofHip(30) comp(e){ eave: B. }"},
    {"selector", "hip", "Sloping edges that begin at an eave.",
     "A --> s('1, 0, '1) roofHip(30) comp(e){ hip: B. }"},
    {"selector", "ridge", "Edges between slopes that touch no eave.",
     "A --> s('1, 0, '0.5) roofHip(30) comp(e){ ridge: B. }"},
    {"selector", "valley", "Edges between slopes that turn inwards.",
     "A --> s('1, 0, '1) roofHip(30) comp(e){ valley: B. | all: C. }"},
    {"selector", "world.south", "Faces towards +z of the world; also north, east, west, up, down and side.",
     "A --> comp(f){ world.south: B. }"},
    {"selector", "object.front", "Faces in the direction of +z of the first shape.",
     "A --> comp(f){ object.front: B. }"},
    {"selector", "street.front", "The same faces as front, because lots of a request have no streets.",
     "A --> comp(f){ street.front: B. }"},
    {"selector", "front", "Faces in the direction of +z of the scope.", "A --> comp(f){ front: B. }"},
    {"selector", "back", "Faces in the direction of -z.", "A --> comp(f){ back: B. }"},
    {"selector", "left", "Faces in the direction of -x.", "A --> comp(f){ left: B. }"},
    {"selector", "right", "Faces in the direction of +x.", "A --> comp(f){ right: B. }"},
    {"selector", "top", "Faces that face up; for roofs, along +y of the world.", "A --> comp(f){ top: B. }"},
    {"selector", "bottom", "Faces that face down.", "A --> comp(f){ bottom: B. }"},
    {"selector", "side", "Faces that face neither up nor down.", "A --> comp(f){ side: B. }"},
    {"selector", "all", "All faces that no selector has taken yet.", "A --> comp(f){ all: B. }"},
    {"selector", "horizontal", "Faces within 11.25 degrees of horizontal.",
     "A --> comp(f){ horizontal: B. }"},
    {"selector", "aslant", "Sloping faces that face up.",
     "A --> s('1, 0, '1) roofHip(30) comp(f){ aslant: B. }"},
    {"selector", "vertical", "Faces within 11.25 degrees of vertical.", "A --> comp(f){ vertical: B. }"},
    {"selector", "nutant", "Sloping faces that face down.",
     "A --> i(\"pyramid\") s('1, '-1, '1) comp(f){ nutant: B. | all: C. }"},
    {"selector", "inside", "The faces inside an offset.",
     "A --> s('1, 0, '1) offset(-1) comp(f){ inside: B. }"},
    {"selector", "border", "The faces between the old and the new border of an offset.",
     "A --> s('1, 0, '1) offset(-1) comp(f){ border: B. }"},
    {"selector", "remainder", "The faces or cells that no other selector takes.",
     "A --> s('1, 0, '1) setback(1){ front: B. | remainder: C. }"},
    {"selector", "shape", "The shape that shapeL, shapeU, shapeO and innerRectangle make.",
     "A --> s('1, 0, '1) shapeL(1, 1){ shape: B. }"},
    {"attribute", "scope.sx", "Size along x; also scope.sy and scope.sz.",
     "A --> s(scope.sx / 2, '1, '1) B."},
    {"attribute", "scope.tx", "Position along x of the world; also scope.ty and scope.tz.",
     "A --> case scope.tx < 0: B. else: C."},
    {"attribute", "split.index", "Number of the piece in its split, from 0.",
     "A --> split(x){ ~2: case split.index == 0: B. else: C. }*"},
    {"attribute", "split.total", "Number of pieces of the split.",
     "A --> split(x){ ~2: case split.index == split.total - 1: B. else: C. }*"},
    {"attribute", "comp.index", "Number of the component in its selector, from 0.",
     "A --> comp(f){ side: case comp.index == 0: B. else: C. }"},
    {"attribute", "comp.total", "Number of components of the selector.",
     "A --> comp(f){ side: report(\"sides\", comp.total) B. }"},
    {"attribute", "geometry.area", "Area of all faces in square metres.",
     "A --> report(\"area\", geometry.area) B."},
    {"attribute", "geometry.volume", "Volume in cubic metres; 0 if the geometry is not closed.",
     "A --> report(\"volume\", geometry.volume) B."},
    {"attribute", "shape.depth", "Number of ancestors of the shape.",
     "A --> case shape.depth < 3: B. else: C."},
    {"attribute", "lod",
     "Declare an attribute of this name for levels of detail: output.lods runs the rules again with the "
     "value increased by 1, 2 and so on.",
     "@Range(0, 2) attr lod = 0  A --> case lod > 0: B. else: split(x){ ~1: C. }*"},
    {"query", "Shape.occ",
     "\"none\", \"part\" or \"full\": how far other closed shapes cover the shape. The target is \"all\", "
     "\"noparent\", \"active\" or a name.",
     "A --> case Shape.occ(\"noparent\") == \"none\": B. else: C."},
    {"query", "Scope.occ", "As Shape.occ.", "A --> case Scope.occ(\"all\") == \"none\": B. else: C."},
    {"query", "Shape.visible", "Whether the shortest line to the nearest shape of a name is free.",
     "A --> case Shape.visible(\"Street\"): B. else: C."},
    {"query", "overlaps", "Whether another closed shape overlaps it.", "A --> case overlaps(): B. else: C."},
    {"query", "inside", "Whether it lies inside another closed shape.", "A --> case inside(): B. else: C."},
    {"query", "touches", "Whether it touches another closed shape.", "A --> case touches(): B. else: C."},
};

/// The number of arguments, from least to most.
std::pair<int, int> arity_of(std::string_view arguments) {
  const std::size_t bar = arguments.find('|');
  if (bar == std::string_view::npos)
    return {static_cast<int>(arguments.size()), static_cast<int>(arguments.size())};
  return {static_cast<int>(bar), static_cast<int>(arguments.size()) - 1};
}

/// The attributes of a blueprint that have a range or a list of values.
Json attributes_of(const Blueprint& blueprint) {
  std::vector<lang::TextError> errors;  // none: tests read every blueprint
  const RuleText text = rule_text(blueprint.rules);
  const Grammar grammar = read_rules(text, "", errors);
  std::vector<Json> rows;
  for (const Attribute& attribute : grammar.attributes) {
    if (attribute.is_hidden || (!attribute.has_range && attribute.choices.empty())) continue;
    Json row = {{"name", attribute.name}};
    if (attribute.has_range) {
      row["minimum"] = attribute.low;
      row["maximum"] = attribute.high;
    }
    for (const lang::TaggedValue& value : attribute.choices) {
      const std::string* const word = grammar.texts.find(value.text);
      row["values"].push_back(word != nullptr ? Json(*word) : Json(value.number));
    }
    rows.push_back(std::move(row));
  }
  std::sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) { return a["name"] < b["name"]; });
  return Json(std::move(rows));
}

}  // namespace

Json vocabulary() {
  Json operation_rows = Json::array();
  for (const OperationRow& row : operations()) {
    const auto [least, most] = arity_of(row.arguments);
    operation_rows.push_back({{"kind", kind_of(row.op)},
                              {"name", row.name},
                              {"parameters", row.parameters},
                              {"arity", least},
                              {"most", most},
                              {"status", text_of(row.status)},
                              {"text", row.text},
                              {"example", row.example}});
  }
  Json word_rows = Json::array();
  for (const WordRow& row : words) {
    word_rows.push_back({{"kind", row.kind},
                         {"name", row.name},
                         {"text", row.text},
                         {"example", row.example},
                         {"status", "done"}});
  }
  for (std::uint32_t i = 0; i < value_function_count(); ++i) {
    const ValueFunctionRow& row = value_function(i);
    const bool is_error = row.example.empty();
    word_rows.push_back(
        {{"kind", row.most == 0 && row.name.find('.') != std::string_view::npos ? "attribute" : "function"},
         {"name", row.name},
         {"parameters", row.parameters},
         {"text", row.text},
         {"example", row.example},
         {"status", text_of(is_error ? Status::error : Status::done)}});
  }
  Json parts = Json::array();
  for (const PartRow& row : part_rows()) {
    parts.push_back({{"kind", "part"},
                     {"name", row.name},
                     {"text", row.text},
                     {"example", "A --> i(\"" + std::string(row.name) + "\")"}});
  }
  Json materials = Json::array();
  for (const std::string_view name : built_in_materials()) materials.push_back(name);
  Json blueprint_rows = Json::array();
  for (const Blueprint& blueprint : blueprints()) {
    blueprint_rows.push_back(
        {{"kind", "blueprint"}, {"name", blueprint.name}, {"attributes", attributes_of(blueprint)}});
  }
  return {{"building_blueprints", std::move(blueprint_rows)},
          {"building_operations", std::move(operation_rows)},
          {"building_words", std::move(word_rows)},
          {"building_parts", std::move(parts)},
          {"building_materials", std::move(materials)}};
}

}  // namespace seedmesh::building
