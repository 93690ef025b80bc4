#pragma once
/// Variations fade from level to level before samples are too far apart to show them, so that no line is visible
/// where a level ends.
#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Returns the share of an octave of noise that samples `spacing` metres apart show, 0 to 1.
inline double resolved_share(double spacing, double wavelength) {
  return 1 - smooth_step(spacing / wavelength, 0.08, 0.34);
}

}  // namespace seedmesh::world
