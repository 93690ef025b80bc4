#include "core/generators/tree/weber_penn_stem.h"

#include <cmath>

#include "core/generators/tree/sway.h"

namespace seedmesh::tree {
namespace {

// Pruning tries a stem at this share of its length again and again, and removes it below the least share.
constexpr double prune_step = 0.9, prune_least = 0.15;
// Arbaro shortens limbs to this share of the height of the tree, and leaves out those of less than half a millimetre.
constexpr double prune_least_arbaro = 0.001, least_stem_arbaro = 0.0005, least_radius_arbaro = 0.00005;
constexpr int most_prune_steps = 100'000;
constexpr int most_split_steps = 10'000;
// Rounding errors of this number of stems of a level are kept; they recur after few stems.
constexpr std::size_t kept_errors = 32;

/// Degrees between one segment and the next, without random variation.
double curve_before(const WeberPennLevel& level, int segment) {
  if (level.curve_back == 0 || level.curve_res <= 1) return level.curve / level.curve_res;
  return (2 * segment <= level.curve_res ? level.curve : level.curve_back) / (0.5 * level.curve_res);
}

/// The frame of segment `segment` of Arbaro, from that of the segment before it. A random bend is about any axis across the
/// stem, and the attraction to the sky about a horizontal one.
Frame next_frame_of_arbaro(const WeberPennTree& tree, const WeberPennStem& stem, const Frame& frame,
                           int segment) {
  const WeberPennLevel& level = tree.level(stem.level);
  double curve = level.curve / level.curve_res;
  if (level.curve_back != 0)
    curve = 2 * (segment < (level.curve_res + 1) / 2 ? level.curve : level.curve_back) / level.curve_res;
  Frame bent = pitch(frame, math::quick_sincos_degrees(curve - stem.uncurve));
  if (level.curve_v > 0) {
    Rng random = stem.rng.at(name_key("curve")).at(static_cast<std::uint64_t>(segment));
    const math::SinCos bend =
        math::quick_sincos_degrees(random.uniform(-1, 1) * level.curve_v / level.curve_res);
    bent = rotated(bent, roll(bent, math::quick_sincos_degrees(random.uniform(0, 360))).up, bend);
  }
  const glm::dvec3 across = glm::cross(bent.heading, glm::dvec3(0, 1, 0));
  const double width = std::sqrt(glm::dot(across, across));
  if (stem.level < 2 || tree.params.AttractionUp == 0 || !(width > 1e-9)) return bent;
  // The width is the sine of the declination.
  const double declination = approximate_acos(std::clamp(bent.heading.y, -1.0, 1.0));
  const double up = math::degrees(tree.params.AttractionUp * declination * width) / level.curve_res;
  return rotated(bent, across / width, math::quick_sincos_degrees(up));
}

/// Degrees by which the attraction to the sky bends each of `segments` segments.
double attraction_angle(const Frame& frame, double attraction, int segments) {
  const double declination = approximate_acos(std::clamp(frame.heading.y, -1.0, 1.0));
  return math::degrees(attraction * declination * std::clamp(frame.up.y, -1.0, 1.0)) / segments;
}

/// Does the stem stay within the envelope at this length? Its bends are the same at any length: `frames` has
/// those of the segments after the first, as far as they are known.
bool fits_envelope(const WeberPennTree& tree, const WeberPennStem& stem, double length,
                   std::vector<Frame>& frames) {
  const int segments = tree.level(stem.level).curve_res;
  const double step = length / segments;
  glm::dvec3 at = stem.position;
  for (int segment = 0; segment < segments; ++segment) {
    if (static_cast<std::size_t>(segment) > frames.size())
      frames.push_back(next_frame(tree, stem, frames.empty() ? stem.frame : frames.back(), segment));
    at += (segment == 0 ? stem.frame : frames[static_cast<std::size_t>(segment - 1)]).heading * step;
    if (!is_in_envelope(tree.params, tree.scale, std::sqrt(at.x * at.x + at.z * at.z), at.y)) return false;
  }
  return true;
}

/// Returns how many clones split off, and carries the rounding error along the stem.
int count_clones(const WeberPennLevel& level, WeberPennStem& stem) {
  const double wanted = level.seg_splits * stem.readiness + stem.carried_splits;
  const int clones = std::max(0, static_cast<int>(math::to_int32(std::floor(wanted + 0.5))));
  stem.carried_splits = wanted - clones;
  return clones;
}

void keep_carried_errors(WeberPennTree& tree) {
  for (std::size_t i = 0; i < tree.levels.size(); ++i) {
    std::vector<double>& errors = tree.carried_before[i];
    errors.clear();
    if (!(tree.levels[i].seg_splits > 0)) continue;
    errors.push_back(0);
    while (errors.size() < kept_errors) errors.push_back(carried_behind(tree.levels[i], errors.back(), 0));
  }
}

}  // namespace

double carried_before_children(const WeberPennTree& tree, const WeberPennStem& stem) {
  const Rng random = stem.rng.at(name_key("child_splits"));
  if (!tree.counts_as_arbaro()) return stem.level > 0 ? spread(random, 0.5) : 0;
  const std::vector<double>& errors =
      tree.carried_before[static_cast<std::size_t>(std::min(stem.level + 1, 3))];
  if (errors.empty()) return 0;
  // Arbaro makes the children of a clone of the trunk right after those before it; any number of stems is before others.
  const bool counts_on = stem.level == 0 && stem.trunk == 0 && tree.params.base_splits == 0;
  const auto before = counts_on ? static_cast<std::uint64_t>(stem.children_before) : random.key();
  return errors[before % errors.size()];
}

WeberPennStem make_trunk(WeberPennTree& tree, int number) {
  const TreeParams& p = tree.params;
  const WeberPennLevel& level = tree.levels[0];
  WeberPennStem stem;
  stem.trunk = number;
  stem.rng = tree.random.trunk;
  if (number == 0) {
    tree.scale = std::max(0.1 * p.Scale, p.Scale + spread(stem.rng.at("scale"), p.ScaleV));
  } else {
    stem.rng = stem.rng.at("trunks").at(static_cast<std::uint64_t>(number));
  }
  stem.length = std::max(0.0, (level.length + spread(stem.rng.at("length"), level.length_v))) * tree.scale;
  const double factor = std::max(0.05, p.trunk_scale + spread(stem.rng.at("radius"), p.trunk_scale_v));
  stem.radius = stem.length * p.Ratio * factor;
  stem.parent_length = stem.length;
  stem.parent_length_max = 1;
  stem.frame = roll(Frame{}, math::quick_sincos_degrees(stem.rng.at("roll").uniform(0, 360)));
  if (tree.counts_as_arbaro()) {
    if (number == 0) {
      tree.carried_splits = 0;
      keep_carried_errors(tree);
    }
    stem.carried_splits = tree.carried_splits;
    for (int i = 0; i <= p.base_splits; ++i)
      tree.carried_splits = carried_behind(level, tree.carried_splits, p.base_splits > 0 ? 1 : 0);
  }
  if (p.branches_0 > 1 && p.branch_dist_0 > 0) {
    const double away = p.branch_dist_0 * Rng(stem.rng.at("distance")).unit();
    const math::SinCos to = math::quick_sincos_degrees(Rng(stem.rng.at("direction")).uniform(0, 360));
    stem.position = {away * to.cos, 0, away * to.sin};
  }
  return stem;
}

double radius_at(const WeberPennTree& tree, const WeberPennStem& stem, double z) {
  const double radius = tapered(tree.level(stem.level).taper, stem.radius, stem.length, z);
  return stem.level > 0 ? radius : radius * flared_trunk(tree.params, z);
}

Frame next_frame(const WeberPennTree& tree, const WeberPennStem& stem, const Frame& frame, int segment) {
  if (tree.counts_as_arbaro()) return next_frame_of_arbaro(tree, stem, frame, segment);
  const WeberPennLevel& level = tree.level(stem.level);
  const double attraction = tree.params.AttractionUp;
  double curve = curve_before(level, segment);
  if (level.curve_v > 0) {
    const Rng random = stem.rng.at(name_key("curve")).at(static_cast<std::uint64_t>(segment));
    curve += spread(random, level.curve_v) / level.curve_res;
  }
  curve -= stem.uncurve;
  if (stem.level >= 2 && attraction != 0) curve -= attraction_angle(frame, attraction, level.curve_res);
  return pitch(frame, math::quick_sincos_degrees(std::clamp(curve, -170.0, 170.0)));
}

Frame swayed_frame(const WeberPennTree& tree, const WeberPennStem& stem, const Frame& frame, int segment) {
  const WeberPennLevel& level = tree.level(stem.level);
  Rng random = stem.rng.at(name_key("sway"));
  SwayingStem swaying;
  swaying.length = stem.length;
  swaying.base_radius = stem.radius;
  swaying.segments = level.curve_res;
  swaying.offset_x = random.uniform(0, 2 * math::pi);
  swaying.offset_y = random.uniform(0, 2 * math::pi);
  const double z = static_cast<double>(segment) / level.curve_res;
  const double radius = tapered(level.taper, stem.radius, stem.length, z);
  return swayed(frame, sway_angles(tree.params.sway, swaying, z, radius));
}

namespace {

/// The number of children in Blender's Sapling: it follows from the length of a stem, and those below its base are left out.
double child_count_of_sapling(const WeberPennTree& tree, const WeberPennStem& stem) {
  const bool has_leaves = is_last(tree, stem);
  if (has_leaves && tree.params.Leaves < 0) return std::abs(tree.params.Leaves);
  double most = has_leaves ? tree.params.Leaves : tree.level(stem.level + 1).branches;
  double longest = tree.scale;
  for (int level = 0; level <= stem.level; ++level) longest *= tree.level(level).length;
  if (stem.level > 0) most *= 0.1 + 0.9 * stem.length / std::max(longest, 1e-9);
  const double share = stem.parent_length > 0 ? stem.offset / stem.parent_length : 0;
  if (has_leaves && stem.level > 0) most *= shape_ratio(tree.params, tree.params.LeafDistrib, 1 - share);
  const double bare = has_leaves ? 0 : stem.level == 0 ? tree.params.BaseSize : tree.level(stem.level).bare;
  const double count = std::floor(most + 0.5);
  return count - std::floor(bare * (count + 1));
}

}  // namespace

double child_count(const WeberPennTree& tree, const WeberPennStem& stem) {
  if (tree.params.counting == TreeParams::Counting::sapling) return child_count_of_sapling(tree, stem);
  if (is_last(tree, stem)) {
    const double most = std::abs(tree.params.Leaves);
    const double share = stem.parent_length > 0 ? stem.offset / stem.parent_length : 0;
    if (tree.params.Leaves < 0 && !tree.counts_as_arbaro()) return most;
    return most * shape_ratio(tree.params, tree.params.LeafDistrib, share);
  }
  const double most = tree.level(stem.level + 1).branches;
  if (stem.level == 0) return most;
  if (stem.parent_length <= 0) return 0;
  if (stem.level == 1) {
    const double longest = std::max(stem.parent_length_max, 1e-6);
    return most * (0.2 + 0.8 * std::min(1.0, stem.length / stem.parent_length / longest));
  }
  return most * (1 - 0.5 * stem.offset / stem.parent_length);
}

double down_angle_at(const WeberPennTree& tree, const WeberPennStem& stem, double offset) {
  const WeberPennLevel& level = tree.level(stem.level + 1);
  if (level.down_angle_v >= 0) return level.down_angle;
  const double bare = stem.level == 0 ? tree.bare_length() : tree.level(stem.level).bare * stem.length;
  const double crown = std::max(1e-9, stem.length - bare);
  const double ratio = shape_ratio(tree.params, 0, (stem.length - offset) / crown);
  return level.down_angle + level.down_angle_v * (1 - 2 * ratio);
}

double child_length(const WeberPennTree& tree, const WeberPennStem& stem, double offset, double longest) {
  if (stem.level > 0 && tree.params.counting == TreeParams::Counting::sapling) {
    const double bearing = std::max(1e-9, stem.length * (1 - tree.level(stem.level).bare));
    return longest * stem.length * (0.5 + 0.5 * std::min(1.0, (stem.length - offset) / bearing));
  }
  if (stem.level > 0) return longest * (stem.length - 0.6 * offset);
  const double crown = std::max(1e-9, stem.length - tree.bare_length());
  const double ratio = shape_ratio(tree.params, tree.params.crown_shape, (stem.length - offset) / crown);
  return stem.length * longest * ratio;
}

double child_radius(const WeberPennTree& tree, const WeberPennStem& stem, double offset, double length) {
  const double ratio = std::max(0.0, length / stem.length);
  return std::min(radius_at(tree, stem, offset / stem.length),
                  stem.radius * power(ratio, tree.params.RatioPower));
}

namespace {

/// The first segment at whose end a stem or one of its clones is outside of the envelope; -1: there is none. Each clone
/// is checked before the rest of its stem.
int segment_outside(const WeberPennTree& tree, WeberPennStem stem, int& steps) {
  const WeberPennLevel& level = tree.level(stem.level);
  const double length = segment_length(tree, stem);
  std::vector<WeberPennStem> clones;
  Frame frame = stem.frame;
  glm::dvec3 at = stem.position;
  for (int segment = stem.segment; segment < level.curve_res && steps > 0; ++segment, --steps) {
    if (segment > 0) frame = next_frame(tree, stem, frame, segment);
    at += frame.heading * length;
    if (!is_in_envelope(tree.params, tree.scale, std::sqrt(at.x * at.x + at.z * at.z), at.y)) return segment;
    if (!(level.seg_splits > 0) || segment + 1 >= level.curve_res) continue;
    clones.clear();
    split(tree, stem, frame, {at, segment}, clones);
    for (std::size_t i = clones.size(); i-- > 0;) {
      const int outside = segment_outside(tree, clones[i], steps);
      if (outside >= 0) return outside;
    }
  }
  return -1;
}

/// Arbaro shortens a stem to the segment that is outside, until the stem and its clones are inside. Each step removes
/// at most half of its length, and at least a fifteenth of the whole length.
bool prune_as_arbaro(const WeberPennTree& tree, WeberPennStem& stem) {
  const double whole = stem.length;
  int steps = most_prune_steps;
  for (int outside = segment_outside(tree, stem, steps);
       outside >= 0 && stem.length > prune_least_arbaro * tree.scale;
       outside = segment_outside(tree, stem, steps)) {
    const double to_there = std::max(segment_length(tree, stem) * outside, stem.length / 2);
    stem.length = std::max(0.0, std::min(to_there, stem.length - whole / 15));
  }
  stem.length = whole - (whole - stem.length) * tree.params.PruneRatio;
  return stem.length > least_stem_arbaro;
}

}  // namespace

bool prune(const WeberPennTree& tree, WeberPennStem& stem, std::vector<Frame>& frames) {
  if (tree.counts_as_arbaro()) return prune_as_arbaro(tree, stem);
  const double whole = stem.length, least = prune_least * whole;
  double fitted = whole;
  frames.clear();
  while (fitted > least && !fits_envelope(tree, stem, fitted, frames)) fitted *= prune_step;
  if (!(fitted > least)) fitted = 0;
  stem.length = whole - (whole - fitted) * tree.params.PruneRatio;
  return stem.length > 1e-6 * whole;
}

bool is_too_small(const WeberPennTree& tree, const WeberPennStem& stem) {
  if (!tree.counts_as_arbaro()) return !(stem.length > 0);
  return !(stem.length > least_stem_arbaro && stem.radius > least_radius_arbaro);
}

namespace {

double carried_behind_part(const WeberPennLevel& level, double carried, int segment, int& steps) {
  for (; segment + 1 < level.curve_res && steps > 0; ++segment) {
    --steps;
    const double wanted = level.seg_splits + carried;
    const int clones = std::max(0, static_cast<int>(math::to_int32(std::floor(wanted + 0.5))));
    carried = wanted - clones;
    for (int i = 0; i < clones && steps > 0; ++i)
      carried = carried_behind_part(level, carried, segment + 1, steps);
  }
  return carried;
}

}  // namespace

double carried_behind(const WeberPennLevel& level, double carried, int segment) {
  if (!(level.seg_splits > 0)) return carried;
  int steps = most_split_steps;
  return carried_behind_part(level, carried, segment, steps);
}

namespace {

/// Divides the children of a stem among it and its clones. Returns the rounding errors of the clones' splits.
std::vector<double> share_among_clones(const WeberPennTree& tree, WeberPennStem& stem, int count, int segment,
                                       bool at_base) {
  std::vector<double> carried(static_cast<std::size_t>(count), 0.0);
  if (tree.counts_as_arbaro()) {
    for (double& each : carried) {
      each = stem.carried_splits;
      stem.carried_splits = carried_behind(tree.level(stem.level), each, segment + 1);
    }
    // Arbaro divides the branches among the clones, but not the leaves.
    if (!is_last(tree, stem)) stem.share /= count + 1;
  } else {
    stem.share /= count + 1;
    stem.readiness = at_base ? stem.readiness : 0.5;
  }
  return carried;
}

}  // namespace

void split(const WeberPennTree& tree, WeberPennStem& stem, Frame& frame, const SegmentEnd& end,
           std::vector<WeberPennStem>& clones) {
  const WeberPennLevel& level = tree.level(stem.level);
  const bool at_base = stem.level == 0 && end.segment == 0 && tree.params.base_splits > 0;
  const int count = at_base ? tree.params.base_splits : count_clones(level, stem);
  if (count == 0) return;
  const Rng rng = stem.rng.at("split").at(static_cast<std::uint64_t>(end.segment));
  const int segments_left = std::max(1, level.curve_res - end.segment - 1);
  const double declination = declination_of(frame);
  const std::vector<double> carried = share_among_clones(tree, stem, count, end.segment, at_base);
  // The frame of one of the stems of a split, and its turn back in each later segment. Number 0 is the stem.
  const auto turned = [&](int number) {
    const Rng own = rng.at(static_cast<std::uint64_t>(number));
    const double angle =
        std::max(0.0, level.split_angle + spread(own.at("angle"), level.split_angle_v) - declination);
    Rng random = own.at("about");
    const double drawn = random.unit();
    double about = 20 + 0.75 * (30 + std::abs(declination - 90)) * drawn * drawn;
    if (random.unit() < 0.5) about = -about;
    if (at_base) about = 360.0 * number / (count + 1);
    Frame result = pitch(frame, math::quick_sincos_degrees(angle));
    if (number > 0 || at_base) result = rotated(result, {0, 1, 0}, math::quick_sincos_degrees(about));
    return std::pair{result, angle / segments_left};
  };
  for (int number = count; number >= 1; --number) {
    WeberPennStem& clone = clones.emplace_back(stem);
    const auto [own_frame, uncurve] = turned(number);
    clone.frame = own_frame;
    clone.position = end.position;
    clone.joint = end.joint;
    clone.segment = end.segment + 1;
    clone.uncurve = stem.uncurve + uncurve;
    clone.rng = rng.at("clone").at(static_cast<std::uint64_t>(number));
    clone.carried_children = clone.rng.at("phase").unit();
    clone.carried_splits = carried[static_cast<std::size_t>(number - 1)];
  }
  const auto [own_frame, uncurve] = turned(0);
  // In Arbaro, only the clones turn away; the stem itself bends like them afterwards.
  if (!tree.counts_as_arbaro()) frame = own_frame;
  stem.uncurve += uncurve;
}

}  // namespace seedmesh::tree
