#pragma once
/// One stem of a tree by Weber and Penn: its size, how it bends, and how many children of which size it
/// bears. The formulas are those of section 4 of the paper (weber_penn.h). Lengths in metres, angles in
/// degrees.
#include <algorithm>
#include <array>
#include <vector>

#include "core/generators/tree/weber_penn_shape.h"

namespace seedmesh::tree {

/// What all stems of one tree share. `params` and `random` are borrowed.
struct WeberPennTree {
  WeberPennTree(const TreeParams& given, const RandomStreams& streams)
      : params(given), random(streams), levels(weber_penn_levels(given)) {}

  const TreeParams& params;
  const RandomStreams& random;
  std::array<WeberPennLevel, 4> levels;
  double scale = 0;           ///< the height of the tree before 0Length
  double carried_splits = 0;  ///< rounding error of the splits of the trunks so far, where Arbaro counts
  /// Rounding errors of the splits before one stem after another of a level, where Arbaro counts; empty: no splits.
  std::array<std::vector<double>, 4> carried_before;

  const WeberPennLevel& level(int n) const { return levels[static_cast<std::size_t>(std::min(n, 3))]; }
  double bare_length() const { return params.BaseSize * scale; }
  bool counts_as_arbaro() const { return params.counting == TreeParams::Counting::arbaro; }
  bool sways() const { return params.sway.wind != 0 || params.sway.gust != 0; }
};

struct WeberPennStem {
  Frame frame;                        ///< frame of its first segment
  glm::dvec3 position{0};             ///< position where it begins
  std::uint32_t joint = Limbs::none;  ///< the joint from which it grows
  int level = 0;                      ///< 0 for trunks and their clones
  int trunk = 0;                      ///< the number of a trunk; also of its clones
  double length = 0, radius = 0;
  double offset = 0, parent_length = 0;  ///< the offset is its position along the parent
  double parent_length_max = 0;          ///< length_child,max of the paper; `length` is a share of it
  Rng rng{0};
  // A clone is a stem that splits off from another stem, at a later segment of that stem. It has the length
  // of that stem. It turns back by `uncurve` in each segment, and bears `share` of the children of that stem.
  int segment = 0;
  double uncurve = 0;
  double share = 1;
  double readiness = 1;           ///< readiness to split; halved by a split
  double carried_splits = 0;      ///< rounding error of the number of splits so far
  double carried_children = 0.5;  ///< share of the distance to the next child that is already passed
  int children_before = 0;        ///< number of children on earlier segments
};

/// Returns trunk `number`, which has no joint yet; called for 0, 1, ... The first one draws the height of the tree.
WeberPennStem make_trunk(WeberPennTree& tree, int number);

/// Whether a stem is of the last level, which has no child stems.
inline bool is_last(const WeberPennTree& tree, const WeberPennStem& stem) {
  return stem.level + 1 >= tree.params.Levels;
}
/// Returns the length of one segment of a stem.
inline double segment_length(const WeberPennTree& tree, const WeberPennStem& stem) {
  return stem.length / tree.level(stem.level).curve_res;
}

/// Returns the radius at the share `z` of the length.
double radius_at(const WeberPennTree& tree, const WeberPennStem& stem, double z);

/// Returns the frame of segment `segment` of a stem, from that of the segment before it.
Frame next_frame(const WeberPennTree& tree, const WeberPennStem& stem, const Frame& frame, int segment);

/// Returns the frame turned by the wind.
Frame swayed_frame(const WeberPennTree& tree, const WeberPennStem& stem, const Frame& frame, int segment);

/// How many children or leaves a whole stem bears; not rounded.
double child_count(const WeberPennTree& tree, const WeberPennStem& stem);

/// Degrees between the stem and a child or leaf at `offset`, without random variation.
double down_angle_at(const WeberPennTree& tree, const WeberPennStem& stem, double offset);

/// Degrees about the stem of its child or leaf `number`, without random variation.
inline double rotation_of(const WeberPennLevel& level, int number) {
  return level.rotate >= 0 ? number * level.rotate : (number & 1) * 180.0 + level.rotate;
}

/// Length of a child at `offset` before pruning; `longest` is the paper's length_child,max.
double child_length(const WeberPennTree& tree, const WeberPennStem& stem, double offset, double longest);

/// Radius of a child of this length at `offset`.
double child_radius(const WeberPennTree& tree, const WeberPennStem& stem, double offset, double length);

/// Shortens a stem so that it stays within the envelope, by the share PruneRatio. Returns false if nothing is
/// left. `frames` is memory that calls reuse.
bool prune(const WeberPennTree& tree, WeberPennStem& stem, std::vector<Frame>& frames);

/// Whether a stem is left out because of its size. This is a stem without length. With the counting of
/// Arbaro, it is a stem of at most 0.5 mm, or with a radius of at most 0.05 mm.
bool is_too_small(const WeberPennTree& tree, const WeberPennStem& stem);

/// Returns the rounding error of the number of splits after the segments from `segment` on and after the clones that
/// split off them.
/// Arbaro passes this error from stem to stem of a level. A clone receives it before the rest of the stem
/// from which it splits off. Cost: that of the segments, at most 10,000.
double carried_behind(const WeberPennLevel& level, double carried, int segment);

/// Returns the rounding error of splits before the first child of a stem or of a clone.
double carried_before_children(const WeberPennTree& tree, const WeberPennStem& stem);

/// The end of a segment of a stem.
struct SegmentEnd {
  glm::dvec3 position{0};
  int segment = 0;
  std::uint32_t joint = Limbs::none;  ///< joint from which clones grow
};

/// Divides a stem at the end of a segment: appends its clones to `clones`, and turns the frame of the stem itself. Does
/// nothing where it does not split.
void split(const WeberPennTree& tree, WeberPennStem& stem, Frame& frame, const SegmentEnd& end,
           std::vector<WeberPennStem>& clones);

}  // namespace seedmesh::tree
