#include "core/generators/tree/weber_penn_grow.h"

#include <bit>
#include <cmath>

namespace seedmesh::tree {
namespace {

// Pieces of one turn of a helix (negative nCurveV).
constexpr int helix_pieces = 6;
// The trunk has joints at these shares of its length, because its flare is curved; the flare ends at an
// eighth.
constexpr double flare_stations[] = {0.0, 1.0 / 128, 1.0 / 48, 1.0 / 24, 1.0 / 12, 1.0 / 8};
// A wider flare has further ones.
constexpr double wide_flare = 1.25;
constexpr double wide_flare_stations[] = {1.0 / 256, 1.0 / 72, 1.0 / 32, 1.0 / 16, 5.0 / 48};

/// A straight part of a segment. Offsets are metres from the base of the stem.
struct Piece {
  Frame frame;
  glm::dvec3 from{0};
  double begin = 0, end = 0;  ///< offsets
  glm::dvec3 at(double offset) const { return from + frame.heading * (offset - begin); }
};

/// The state of the stem that grows.
struct Walk {
  explicit Walk(WeberPennStem& of) : stem(of) {}
  WeberPennStem& stem;
  bool is_written = true;  ///< false: it is too thin for the bark, and has no joints
  bool marks_feet = true;  ///< has a joint wherever a child begins
  std::uint32_t last_joint = Limbs::none;
  double last_radius = 0;
  bool starts = true;                           ///< its first joint is yet to be written
  std::size_t first_child = 0, next_child = 0;  ///< the latter has no joint yet; both index `waiting`
  Rng leaf_random{0}, child_random{0};
  int count = 0;  ///< number of children or leaves on the whole stem
  double spacing = 0, bare = 0;
  double longest_child = 0;   ///< the paper's length_child,max
  double carried_splits = 0;  ///< rounding error of the next child, where Arbaro counts
};

std::uint64_t whole(double x) { return static_cast<std::uint64_t>(math::to_int64(x)); }

/// The number of children or leaves. Arbaro rounds numbers of branches down, and carries the rounding error of leaves from
/// limb to limb; here, chance rounds them.
int whole_count(const WeberPennTree& tree, const WeberPennStem& stem) {
  const double count = child_count(tree, stem);
  if (!tree.counts_as_arbaro()) return math::to_int32(std::floor(count + 0.5));
  const bool has_leaves = is_last(tree, stem) && tree.params.Leaves > 0;
  const double up = has_leaves                               ? Rng(stem.rng.at(name_key("rounding"))).unit()
                    : is_last(tree, stem) || stem.level == 0 ? 0.5
                                                             : 1e-9;
  return math::to_int32(std::floor(count + up));
}

Walk begin(const WeberPennGrowth& growth, WeberPennStem& stem) {
  const WeberPennTree& tree = growth.tree;
  const TreeParams& params = tree.params;
  Walk walk(stem);
  walk.is_written = stem.level == 0 || !growth.writer.leaves_out(stem.radius);
  walk.last_joint = stem.joint;
  if (walk.is_written)
    walk.last_radius = radius_at(tree, stem, stem.segment * segment_length(tree, stem) / stem.length);
  walk.bare = stem.level == 0 ? std::min(tree.bare_length(), 0.99 * stem.length)
                              : tree.level(stem.level).bare * stem.length;
  walk.count = whole_count(tree, stem);
  const bool has_fan = is_last(tree, stem) && params.Leaves < 0;
  walk.spacing = walk.count > 0 && !has_fan ? (stem.length - walk.bare) / walk.count : 0;
  walk.first_child = walk.next_child = growth.waiting.size();
  if (is_last(tree, stem)) {
    walk.leaf_random = tree.random.leaves.at(stem.rng.key());
    return walk;
  }
  const bool is_trunk = stem.level == 0 && stem.segment == 0 && stem.trunk == 0;
  const Rng own = stem.level == 0 ? tree.random.branches.at(is_trunk ? 0 : stem.rng.key()) : stem.rng;
  walk.child_random = own.at(name_key("child"));
  const WeberPennLevel& next = tree.level(stem.level + 1);
  walk.carried_splits = carried_before_children(tree, stem);
  walk.longest_child =
      std::max(0.0, next.length + spread(stem.rng.at(name_key("child_length")), next.length_v));
  // Children that the bark leaves out need no joints where they are closer together than the stem is thick.
  walk.marks_feet = walk.is_written &&
                    (stem.level == 0 || walk.spacing > 2 * stem.radius || growth.writer.marks_every_foot() ||
                     stem.radius * power(walk.longest_child, params.RatioPower) >= params.twig_radius);
  return walk;
}

/// Fills growth.offsets with the offsets of the children or leaves on a piece. Returns the number of the
/// first.
int find_offsets(WeberPennGrowth& growth, Walk& walk, const Piece& piece) {
  WeberPennStem& stem = walk.stem;
  growth.offsets.clear();
  const int first = stem.children_before;
  double offset = std::max(piece.begin, walk.bare);
  if (!(walk.spacing > 0) || !(offset < piece.end)) return first;
  const double whole_step = walk.spacing / stem.share;
  double step =
      stem.carried_children == 0 ? whole_step : (1 - stem.carried_children) * walk.spacing / stem.share;
  for (; offset + step <= piece.end; step = whole_step) {
    offset += step;
    growth.offsets.push_back(offset);
  }
  const double carried = growth.offsets.empty() ? stem.carried_children : 0;
  stem.carried_children = carried + (piece.end - offset) * stem.share / walk.spacing;
  stem.children_before += static_cast<int>(growth.offsets.size());
  return first;
}

/// Moves offsets of children toward the beginning of a piece (nBranchDist), and gathers them in whorls. Returns the
/// number of the first child.
int gather(WeberPennGrowth& growth, const Walk& walk, const Piece& piece, int first) {
  const WeberPennLevel& level = growth.tree.level(walk.stem.level + 1);
  std::vector<double>& offsets = growth.offsets;
  const double from = std::max(piece.begin, walk.bare);
  if (level.spread < 1) {
    for (double& offset : offsets) offset = from + (offset - from) * level.spread;
  }
  if (level.whorl <= 1) return first;
  // A whorl is where its last limb would be. Those left over at the tip are too few for one.
  growth.steps.assign(offsets.begin(), offsets.end());
  offsets.clear();
  int number = first;
  for (const double offset : growth.steps) {
    if (++number % level.whorl == 0)
      offsets.insert(offsets.end(), static_cast<std::size_t>(level.whorl), offset);
  }
  return first / level.whorl * level.whorl;
}

/// Puts the children on a piece on the stack.
void add_children(WeberPennGrowth& growth, Walk& walk, const Piece& piece) {
  const WeberPennTree& tree = growth.tree;
  const WeberPennStem& stem = walk.stem;
  const WeberPennLevel& level = tree.level(stem.level + 1);
  int number = find_offsets(growth, walk, piece);
  if (level.spread < 1 || level.whorl > 1) number = gather(growth, walk, piece, number);
  for (const double offset : growth.offsets) {
    const Rng rng = walk.child_random.at(static_cast<std::uint64_t>(number));
    const double about = rotation_of(level, number / level.whorl) +
                         360.0 / level.whorl * (number % level.whorl) +
                         spread(rng.at(name_key("rotate")), level.rotate_v);
    ++number;
    const double length = child_length(tree, stem, offset, walk.longest_child);
    if (!(length > 0)) continue;
    const double down = down_angle_at(tree, stem, offset) +
                        spread(rng.at(name_key("down")), std::max(0.0, level.down_angle_v));
    WeberPennStem& child = growth.waiting.emplace_back();
    child.frame =
        pitch(roll(piece.frame, math::quick_sincos_degrees(about)), math::quick_sincos_degrees(down));
    child.position = piece.at(offset);
    child.joint = walk.last_joint;
    child.level = stem.level + 1;
    child.length = length;
    child.offset = offset;
    child.parent_length = stem.length;
    child.parent_length_max = walk.longest_child;
    child.rng = rng;
    child.carried_splits =
        tree.counts_as_arbaro() ? walk.carried_splits : spread(rng.at(name_key("splits")), 0.5);
    if (tree.counts_as_arbaro()) walk.carried_splits = carried_behind(level, walk.carried_splits, 0);
    const bool fits = !(tree.params.PruneRatio > 0) || prune(tree, child, growth.trial_frames);
    child.radius = child_radius(tree, stem, offset, child.length);
    if (!fits || is_too_small(tree, child)) {
      growth.waiting.pop_back();
      continue;
    }
    if (walk.marks_feet) growth.stops.push_back(offset);
  }
}

/// Puts the leaves on a piece into the batch of those that wait for their frames.
void add_leaves(WeberPennGrowth& growth, Walk& walk, const Piece& piece) {
  const int first = find_offsets(growth, walk, piece);
  if (growth.offsets.empty()) return;
  const std::size_t count = growth.offsets.size();
  growth.writer.count_leaves(count);
  const WeberPennLevel& level = growth.tree.level(walk.stem.level + 1);
  const glm::quat frame = quaternion(piece.frame);
  std::size_t joint = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int number = first + static_cast<int>(i);
    const std::uint64_t key = walk.leaf_random.at(static_cast<std::uint64_t>(number)).key();
    if (!growth.writer.draws(key)) continue;
    const double offset = growth.offsets[i];
    while (growth.joints[joint].offset < offset) ++joint;
    const double down =
        level.down_angle_v >= 0 ? level.down_angle : down_angle_at(growth.tree, walk.stem, offset);
    growth.leaves.add(frame, piece.at(offset), growth.joints[joint].joint,
                      {rotation_of(level, number), down, key});
    if (growth.leaves.is_full()) write_leaves(growth);
  }
}

/// Adds all leaves of a stem at its end, side by side (negative Leaves).
void add_fan(WeberPennGrowth& growth, const Walk& walk, const Frame& frame, const glm::dvec3& at) {
  const WeberPennLevel& level = growth.tree.level(walk.stem.level + 1);
  const TreeParams& params = growth.tree.params;
  const double count = -params.Leaves;
  for (int i = 0; i < walk.count; ++i) {
    const std::uint64_t key = walk.leaf_random.at(static_cast<std::uint64_t>(i)).key();
    if (!growth.writer.wants_leaf(key)) continue;
    const double across = count > 1 ? level.rotate * (i / (count - 1) - 0.5) : 0;
    SkeletonWriter::Leaf leaf;
    leaf.frame =
        pitch(turn(frame, math::quick_sincos_degrees(across)), math::quick_sincos_degrees(level.down_angle));
    if (params.LeafBend != 0) leaf.frame = turned_to_light(leaf.frame, at, params.LeafBend);
    leaf.frame = upper_side_up(leaf.frame);
    leaf.position = at;
    leaf.length = params.LeafScale;
    leaf.width = params.LeafScale * params.LeafScaleX;
    leaf.joint = walk.last_joint;
    leaf.key = key;
    growth.writer.add(leaf);
  }
}

/// Adds stops where the radius of a straight piece does not fall evenly. Returns whether there are any.
bool add_bends(WeberPennGrowth& growth, const WeberPennStem& stem, const Piece& piece, int segment) {
  const WeberPennLevel& level = growth.tree.level(stem.level);
  std::vector<double>& stops = growth.stops;
  const auto add = [&](std::span<const double> stations) {
    for (const double share : stations) {
      const double stop = share * stem.length, least = 1e-6 * stem.length;
      if (stop > piece.begin + least && stop < piece.end - least) stops.push_back(stop);
    }
  };
  if (stem.level == 0) {
    add(flare_stations);
    if (piece.begin <= stem.length / 8 && flared_trunk(growth.tree.params, 0) > 1 + wide_flare)
      add(wide_flare_stations);
  }
  if (level.taper > 1) {
    const int parts = level.taper > 2 ? 6 : segment + 1 == level.curve_res ? 4 : 0;
    for (int i = 1; i < parts; ++i) stops.push_back(piece.begin + (piece.end - piece.begin) * i / parts);
  }
  return !stops.empty();
}

/// Writes a joint at each stop, and gives it to the children that begin before it.
void write_joints(WeberPennGrowth& growth, Walk& walk, const Piece& piece) {
  const WeberPennStem& stem = walk.stem;
  growth.joints.clear();
  double before = piece.begin;
  for (const double stop : growth.stops) {
    if (stop <= before + 1e-9 * stem.length && stop < piece.end) continue;
    SkeletonWriter::Joint joint;
    joint.parent = walk.last_joint;
    joint.position = piece.at(stop);
    joint.base_radius = walk.last_radius;
    joint.radius = walk.last_radius = radius_at(growth.tree, stem, std::min(1.0, stop / stem.length));
    joint.starts_limb = walk.starts && (stem.level > 0 || stem.segment > 0);
    joint.order = stem.level;
    joint.key = stem.rng.at(whole(65536 * stop / stem.length)).key();
    walk.last_joint = growth.writer.add(joint);
    walk.starts = false;
    before = stop;
    std::vector<WeberPennStem>& waiting = growth.waiting;
    for (; walk.next_child < waiting.size() && waiting[walk.next_child].offset <= stop; ++walk.next_child)
      waiting[walk.next_child].joint = walk.last_joint;
    growth.joints.push_back({stop, walk.last_joint});
  }
}

/// The frame of one piece: that of the axis, or on a helix about it.
Frame piece_frame(const WeberPennLevel& level, const Frame& axis, int piece) {
  if (level.curve_v >= 0) return axis;
  const Frame around = roll(axis, math::quick_sincos_degrees(360.0 / helix_pieces * piece));
  return pitch(around, math::quick_sincos_degrees(-level.curve_v));
}

/// Writes the joints and leaves of a segment that begins at `at`, and puts its children on the stack. Returns
/// where it ends.
glm::dvec3 walk_segment(WeberPennGrowth& growth, Walk& walk, const Frame& axis, int segment,
                        const glm::dvec3& at) {
  const WeberPennLevel& level = growth.tree.level(walk.stem.level);
  const int pieces =
      level.curve_v < 0 ? std::max(1, (helix_pieces + level.curve_res - 1) / level.curve_res) : 1;
  const double length = segment_length(growth.tree, walk.stem);
  const bool bears_leaves = is_last(growth.tree, walk.stem);
  Piece piece;
  piece.from = at;
  piece.begin = segment * length;
  for (int i = 0; i < pieces; ++i) {
    piece.frame = piece_frame(level, axis, segment * pieces + i);
    piece.end = i + 1 == pieces ? (segment + 1) * length : piece.begin + length / pieces;
    growth.stops.clear();
    const bool bends = walk.is_written && add_bends(growth, walk.stem, piece, segment);
    if (!bears_leaves) add_children(growth, walk, piece);
    if (walk.is_written) {
      growth.stops.push_back(piece.end);
      if (bends) std::sort(growth.stops.begin(), growth.stops.end());
      write_joints(growth, walk, piece);
    } else {
      growth.writer.pass_over(piece.at(piece.end));
      growth.joints.assign(1, {piece.end, walk.last_joint});
    }
    if (bears_leaves) add_leaves(growth, walk, piece);
    piece.from = piece.at(piece.end);
    piece.begin = piece.end;
  }
  return piece.from;
}

/// As grow_stem(), but changes the stem.
void grow(WeberPennGrowth& growth, WeberPennStem& stem) {
  if (!(stem.length > 0)) return;
  const WeberPennTree& tree = growth.tree;
  const WeberPennLevel& level = tree.level(stem.level);
  growth.clones.clear();
  Walk walk = begin(growth, stem);
  Frame frame = stem.frame;
  glm::dvec3 at = stem.position;
  for (int segment = stem.segment; segment < level.curve_res; ++segment) {
    if (segment > (tree.counts_as_arbaro() ? 0 : stem.segment)) {
      frame = next_frame(tree, stem, frame, segment);
      if (tree.sways()) frame = swayed_frame(tree, stem, frame, segment);
    }
    at = walk_segment(growth, walk, frame, segment, at);
    // Below a half, the error that is carried splits nothing by itself.
    const bool may_split = level.seg_splits > 0 || stem.level == 0;
    if (may_split && segment + 1 < level.curve_res)
      split(tree, stem, frame, {at, segment, walk.last_joint}, growth.clones);
  }
  if (is_last(tree, stem) && tree.params.Leaves < 0) add_fan(growth, walk, frame, at);
  growth.waiting.insert(growth.waiting.begin() + static_cast<std::ptrdiff_t>(walk.first_child),
                        growth.clones.begin(), growth.clones.end());
}

/// Is the stem a straight one of the last level, of which only leaves are made?
bool is_twig(const WeberPennGrowth& growth, const WeberPennStem& stem) {
  const WeberPennTree& tree = growth.tree;
  const WeberPennLevel& level = tree.level(stem.level);
  return is_last(tree, stem) && stem.level > 0 && level.curve_res == 1 && level.bare == 0 &&
         !tree.counts_as_arbaro() && tree.params.LeafDistrib == 4 && level.curve_v >= 0 &&
         tree.params.Leaves >= 0 && tree.params.Leaves <= static_cast<int>(WeberPennTwigs::most_leaves) &&
         growth.writer.leaves_out(stem.radius);
}

/// Grows the twigs at the end of `waiting`, several at once.
void grow_twigs(WeberPennGrowth& growth) {
  const WeberPennTree& tree = growth.tree;
  const WeberPennLevel& level = tree.level(tree.params.Levels);
  std::vector<WeberPennStem>& waiting = growth.waiting;
  WeberPennTwigs& twigs = growth.twigs;
  twigs.clear();
  for (std::size_t i = waiting.size(); i-- > 0 && !twigs.is_full() && is_twig(growth, waiting[i]);) {
    const WeberPennStem& stem = waiting[i];
    twigs.add(std::max(0.0, stem.length), stem.parent_length > 0 ? stem.offset / stem.parent_length : 0,
              stem.rng.key());
  }
  twigs.find_leaves(tree.random.leaves, tree.params.Leaves,
                    static_cast<std::int64_t>(growth.writer.drawn_below()));
  for (std::size_t i = 0; i < twigs.size(); ++i, waiting.pop_back()) {
    const WeberPennStem& stem = waiting.back();
    if (!(stem.length > 0)) continue;
    growth.writer.pass_over(stem.position + stem.frame.heading * stem.length);
    if (twigs.count(i) > 0) growth.writer.count_leaves(twigs.count(i));
    if (twigs.drawn(i) == 0) continue;
    const glm::quat frame = quaternion(stem.frame);
    for (std::uint64_t drawn = twigs.drawn(i); drawn != 0; drawn &= drawn - 1) {
      const auto leaf = static_cast<std::size_t>(std::countr_zero(drawn));
      const double offset = twigs.offset(i, leaf);
      const double down = level.down_angle_v >= 0 ? level.down_angle : down_angle_at(tree, stem, offset);
      growth.leaves.add(frame, stem.position + stem.frame.heading * offset, stem.joint,
                        {rotation_of(level, static_cast<int>(leaf)), down, twigs.leaf_key(i, leaf)});
      if (growth.leaves.is_full()) write_leaves(growth);
    }
  }
}

}  // namespace

void grow_stem(WeberPennGrowth& growth, WeberPennStem stem) { grow(growth, stem); }

void grow_waiting(WeberPennGrowth& growth) {
  while (!growth.waiting.empty()) {
    if (is_twig(growth, growth.waiting.back())) {
      grow_twigs(growth);
      continue;
    }
    WeberPennStem stem = growth.waiting.back();
    growth.waiting.pop_back();
    grow(growth, stem);
  }
  write_leaves(growth);
}

void write_leaves(WeberPennGrowth& growth) {
  if (growth.leaves.size() == 0) return;
  const TreeParams& params = growth.tree.params;
  const WeberPennLevel& level = growth.tree.level(params.Levels);
  const LeafFrames::Options options{params.LeafBend, level.rotate_v, std::max(0.0, level.down_angle_v)};
  const double length = params.LeafScale, width = length * params.LeafScaleX;
  growth.leaves.write(options, glm::vec3(width, length, length), growth.writer.extend(growth.leaves.size()));
  growth.leaves.clear();
}

}  // namespace seedmesh::tree
