/// The words of the rules, for GET /v1/vocabulary: operations, and what is no operation.
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/generators/building/looks.h"
#include "core/generators/building/operations.h"
#include "core/generators/building/parts/parts.h"

namespace seedmesh::building {
namespace {

struct WordRow {
  std::string_view kind, name, text, example;
};

constexpr WordRow words[] = {
    {"keyword", "attr", "Declares an attribute, which a request may set.", "attr height = 9  A --> B."},
    {"keyword", "const", "Declares a constant.", "const w = 2  A --> s(w, '1, '1) B."},
    {"keyword", "case", "Begins a successor with a condition; the first that holds is taken.",
     "A --> case scope.sx > 3: B. else: C."},
    {"keyword", "else", "What is taken where no case holds, or what is left of percentages.",
     "A --> 30%: B. else: C."},
    {"keyword", "NIL", "The shape is taken away.", "A --> comp(f){ side: B. | all: NIL }"},
    {"keyword", "PRIORITY", "Rules behind it come before those of a higher number, where steps are seen.",
     "PRIORITY 1: A ~> B  PRIORITY 2: B ~> C."},
    {"keyword", "byHeight", "In place of the angle of a roof: how high its highest point is.",
     "A --> s('1, 0, '1) roofGable(byHeight(3), 0.4) B."},
    {"keyword", "byAngle", "The angle of a roof, as is meant without it.",
     "A --> s('1, 0, '1) roofHip(byAngle(30)) B."},
    {"annotation", "@Range", "The least and the greatest value of an attribute.",
     "@Range(1, 9) attr floors = 3  A --> B."},
    {"annotation", "@Enum", "The values that an attribute may have.",
     "@Enum(\"old\", \"new\") attr style = \"old\"  A --> B."},
    {"annotation", "@StartRule", "The rule behind it is the first.", "B --> C.  @StartRule A --> B"},
    {"selector", "front", "Faces that look to +z of the scope.", "A --> comp(f){ front: B. }"},
    {"selector", "back", "Faces that look to -z.", "A --> comp(f){ back: B. }"},
    {"selector", "left", "Faces that look to -x.", "A --> comp(f){ left: B. }"},
    {"selector", "right", "Faces that look to +x.", "A --> comp(f){ right: B. }"},
    {"selector", "top", "Faces that look up; of roofs, by the world's upright.", "A --> comp(f){ top: B. }"},
    {"selector", "bottom", "Faces that look down.", "A --> comp(f){ bottom: B. }"},
    {"selector", "side", "Faces that look aside.", "A --> comp(f){ side: B. }"},
    {"selector", "all", "All that is left.", "A --> comp(f){ all: B. }"},
    {"selector", "horizontal", "Faces within 11.25 degrees of level.", "A --> comp(f){ horizontal: B. }"},
    {"selector", "aslant", "Faces that slope and look up.",
     "A --> s('1, 0, '1) roofHip(30) comp(f){ aslant: B. }"},
    {"selector", "vertical", "Faces within 11.25 degrees of upright.", "A --> comp(f){ vertical: B. }"},
    {"selector", "nutant", "Faces that slope and look down.",
     "A --> i(\"pyramid\") s('1, '-1, '1) comp(f){ nutant: B. | all: C. }"},
    {"selector", "inside", "What an offset left inside.",
     "A --> s('1, 0, '1) offset(-1) comp(f){ inside: B. }"},
    {"selector", "border", "What an offset left between the old border and the new.",
     "A --> s('1, 0, '1) offset(-1) comp(f){ border: B. }"},
    {"selector", "remainder", "What the other selectors leave.",
     "A --> s('1, 0, '1) setback(1){ front: B. | remainder: C. }"},
    {"selector", "shape", "What shapeL, shapeU, shapeO and innerRectangle make.",
     "A --> s('1, 0, '1) shapeL(1, 1){ shape: B. }"},
    {"attribute", "scope.sx", "Size along x; so scope.sy and scope.sz.", "A --> s(scope.sx / 2, '1, '1) B."},
    {"attribute", "scope.tx", "Place along the world's x; so scope.ty and scope.tz.",
     "A --> case scope.tx < 0: B. else: C."},
    {"attribute", "split.index", "Number of the piece that a split made, from 0.",
     "A --> split(x){ ~2: case split.index == 0: B. else: C. }*"},
    {"attribute", "split.total", "How many pieces it made.",
     "A --> split(x){ ~2: case split.index == split.total - 1: B. else: C. }*"},
    {"attribute", "comp.index", "Number of the component within its selector, from 0.",
     "A --> comp(f){ side: case comp.index == 0: B. else: C. }"},
    {"attribute", "comp.total", "How many the selector took.",
     "A --> comp(f){ side: report(\"sides\", comp.total) B. }"},
    {"attribute", "geometry.area", "Square metres of all faces.", "A --> report(\"area\", geometry.area) B."},
    {"attribute", "geometry.volume", "Cubic metres, 0 where it is not closed.",
     "A --> report(\"volume\", geometry.volume) B."},
    {"attribute", "shape.depth", "How many shapes it stands in.", "A --> case shape.depth < 3: B. else: C."},
    {"attribute", "lod",
     "An attribute of your own with this name tells levels of detail apart: output.lods runs the rules again "
     "with 1, 2 and so on more.",
     "@Range(0, 2) attr lod = 0  A --> case lod > 0: B. else: split(x){ ~1: C. }*"},
    {"query", "Shape.occ",
     "none, part or full, as other closed shapes cover it: \"noparent\", \"active\", a name.",
     "A --> case Shape.occ(\"noparent\") == \"none\": B. else: C."},
    {"query", "Scope.occ", "As Shape.occ.", "A --> case Scope.occ(\"all\") == \"none\": B. else: C."},
    {"query", "Shape.visible", "Is the shortest straight line to the nearest shape of a name free?",
     "A --> case Shape.visible(\"Street\"): B. else: C."},
    {"query", "overlaps", "Does another closed shape go into it?", "A --> case overlaps(): B. else: C."},
    {"query", "inside", "Does it lie in another closed shape?", "A --> case inside(): B. else: C."},
    {"query", "touches", "Does it touch another closed shape?", "A --> case touches(): B. else: C."},
};

/// The number of arguments, from least to most.
std::pair<int, int> arity_of(std::string_view arguments) {
  const std::size_t bar = arguments.find('|');
  if (bar == std::string_view::npos)
    return {static_cast<int>(arguments.size()), static_cast<int>(arguments.size())};
  return {static_cast<int>(bar), static_cast<int>(arguments.size()) - 1};
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
                              {"text", row.text},
                              {"example", row.example}});
  }
  Json word_rows = Json::array();
  for (const WordRow& row : words)
    word_rows.push_back(
        {{"kind", row.kind}, {"name", row.name}, {"text", row.text}, {"example", row.example}});
  Json parts = Json::array();
  for (const PartRow& row : part_rows())
    parts.push_back({{"kind", "part"},
                     {"name", row.name},
                     {"text", row.text},
                     {"example", "A --> i(\"" + std::string(row.name) + "\")"}});
  Json materials = Json::array();
  for (const std::string_view name : built_in_materials()) materials.push_back(name);
  return {{"building_operations", std::move(operation_rows)},
          {"building_words", std::move(word_rows)},
          {"building_parts", std::move(parts)},
          {"building_materials", std::move(materials)}};
}

}  // namespace seedmesh::building
