#pragma once
/// The operations of the rules, as functions of one type; interpret.cpp has the table. Each reads its arguments from
/// the grammar. It either changes the state of the shape (translate, extrude, style) or makes other shapes of it
/// (split, comp, setback). For these shapes it runs the bodies that follow the operation. An operation that cannot do
/// what the rule says ends the derivation with an error at its byte of the rules. Operations of the CGA reference
/// keep its definitions.
#include "core/generators/building/derivation.h"

namespace seedmesh::building {

using Operator = void(Derivation& d, const Step& step, ShapeState& state, const StepContext& site);

namespace operators {

// The scope (scope_operators.cpp)
Operator translate, resize, rotate, center, mirror_scope, align_to_axes, align_to_geometry;
// The scope in other frames (frame_operators.cpp)
Operator translate_in, rotate_in, rotate_scope, set_pivot;
// The geometry as a whole (solid_operators.cpp, roof_operators.cpp, offset_operators.cpp)
Operator extrude, taper, insert, place, roof, roof_2006, offset;
// What shapes inherit, reports and snap lines (style_operators.cpp)
Operator style, set, setup_projection, project_uv, report, snap, reset_material, set_material, print;
// Tags (tags.cpp) and texture coordinates (uv_operators.cpp)
Operator tag, texture, change_uv, normalize_uv, tile_uv, copy_uv, delete_uv;
// Corners and faces (mesh_operators.cpp), built-in solids (primitive_operators.cpp), masses (mass_operators.cpp)
Operator mirror, reverse_normals, cleanup, convexify, delete_holes, rectify, reduce, set_normals,
    reset_geometry;
Operator primitive, primitive_fitted, primitive_polygon, insert_along_uv, footprint, envelope, roof_ridge;
// Points (scatter_operator.cpp), shapes made one (inline_operators.cpp), sections of a border (perimeter_operator.cpp)
Operator scatter, inline_shapes, modify, combine, split_perimeter;
// Other shapes (split.cpp, comp.cpp, offset_operators.cpp, inner_rectangle_operator.cpp)
Operator split, repeat, split_area, comp, setback, inner_rectangle, inner_rect;

}  // namespace operators
}  // namespace seedmesh::building
