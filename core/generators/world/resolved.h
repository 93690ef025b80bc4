#pragma once
/// Variations that samples are too far apart to show fade from level to level, so that no level ends with a line.
#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Returns the share of an octave of noise that samples `spacing` metres apart show, 0 to 1.
inline double resolved_share(double spacing, double wavelength) {
  return 1 - smooth_step(spacing / wavelength, 0.08, 0.34);
}

}  // namespace seedmesh::world
