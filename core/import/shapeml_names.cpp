#include "core/import/shapeml_names.h"

namespace seedmesh {
namespace {

constexpr ShapemlOperation operations[] = {
    {"translate", 3, 3, "t($*)"},
    {"translateX", 1, 1, "t($1, 0, 0)"},
    {"translateY", 1, 1, "t(0, $1, 0)"},
    {"translateZ", 1, 1, "t(0, 0, $1)"},
    {"translateAbs", 3, 3, "translate(abs, world, $*)"},
    {"size", 3, 3, "s($*)"},
    {"sizeX", 1, 1, "s($1, '1, '1)"},
    {"sizeY", 1, 1, "s('1, $1, '1)"},
    {"sizeZ", 1, 1, "s('1, '1, $1)"},
    {"scaleX", 1, 1, "s('($1), '1, '1)"},
    {"scaleY", 1, 1, "s('1, '($1), '1)"},
    {"scaleZ", 1, 1, "s('1, '1, '($1))"},
    {"scaleCenterX", 1, 1, "t('(0.5 - 0.5 * ($1)), 0, 0) s('($1), '1, '1)"},
    {"scaleCenterY", 1, 1, "t(0, '(0.5 - 0.5 * ($1)), 0) s('1, '($1), '1)"},
    {"scaleCenterZ", 1, 1, "t(0, 0, '(0.5 - 0.5 * ($1))) s('1, '1, '($1))"},
    {"rotateX", 1, 1, "r($1, 0, 0)"},
    {"rotateY", 1, 1, "r(0, $1, 0)"},
    {"rotateZ", 1, 1, "r(0, 0, $1)"},
    {"rotateScopeX", 1, 1, "rotateScope($1, 0, 0)"},
    {"rotateScopeY", 1, 1, "rotateScope(0, $1, 0)"},
    {"rotateScopeZ", 1, 1, "rotateScope(0, 0, $1)"},
    {"rotateScopeXYToXZ", 0, 0, "rotateScope(90, 0, 0)"},
    {"center", 0, 0, "center(xyz)"},
    {"centerX", 0, 0, "center(x)"},
    {"centerY", 0, 0, "center(y)"},
    {"centerZ", 0, 0, "center(z)"},
    {"centerAtOrigin", 0, 0, "t(-0.5 * scope.sx, -0.5 * scope.sy, -0.5 * scope.sz)"},
    {"centerAtOriginX", 0, 0, "t(-0.5 * scope.sx, 0, 0)"},
    {"centerAtOriginY", 0, 0, "t(0, -0.5 * scope.sy, 0)"},
    {"centerAtOriginZ", 0, 0, "t(0, 0, -0.5 * scope.sz)"},
    {"extrude", 1, 1, "extrude($1)"},
    {"mirrorX", 0, 0, "mirror(true, false, false)"},
    {"mirrorY", 0, 0, "mirror(false, true, false)"},
    {"mirrorZ", 0, 0, "mirror(false, false, true)"},
    {"normalsFlip", 0, 0, "reverseNormals()"},
    {"normalsFlat", 0, 0, "setNormals(hard)"},
    {"normalsSmooth", 0, 0, "setNormals(soft)"},
    {"uvScale", 2, 2, "scaleUV(0, $*)"},
    {"uvTranslate", 2, 2, "translateUV(0, $*)"},
    {"uvSetupProjectionXY", 2, 4, "setupProjection(0, scope.xy, $*)"},
    {"uvProject", 0, 0, "projectUV(0)"},
    {"mesh", 1, 1, "i($1)"},
    {"quad", 0, 0, "primitiveQuad()"},
    {"grid", 2, 2, "primitiveQuad()"},
    {"circle", 1, 1, "primitiveFitted(\"disk\", $1)"},
    {"disk", 2, 2, "primitiveFitted(\"disk\", $1)"},
    {"cube", 0, 0, "primitiveCube()"},
    {"box", 3, 3, "primitiveCube()"},
    {"cylinder", 1, 3, "primitiveFitted(\"cylinder\", $1)"},
    {"cylinderFlat", 1, 3, "primitiveFitted(\"cylinder\", $1) setNormals(hard)"},
    {"cone", 1, 3, "primitiveFitted(\"cone\", $1)"},
    {"coneFlat", 1, 3, "primitiveFitted(\"cone\", $1) setNormals(hard)"},
    {"sphere", 2, 2, "primitiveFitted(\"sphere\", $1, $2)"},
    {"sphereFlat", 2, 2, "primitiveFitted(\"sphere\", $1, $2) setNormals(hard)"},
    {"torus", 4, 4, "primitiveFitted(\"torus\", $*)"},
    {"torusFlat", 4, 4, "primitiveFitted(\"torus\", $*) setNormals(hard)"},
    {"polygon", 6, 2000, "primitivePolygon([$*])"},
    {"shapeL", 2, 2,
     "primitivePolygon([0, 0, $2, 0, $2, scope.sz - ($1), scope.sx, scope.sz - ($1), scope.sx, scope.sz, 0, "
     "scope.sz])"},
    {"shapeU", 3, 3,
     "primitivePolygon([0, 0, $2, 0, $2, scope.sz - ($1), scope.sx - ($3), scope.sz - ($1), scope.sx - ($3), "
     "0, scope.sx, 0, scope.sx, scope.sz, 0, scope.sz])"},
    {"shapeT", 3, 3,
     "primitivePolygon([($3) * (scope.sx - ($2)), 0, ($3) * (scope.sx - ($2)) + ($2), 0, "
     "($3) * (scope.sx - ($2)) + ($2), scope.sz - ($1), scope.sx, scope.sz - ($1), scope.sx, scope.sz, 0, "
     "scope.sz, 0, scope.sz - ($1), ($3) * (scope.sx - ($2)), scope.sz - ($1)])"},
    {"shapeH", 4, 4,
     "primitivePolygon([0, 0, $1, 0, $1, (1 - ($4)) * (scope.sz - ($2)), scope.sx - ($3), "
     "(1 - ($4)) * (scope.sz - ($2)), scope.sx - ($3), 0, scope.sx, 0, scope.sx, scope.sz, scope.sx - ($3), "
     "scope.sz, scope.sx - ($3), (1 - ($4)) * (scope.sz - ($2)) + ($2), $1, "
     "(1 - ($4)) * (scope.sz - ($2)) + ($2), $1, scope.sz, 0, scope.sz])"},
    {"roofHip", 1, 2, "roofHip($*)"},
    {"roofGable", 1, 3, "roofGable($*)"},
    {"roofPyramid", 1, 1, "roofPyramid(byHeight($1))"},
    {"roofShed", 1, 1, "roofShed($1)"},
    {"color", 1, 4, "color($*)"},
    {"texture", 1, 1, "texture($1)"},
    {"textureNone", 0, 0, "resetMaterial()"},
    {"materialName", 1, 1, "material($1)"},
    {"print", 1, 1, "print($1)"},
    {"printLn", 1, 1, "print($1)"},
    {"hide", 0, 0, "set(own_hidden, 1)"},
    {"show", 0, 0, "set(own_hidden, 0)"},
    {"octreeAdd", 0, 0, "", true},
    {"metallic", 1, 1, "", true},
    {"roughness", 1, 1, "", true},
    {"reflectance", 1, 1, "", true},
    {"trim", 0, 0, "", true},
    {"trimLocal", 0, 0, "", true},
    {"trimPlane", 4, 6, "", true},
    {"ffdTranslate", 6, 6, "", true},
    {"ffdTranslateX", 4, 4, "", true},
    {"ffdTranslateY", 4, 4, "", true},
    {"ffdTranslateZ", 4, 4, "", true},
    {"ffdReset", 0, 3, "", true},
    {"ffdApply", 0, 0, "", true},
};

constexpr ShapemlName names[] = {
    {"size_x", "scope.sx"},
    {"size_y", "scope.sy"},
    {"size_z", "scope.sz"},
    {"pos_x", "scope.tx"},
    {"pos_y", "scope.ty"},
    {"pos_z", "scope.tz"},
    {"pos_world_x", "scope.tx"},
    {"pos_world_y", "scope.ty"},
    {"pos_world_z", "scope.tz"},
    {"area", "geometry.area"},
    {"index", "own_shape_index"},
    {"depth", "shape.depth"},
    {"color_r", "material.color.r"},
    {"color_g", "material.color.g"},
    {"color_b", "material.color.b"},
    {"color_a", "material.opacity"},
    {"material_name", "material.name"},
    {"pi", "3.141592653589793"},
    {"file_exists", "fileExists"},
    {"rand_normal", "nran"},
    {"string", "str"},
};

constexpr ShapemlFunction functions[] = {
    {"clamp_between", "clamp_between(low, high, x) = max(low, min(high, x))"},
    {"rand_int", "rand_int(low, high) = floor(rand(low, high + 1))"},
    {"rand_uniform", "rand_uniform(low, high) = rand(low, high)"},
    {"fract", "fract(x) = x - floor(x)"},
    {"step", "step(edge, x) = case x < edge: 0 else: 1"},
    {"smooth_step",
     "smooth_step(a, b, x) = clamp((x - a) / (b - a), 0, 1) ^ 2 * (3 - 2 * clamp((x - a) / (b - a), 0, 1))"},
    {"int", "int(x) = trunc(x)"},
    {"pattern_fit", "pattern_fit(sum, length) = case sum < length + 0.00001: 1 else: 0"},
    {"pattern_count",
     "pattern_count(length, outer, outer_fixed, inner, inner_fixed, inner_alone) ="
     " case outer >= length - 0.00001 || inner <= 0: 0"
     " case inner_alone == 1 && (length - outer) / inner < 0.5 && length - outer_fixed >= inner_fixed - "
     "0.00001: 1"
     " case inner_fixed > 0: min(floor((length - outer) / inner + 0.5),"
     " floor((length - outer_fixed) / inner_fixed + 0.000001))"
     " else: floor((length - outer) / inner + 0.5)"},
    {"pattern_stretch",
     "pattern_stretch(length, outer_fixed, outer, inner_fixed, inner, count) ="
     " case outer + count * inner > 0: max(0, (length - outer_fixed - count * inner_fixed) / (outer + count "
     "* inner))"
     " else: 0"},
};

}  // namespace

std::span<const ShapemlOperation> shapeml_operations() { return operations; }
std::span<const ShapemlName> shapeml_names() { return names; }
std::span<const ShapemlFunction> shapeml_functions() { return functions; }

}  // namespace seedmesh
