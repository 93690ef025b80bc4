#pragma once
/// Fractals as files that are no models.
#include "core/base/array.h"
#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/form.h"

namespace seedmesh {
struct FractalParams;
}

namespace seedmesh::fractal {

/// ply: the points of frcm, binary little-endian, 12 bytes of position and 3 of colour (sRGB) each. png16:
/// how late points leave (escape), grey, 65535 where they never do. png8: the same in the colours of the
/// palette. The parameters suit the form (checked before).
Result<Array<std::uint8_t>> encode(const FractalParams& params, std::string_view format, Job& job);

/// A form that the method has not is refused at /method; ply is one cloud, so stages are refused.
std::vector<Issue> check_form(const FractalParams& params, const WantedForm& form);

}  // namespace seedmesh::fractal
