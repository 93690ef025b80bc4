#pragma once
/// Mandelbrot and Julia sets by escape time (Peitgen and Saupe, "The Science of Fractal Images", 1988, 4.2),
/// as a closed plate with a relief.
#include "core/model/mesh.h"
#include "core/schema/color.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// Logarithm of the escape time, divided by the logarithm of the greatest number of steps. It is 0 for one
/// step, below 1 for points that escape, and 1 for the others. Row by row from the upper left corner of the
/// window.
struct EscapeField {
  std::uint32_t side = 0;
  Array<float> value;
};

/// Uses the smooth iteration count, which has a fraction that follows from the distance reached. Rows are
/// computed in parallel.
EscapeField escape_field(const FractalParams& params, Job& job);

/// Returns the colour of a value of the field: the palette from its first to its last colour as the escape time
/// grows, nearly black for points that never escape.
Color escape_color(const FractalParams& params, float value);

/// Returns a closed plate with edges of `size` in the XZ plane, with the imaginary axis along -Z and the relief along
/// +Y. Its underside is at y = -size * plate. Colours are those of escape_color().
Mesh escape_plate(const FractalParams& params, const EscapeField& field, Job& job);

}  // namespace seedmesh::fractal
