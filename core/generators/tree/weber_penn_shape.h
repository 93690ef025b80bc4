#pragma once
/// The closed formulas of Weber and Penn, "Creation and Rendering of Realistic Trees", SIGGRAPH 1995: crown
/// outlines, the pruning envelope, and the taper of a stem. Lengths are in metres, angles in degrees.
#include <array>

#include "core/generators/tree/skeleton_writer.h"

namespace seedmesh::tree {

/// The parameters of one level of branching.
struct WeberPennLevel {
  double down_angle, down_angle_v, rotate, rotate_v;
  int branches;
  double spread = 1;  ///< share of each segment of the parent, from its base, on which they begin
  int whorl = 1;      ///< how many begin at the same height
  double bare = 0;    ///< share of their length without children and leaves
  double length, length_v, taper, seg_splits, split_angle, split_angle_v;
  int curve_res;
  double curve, curve_back, curve_v;
};

/// Levels beyond 3 equal level 3. Level 0, the trunk, has angles and a number of branches of 0.
std::array<WeberPennLevel, 4> weber_penn_levels(const TreeParams& params);

/// math::pow with a relative error below 1e-11, but faster. Exact for the exponents 1, 2 and 0.5.
double power(double base, double exponent);

/// Returns the length of branches as a share of the greatest length. `ratio` is 1 at the base of the crown
/// and 0 at its top. Shape 8 is the envelope. Shape 0 of Arbaro ends in a point, that of the paper at a
/// fifth.
double shape_ratio(const TreeParams& params, int shape, double ratio);

/// Returns the radius at share `z` of a stem of `length` with `radius` at its base, without flare and lobes.
double tapered(double taper, double radius, double length, double z);

/// Returns the factor for the radius of the trunk at share `z` of its length: that of the paper for flares up to
/// 1.25, and a flatter one for wider flares.
double flared(double flare, double z);

/// Returns the factor of Flare and trunk_flare together: at the ground the product of both.
double flared_trunk(const TreeParams& params, double z);

/// Whether a point is within the envelope of a tree of height `scale`. The point is `aside` from the axis,
/// and `height` above the ground.
bool is_in_envelope(const TreeParams& params, double scale, double aside, double height);

/// Returns the inverse cosine within 1e-7, for -1 .. 1. After M. Abramowitz and I. Stegun, Handbook of Mathematical
/// Functions, 1964, 4.4.46.
inline double approximate_acos(double x) {
  const double a = std::abs(x);
  const double angle =
      std::sqrt(1 - a) *
      (1.5707963050 +
       a * (-0.2145988016 +
            a * (0.0889789874 +
                 a * (-0.0501743046 +
                      a * (0.0308918810 + a * (-0.0170881256 + a * (0.0066700901 + a * -0.0012624911)))))));
  return x < 0 ? math::pi - angle : angle;
}

/// Degrees between the heading of a frame and +Y.
double declination_of(const Frame& frame);

}  // namespace seedmesh::tree
