#pragma once
/// Fractals in formats other than models.
#include "core/base/array.h"
#include "core/base/result.h"
#include "core/generators/api.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// Returns a file in one of the formats. ply: the points of frcm, binary little-endian, each with 12 bytes of
/// position and 3 bytes of colour (sRGB). png16: escape times in grey, 65535 for points that never leave. png8:
/// the same in the colours of the palette. The parameters must have passed check_format().
Result<Array<std::uint8_t>> encode(const FractalParams& params, const WantedFormat& format,
                                   const GenerateContext& context);

/// Errors have the pointer /method for a format that the method does not have, and /stages for ply, because a
/// file contains only one cloud.
std::vector<Issue> check_format(const FractalParams& params, const WantedFormat& form);

}  // namespace seedmesh::fractal
