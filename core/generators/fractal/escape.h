#pragma once
/// Mandelbrot and Julia sets by escape time (Peitgen and Saupe, "The Science of Fractal Images", 1988, 4.2),
/// as a closed plate with a relief.
#include "core/model/mesh.h"
#include "core/schema/color.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// Relative escape times: 0 for at once, 1 for never. Row by row from the upper left corner of the window.
struct EscapeField {
  std::uint32_t side = 0;
  Array<float> value;
};

/// Steps have a fraction that follows from the distance reached. Rows are computed in parallel.
EscapeField escape_field(const FractalParams& params, Job& job);

/// The colour of a value of the field: the palette from early to late, nearly black for points that never
/// leave.
Color escape_color(const FractalParams& params, float value);

/// A closed plate with edges of `size` in the XZ plane, with the imaginary axis along -Z and the relief along
/// +Y. Its underside is at y = -size * plate. Colours are those of escape_color().
Mesh escape_plate(const FractalParams& params, const EscapeField& field, Job& job);

}  // namespace seedmesh::fractal
