#pragma once
/// The strength of an octave of noise on samples of a given spacing. Samples that are far apart compared with its
/// wavelength cannot represent it. Its strength falls gradually from level to level, so that no line is visible where
/// tiles of two levels meet.
#include "core/generators/world/noise.h"

namespace seedmesh::world {

/// Returns the factor of an octave on samples that are `spacing` metres apart: 1 for a spacing of up to 0.08
/// wavelengths, 0 from 0.34 wavelengths on.
inline double resolved_share(double spacing, double wavelength) {
  return 1 - smooth_step(spacing / wavelength, 0.08, 0.34);
}

}  // namespace seedmesh::world
