#include "core/generators/building/operations.h"

#include <algorithm>

namespace seedmesh::building {
namespace {

constexpr OperationRow rows[] = {
    {"T", Op::translate, "nnn", Braces::absent, "x, y, z",
     "Moves the scope along its own axes; 'v is a share of its size.", "A ~> T(1, 0, 0) B."},
    {"t", Op::translate, "nnn", Braces::absent, "x, y, z", "As T.", "A --> t(0, '0.5, 0) B."},
    {"S", Op::size, "nnn", Braces::absent, "x, y, z",
     "Sets the size of the scope; 'v or 1r is a share of what it is. A negative size mirrors, 0 flattens.",
     "A ~> S(1r, 2, 1r) B."},
    {"s", Op::size, "nnn", Braces::absent, "x, y, z", "As S.", "A --> s('1, 2, '1) B."},
    {"R", Op::rotate, "nnn|w", Braces::absent, "x, y, z, centre",
     "Turns the scope by degrees about x, then y, then z; about its origin, or about its centre with "
     "scopeCenter.",
     "A ~> R(0, 30, 0) B."},
    {"r", Op::rotate, "nnn|w", Braces::absent, "x, y, z, centre", "As R.", "A --> r(0, 30, 0) B."},
    {"center", Op::center, "w", Braces::absent, "axes",
     "Moves the scope to the middle of the one it had when the rule or bracket began, on the axes named.",
     "A --> s('0.5, '1, '0.5) center(xz) B."},
    {"mirrorScope", Op::mirror_scope, "", Braces::absent, "",
     "Turns the scope by a half turn about its y axis, so that x and z run the other way.",
     "A --> mirrorScope() B."},
    {"alignScopeToAxes", Op::align_to_axes, "|w", Braces::absent, "axis",
     "Turns the scope, but not its geometry, to the world's axes; or so that the axis named is upright.",
     "A --> r(0, 30, 0) s('1, 0, '1) alignScopeToAxes() B."},
    {"alignScopeToGeometry", Op::align_to_geometry, "w|ii", Braces::absent, "up, face, edge",
     "Turns the scope to a face (a number or largest): the axis named as xUp, yUp or zUp looks out of it, "
     "and "
     "another lies along an edge of it (a number or longest).",
     "A --> s('1, 0, '1) alignScopeToGeometry(zUp, 0, longest) B."},
    {"alignScopeToGeometryBBox", Op::align_to_box, "w", Braces::absent, "up",
     "The same, so that the rectangle around the largest face is as small as can be.",
     "A --> s('1, 0, '1) alignScopeToGeometryBBox(yUp) B."},
    {"split", Op::split, "w|wn", Braces::cells, "axis, adjust or space, set",
     "Cuts the shape across an axis into cells { size: successor | ... }; sizes are absolute, '0.5 of the "
     "scope or ~3 of what is left; { }* repeats. Along u and v it follows the texture space, in tiles "
     "(uvSpace) or metres (unitSpace).",
     "A --> split(x){ ~1: B. | { 0.5: C. | ~2: D. }* | ~1: B. }"},
    {"splitArea", Op::split_area, "w|w", Braces::cells, "axis, noAdjust",
     "Cuts a face like split, where the sizes are areas.",
     "A --> s('1, 0, '1) splitArea(x){ 20: B. | ~1: C. }"},
    {"Subdiv", Op::split, "w", Braces::names, "axis, sizes",
     "The split of 2006: sizes in the call, 3r for a share of what is left.",
     "A ~> Subdiv(\"X\", 2, 1r, 2){ B. | C. | B. }"},
    {"Repeat", Op::repeat, "wn", Braces::one, "axis, size",
     "Cuts the shape into equal pieces of about this size.", "A ~> Repeat(\"X\", 2){ B. }"},
    {"comp", Op::comp, "w", Braces::selectors, "f",
     "Takes the faces (f), edges (e) or corners (v) as shapes: front, back, left, right, top, bottom, side, "
     "all, "
     "horizontal, aslant, vertical, nutant, a number.",
     "A --> comp(f){ side: B. | top: C. }"},
    {"Comp", Op::comp, "w|n", Braces::one, "type, index",
     "The component split of 2006: faces, sidefaces, topfaces, bottomfaces, edges, vertices; with an index, "
     "one of them.",
     "A ~> Comp(\"sidefaces\"){ B. }"},
    {"Snap", Op::snap, "w|w", Braces::absent, "axes, id",
     "Makes the planes of this shape across the axes named snap lines; splits along \"XS\" keep to them.",
     "A ~> Snap(\"X\") Subdiv(\"XS\", 1r, 1r){ B. | C. }"},
    {"extrude", Op::extrude, "n", Braces::absent, "height", "Makes a solid of a face, along its normal.",
     "A --> s('1, 0, '1) extrude(9) B."},
    {"taper", Op::taper, "n", Braces::absent, "height",
     "Makes a pyramid of a face, its tip above the middle.", "A --> s('1, 0, '1) taper(3) B."},
    {"offset", Op::offset, "n|w", Braces::absent, "distance, all | inside | border",
     "Moves the border of a face, inwards where the distance is negative; comp(f) then tells inside from "
     "border.",
     "A --> s('1, 0, '1) offset(-1) comp(f){ inside: B. | border: C. }"},
    {"setback", Op::setback, "n", Braces::selectors, "distance",
     "Moves the edges of a face that selectors take inwards; each strip is a shape, and so is the remainder.",
     "A --> s('1, 0, '1) setback(1){ front: B. | remainder: C. }"},
    {"shapeL", Op::shape_l, "nn", Braces::selectors, "front, left",
     "A plan in the shape of an L with these widths.",
     "A --> s('1, 0, '1) shapeL(1, 1){ shape: B. | remainder: C. }"},
    {"shapeU", Op::shape_u, "nnn", Braces::selectors, "front, right, left", "A plan in the shape of a U.",
     "A --> s('1, 0, '1) shapeU(1, 1, 1){ shape: B. | remainder: C. }"},
    {"shapeO", Op::shape_o, "nnnn", Braces::selectors, "front, right, back, left", "A ring around a court.",
     "A --> s('1, 0, '1) shapeO(1, 1, 1, 1){ shape: B. | remainder: C. }"},
    {"innerRectangle", Op::inner_rectangle, "|w", Braces::selectors, "scope | edge",
     "The largest rectangle inside a face, along the axes of its scope or along one of its long edges; and "
     "the "
     "remainder, piece by piece.",
     "A --> s('1, 0, '1) innerRectangle(scope){ shape: B. | remainder: C. }"},
    {"roofHip", Op::roof_hip, "h|n", Braces::absent, "angle, overhang",
     "A roof with a slope from every edge of a face, courtyards too. In place of the angle of any roof "
     "byHeight(h) gives its height.",
     "A --> s('1, 0, '1) roofHip(30, 0.4) B."},
    {"roofGable", Op::roof_gable, "h|nn", Braces::absent, "angle, overhang, verge",
     "A roof with upright ends.", "A --> s('1, 0, '1) roofGable(40, 0.4, 0.2) B."},
    {"roofPyramid", Op::roof_pyramid, "h|n", Braces::absent, "angle, overhang",
     "A roof with one tip over the middle.", "A --> s('1, 0, '1) roofPyramid(50) B."},
    {"roofShed", Op::roof_shed, "h|nn", Braces::absent, "angle, edge, overhang",
     "One slope that rises from an edge.", "A --> s('1, 0, '1) roofShed(byHeight(2), 0) B."},
    {"roofMansard", Op::roof_mansard, "h|nnn", Braces::absent, "angle, upper angle, break height, overhang",
     "A steep slope and a flatter one above it, from every edge; byHeight(h) scales both to the height of "
     "the "
     "whole.",
     "A --> s('1, 0, '1) roofMansard(70, 20, 1) B."},
    {"roofGambrel", Op::roof_gambrel, "h|nnnn", Braces::absent,
     "angle, upper angle, break height, overhang, verge", "The same with upright ends.",
     "A --> s('1, 0, '1) roofGambrel(60, 25) B."},
    {"Roof", Op::roof, "wh|n", Braces::one, "kind, angle, overhang",
     "The roof of 2006 as a shape of its own: hip, gable, pyramid, shed, mansard, gambrel. Of a volume it "
     "takes "
     "the place, on its underside, so that it may follow S(1r,h,1r) walls T(0,h,0).",
     "A ~> S(1r, 0, 1r) B. Roof(\"hipped\", 30){ C. }"},
    {"I", Op::place, "t|nnn", Braces::absent, "name, count, frame, angle",
     "Puts a body, a part or an asset into the scope, as a leaf of its own; the shape goes on as it was.",
     "A ~> [ I(\"cube\") ] T(0, 3, 0) I(\"pyramid\")"},
    {"i", Op::insert, "t|nnn", Braces::absent, "name, count, frame, angle",
     "Makes a body, a part or an asset of the shape, fitted to its scope: where a size is 0 it follows from "
     "the others. Of a part, 0 is by its size: how many panes, steps, sides or teeth, how wide the frame, "
     "how "
     "steep the roof.",
     "A --> i(\"cylinder\")"},
    {"primitive", Op::insert, "t", Braces::absent, "name", "As i.", "A --> primitive(\"prism\")"},
    {"color", Op::color, "t|nnn", Braces::absent, "color",
     "The colour, as \"#rrggbb\" or red, green, blue from 0 to 1.", "A --> color(\"#aa8866\") B."},
    {"material", Op::material, "t", Braces::absent, "name",
     "The material by name: one of the request's, a built-in one, or a new one with the colour in force.",
     "A --> material(\"brick\") B."},
    {"setupProjection", Op::setup_projection, "nwnn|nn", Braces::absent, "set, axes, width, height, u, v",
     "Says how images will lie: axes as scope.xy or world.xz, the size of a tile (~2 for whole tiles, '0.5 "
     "of "
     "the scope), and how far they are moved. The set is 0.",
     "A --> comp(f){ front: setupProjection(0, scope.xy, ~2, 1) projectUV(0) B. }"},
    {"projectUV", Op::project_uv, "n", Braces::absent, "set",
     "Lays the images of the material as set up, from here on.",
     "A --> comp(f){ front: setupProjection(0, scope.xy, 1, 1) split(x){ ~1: projectUV(0) B. | ~1: C. } }"},
    {"set", Op::set, "wn", Braces::absent, "attribute, value",
     "Gives an attribute another value in what follows from here; material.name and material.color are "
     "attributes too.",
     "attr w = 1  A --> set(w, 2) B  B --> s(w, '1, '1) C."},
    {"report", Op::report, "t|n", Braces::absent, "key, value",
     "Adds a value to the report of that name, which derive answers: count, sum, mean, least and greatest.",
     "A --> report(\"area\", geometry.area) B."},
    {"label", Op::label, "t", Braces::absent, "name", "Names the shapes from here on, for queries.",
     "A --> label(\"mass\") B."},
};

}  // namespace

std::span<const OperationRow> operations() { return rows; }

std::string_view kind_of(Op op) {
  switch (op) {
    case Op::split:
    case Op::split_area:
    case Op::repeat:
    case Op::comp:
    case Op::snap:
      return "cut";
    case Op::extrude:
    case Op::taper:
    case Op::offset:
    case Op::setback:
    case Op::shape_l:
    case Op::shape_u:
    case Op::shape_o:
    case Op::inner_rectangle:
      return "mass";
    case Op::roof_hip:
    case Op::roof_gable:
    case Op::roof_pyramid:
    case Op::roof_shed:
    case Op::roof_mansard:
    case Op::roof_gambrel:
    case Op::roof:
      return "roof";
    case Op::insert:
    case Op::place:
      return "part";
    case Op::color:
    case Op::material:
      return "look";
    case Op::setup_projection:
    case Op::project_uv:
      return "texture";
    case Op::set:
      return "attribute";
    case Op::report:
    case Op::label:
      return "report";
    default:
      return "scope";
  }
}

const OperationRow* find_operation(std::string_view name) {
  const auto* const found = std::find_if(std::begin(rows), std::end(rows),
                                         [&](const OperationRow& row) { return row.name == name; });
  return found == std::end(rows) ? nullptr : found;
}

}  // namespace seedmesh::building
