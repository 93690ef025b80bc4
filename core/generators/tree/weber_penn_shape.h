#pragma once
/// The closed formulas of Weber and Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH 1995: crown
/// outlines, the pruning envelope, the taper of a stem, and what is left of a tree at a distance. Lengths in
/// metres, angles in degrees as in the paper.
#include <array>

#include "core/generators/tree/growth_context.h"

namespace seedmesh::tree {

/// The parameters of one level of branching.
struct WeberPennLevel {
  double down_angle, down_angle_v, rotate, rotate_v;
  int branches;
  double length, length_v, taper, seg_splits, split_angle, split_angle_v;
  int curve_res;
  double curve, curve_back, curve_v;
};

/// Levels beyond 3 are like 3. The trunk's has no angles and no number: 0.
std::array<WeberPennLevel, 4> weber_penn_levels(const TreeParams& params);

/// math::pow within a share of 1e-11, quicker: exact where the exponent is 1, 2 or a half.
double power(double base, double exponent);

/// The outline of a crown at `ratio` 1 (its base) to 0 (its top), a share of the greatest length. Shape 8 is
/// the envelope.
double shape_ratio(const TreeParams& params, int shape, double ratio);

/// The radius at share `z` of a stem of `length` whose base has `radius`; flare and lobes apart.
double tapered(double taper, double radius, double length, double z);

/// Factor of the trunk's radius by its flare at share `z` of the length: the paper's for flares up to 1.25,
/// less steep for wider ones.
double flared(double flare, double z);

/// By Flare and trunk_flare: at the ground the product of both factors, as one flare.
double flared_trunk(const TreeParams& params, double z);

/// Bernoulli's bound: base^power is more, for a base in 0 .. 1 and a power up to 1. A little less than it is.
inline double least_power(double base, double power) { return (1 - 1e-9) / (1 + power * (1 / base - 1)); }

/// True where a point lies within the envelope; `aside` from the axis and `height` above the ground of a tree
/// that is `scale` high.
bool is_in_envelope(const TreeParams& params, double scale, double aside, double height);

/// Degrees between a frame's heading and the sky.
double declination_of(const Frame& frame);

}  // namespace seedmesh::tree
