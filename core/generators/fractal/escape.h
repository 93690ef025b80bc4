#pragma once
/// Mandelbrot and Julia sets by escape time (Peitgen and Saupe, "The Science of Fractal Images", 1988, 4.2),
/// as a closed plate with a relief.
#include "core/model/mesh.h"
#include "core/schema/color.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// How soon points leave, 0 at once to 1 never, row by row from the upper left corner of the window.
struct EscapeField {
  std::uint32_t side = 0;
  Array<float> value;
};

/// Steps are counted smoothly (with the logarithm of how far the point went). Rows are made in parallel.
EscapeField escape_field(const FractalParams& params, Job& job);

/// The colour of a value of the field: the palette from soon to late, nearly black where points never leave.
Color escape_color(const FractalParams& params, float value);

/// A plate of edge `size` in the XZ plane, the imaginary axis towards -Z, relief along +Y; the underside at
/// -plate. Colours follow the palette from soon to late; points that never leave are black. Closed.
Mesh escape_plate(const FractalParams& params, const EscapeField& field, Job& job);

}  // namespace seedmesh::fractal
