#include <bit>
#include <cmath>

#include "core/base/wide.h"
#include "core/generators/tree/weber_penn_grower.h"

namespace seedmesh::tree {
namespace {

// A pruned stem is tried at so much of its length again and again, and is left out below the least share.
constexpr double prune_step = 0.9, prune_least = 0.15;

// Lanes of the widest vectors of words; a few leaves too many are looked at rather than one by one.
constexpr std::size_t lanes = 8;

/// Not 0 for those of the leaves from number `first` on that are drawn. Hashes of 53 bits are compared with a
/// sign, as every processor compares several; the flags are as wide, so that few leaves are enough for that.
SEEDMESH_WIDE void find_drawn(const Rng chance, std::uint64_t first, std::int64_t below,
                              std::uint64_t* __restrict drawn, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t hash = key_at(chance.at(first + i).key(), drawn_place) >> 11U;
    drawn[i] = static_cast<std::int64_t>(hash) < below ? 1 : 0;
  }
}

}  // namespace

/// How many children a whole stem bears.
double WeberPennGrower::children_of(const WeberPennStem& stem) const {
  if (is_last(stem)) {
    const double most = std::abs(p_.Leaves);
    if (p_.Leaves < 0) return most;
    return most * shape_ratio(p_, 4, stem.parent_length > 0 ? stem.offset / stem.parent_length : 0);
  }
  const double most = level(stem.level + 1).branches;
  if (stem.level == 0) return most;
  if (stem.parent_length <= 0) return 0;
  if (stem.level == 1) {
    const double most_length = std::max(stem.parent_length_max, 1e-6);
    return most * (0.2 + 0.8 * std::min(1.0, stem.length / stem.parent_length / most_length));
  }
  return most * (1 - 0.5 * stem.offset / stem.parent_length);
}

/// Degrees between the stem and a child or leaf, by chance apart.
double WeberPennGrower::down_at(const WeberPennStem& stem, double offset) const {
  const WeberPennLevel& l = level(stem.level + 1);
  if (l.down_angle_v >= 0) return l.down_angle;
  const double bare = stem.level == 0 ? base_length() : 0;
  const double room = std::max(1e-9, stem.length - bare);
  return l.down_angle + l.down_angle_v * (1 - 2 * shape_ratio(p_, 0, (stem.length - offset) / room));
}

/// Where children or leaves stand on a piece, until it is asked again.
WeberPennGrower::Places WeberPennGrower::find_places(WeberPennStem& stem, const WeberPennPiece& piece) {
  const int first = stem.children_before;
  double from = std::max(piece.along, bare_);
  if (!(spacing_ > 0) || !(from < piece.end)) return {first, {}};
  const double whole = spacing_ / stem.share;
  double step = stem.carried_children == 0 ? whole : (1 - stem.carried_children) * spacing_ / stem.share;
  // The first step may be short, and sums round.
  const auto most = static_cast<std::size_t>(math::to_int64((piece.end - from) / whole)) + 3;
  if (places_.size() < most) places_.resize(most);
  std::size_t count = 0;
  for (; from + step <= piece.end && count < most; step = whole) {
    from += step;
    places_[count++] = from;
  }
  const double carried = count == 0 ? stem.carried_children : 0;
  stem.carried_children = carried + (piece.end - from) * stem.share / spacing_;
  stem.children_before += static_cast<int>(count);
  return {first, {places_.data(), count}};
}

void WeberPennGrower::put_children(WeberPennStem& stem, const WeberPennPiece& piece) {
  const auto [first, places] = find_places(stem, piece);
  // Whether anything is left of a child is known when it is settled.
  const bool may_vanish = p_.PruneRatio > 0;
  const std::size_t before = waiting_.size();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double offset = places[i], length = child_length(stem, offset);
    if (!(length > 0)) continue;
    if (brood_.is_full()) settle(stem);
    bear(stem, piece, offset, length);
    brood_.add(piece.frame, first + static_cast<int>(i), down_at(stem, offset));
    if (marks_feet_ && !may_vanish) stops_.push_back(offset);
  }
  if (!marks_feet_ || !may_vanish) return;
  settle(stem);
  for (std::size_t i = before; i < waiting_.size(); ++i) {
    if (waiting_[i].length > 0) stops_.push_back(waiting_[i].offset);
  }
}

/// A child that waits, as far as it is known before it is settled.
void WeberPennGrower::bear(const WeberPennStem& stem, const WeberPennPiece& piece, double offset,
                           double length) {
  WeberPennStem& child = waiting_.emplace_back();
  child.position = piece.at(offset);
  child.joint = last_joint_;
  child.level = stem.level + 1;
  child.length = length;
  child.offset = offset;
  child.parent_length = stem.length;
  child.parent_length_max = child_max_;
}

/// Where the last children head, and how large they are; 0 in length: there is nothing of it.
void WeberPennGrower::settle(const WeberPennStem& stem) {
  if (brood_.size() == 0) return;
  brood_.reckon(level(stem.level + 1), child_chance_);
  WeberPennStem* const children = waiting_.data() + (waiting_.size() - brood_.size());
  const bool is_straight = p_.PruneRatio > 0 && level(stem.level + 1).curve_res == 1;
  if (is_straight) {
    for (std::size_t i = 0; i < brood_.size(); ++i) brood_.place(i, children[i].position, children[i].length);
    brood_.find_inside(p_, scale_);
  }
  for (std::size_t i = 0; i < brood_.size(); ++i) {
    WeberPennStem& child = children[i];
    child.frame = brood_.frame(i);
    child.rng = brood_.chance(i);
    child.carried_splits = brood_.carried_splits(i);
    // One that stays within the envelope as it is need not be tried.
    const bool fits_whole = is_straight && brood_.is_inside(i);
    if (p_.PruneRatio > 0 && !fits_whole && !prune(child)) {
      child.length = 0;
    } else {
      child.radius = child_radius(stem, child.offset, child.length);
    }
  }
  brood_.clear();
}

double WeberPennGrower::child_length(const WeberPennStem& stem, double offset) const {
  if (stem.level > 0) return child_max_ * (stem.length - 0.6 * offset);
  const double room = std::max(1e-9, trunk_length_ - base_length());
  return stem.length * child_max_ * shape_ratio(p_, p_.crown_shape, (stem.length - offset) / room);
}

double WeberPennGrower::child_radius(const WeberPennStem& stem, double offset, double length) const {
  const double ratio = std::max(0.0, length / stem.length);
  if (ratio <= 1 && p_.RatioPower >= 1 && !sways()) {
    // The power is less than the ratio: nobody looks at how thin a stem is that is thinner than all others.
    const double bound = stem.radius * ratio * (1 + 1e-9);
    if (writer_.leaves_out(bound)) return bound;
  }
  return std::min(radius_at(stem, offset / stem.length), stem.radius * power(ratio, p_.RatioPower));
}

/// Shortens a stem to what stays within the envelope, as far as PruneRatio wants. False: nothing is left.
bool WeberPennGrower::prune(WeberPennStem& child) {
  const double whole = child.length;
  double trial = whole;
  trial_frames_.assign(1, child.frame);
  while (trial > prune_least * whole && !fits(child, trial)) trial *= prune_step;
  const double fitted = trial > prune_least * whole ? trial : 0;
  child.length = whole - (whole - fitted) * p_.PruneRatio;
  return child.length > 1e-6 * whole;
}

/// As if it were of another length; its bends are the same at any.
bool WeberPennGrower::fits(const WeberPennStem& stem, double length) {
  const int segments = level(stem.level).curve_res;
  const double step = length / segments;
  glm::dvec3 at = stem.position;
  for (int segment = 0; segment < segments; ++segment) {
    const auto number = static_cast<std::size_t>(segment);
    if (number == trial_frames_.size()) trial_frames_.push_back(turned(stem, trial_frames_.back(), segment));
    at += trial_frames_[number].heading * step;
    if (!is_in_envelope(p_, scale_, std::sqrt(at.x * at.x + at.z * at.z), at.y)) return false;
  }
  return true;
}

void WeberPennGrower::put_leaves(WeberPennStem& stem, const WeberPennPiece& piece) {
  const auto [first, places] = find_places(stem, piece);
  if (places.empty()) return;
  writer_.count_leaves(places.size());
  const bool draws_all = writer_.draws_all();
  if (!draws_all) {
    const std::size_t count = (places.size() + lanes - 1) / lanes * lanes;
    if (drawn_.size() < count) drawn_.resize(count);
    find_drawn(leaf_chance_, static_cast<std::uint64_t>(first), writer_.drawn_below(), drawn_.data(), count);
  }
  const WeberPennLevel& l = level(stem.level + 1);
  const glm::quat frame = quaternion(piece.frame);
  std::size_t stop = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!draws_all && !drawn_[i]) continue;
    const double offset = places[i];
    while (joints_[stop].at < offset) ++stop;
    const int number = first + static_cast<int>(i);
    const double down = l.down_angle_v >= 0 ? l.down_angle : down_at(stem, offset);
    leaf_frames_.add(
        frame, piece.at(offset), joints_[stop].joint,
        {about_stem(l, number), down, leaf_chance_.at(static_cast<std::uint64_t>(number)).key()});
    if (leaf_frames_.is_full()) write_leaves();
  }
}

/// Last stems that are straight, and of which there is nothing but leaves.
bool WeberPennGrower::is_twig(const WeberPennStem& stem) const {
  return has_twigs_ && is_last(stem) && stem.level > 0 && writer_.leaves_out(stem.radius);
}

/// What walk_segment() makes of those twigs that wait before all other stems, several at once.
void WeberPennGrower::grow_twigs() {
  const WeberPennLevel& l = level(p_.Levels);
  twigs_.clear();
  for (std::size_t i = waiting_.size(); i-- > 0 && !twigs_.is_full() && is_twig(waiting_[i]);) {
    const WeberPennStem& stem = waiting_[i];
    twigs_.add(std::max(0.0, stem.length), stem.parent_length > 0 ? stem.offset / stem.parent_length : 0,
               stem.rng.key());
  }
  twigs_.find_leaves(chances_.leaves, p_.Leaves, writer_.drawn_below());
  for (std::size_t i = 0; i < twigs_.size(); ++i, waiting_.pop_back()) {
    const WeberPennStem& stem = waiting_.back();
    if (!(stem.length > 0)) continue;
    writer_.pass_over(stem.position + stem.frame.heading * stem.length);
    if (twigs_.count(i) > 0) writer_.count_leaves(twigs_.count(i));
    std::uint64_t drawn = twigs_.drawn(i);
    if (drawn == 0) continue;
    const glm::quat frame = quaternion(stem.frame);
    for (; drawn != 0; drawn &= drawn - 1) {
      const auto leaf = static_cast<std::size_t>(std::countr_zero(drawn));
      const double offset = twigs_.place(i, leaf);
      const double down = l.down_angle_v >= 0 ? l.down_angle : down_at(stem, offset);
      leaf_frames_.add(frame, stem.position + stem.frame.heading * offset, stem.joint,
                       {about_stem(l, static_cast<int>(leaf)), down, twigs_.leaf_key(i, leaf)});
      if (leaf_frames_.is_full()) write_leaves();
    }
  }
}

/// All leaves of a stem at its end.
void WeberPennGrower::put_fan(const WeberPennStem& stem, const Frame& frame, const glm::dvec3& at) {
  const WeberPennLevel& l = level(stem.level + 1);
  const double count = -p_.Leaves;
  for (int i = 0; i < count_; ++i) {
    const std::uint64_t key = leaf_chance_.at(static_cast<std::uint64_t>(i)).key();
    if (!writer_.wants_leaf(key)) continue;
    const double across = count > 1 ? l.rotate * (i / (count - 1) - 0.5) : 0;
    SkeletonWriter::Leaf leaf;
    leaf.frame =
        pitch(turn(frame, math::quick_sincos_degrees(across)), math::quick_sincos_degrees(l.down_angle));
    if (p_.LeafBend != 0) leaf.frame = to_light(leaf.frame, at, p_.LeafBend);
    leaf.frame = upper_side_up(leaf.frame);
    leaf.position = at;
    leaf.length = p_.LeafScale;
    leaf.width = p_.LeafScale * p_.LeafScaleX;
    leaf.joint = last_joint_;
    leaf.key = key;
    writer_.add(leaf);
  }
}

/// Those that wait for their frames.
void WeberPennGrower::write_leaves() {
  if (leaf_frames_.size() == 0) return;
  const WeberPennLevel& l = level(p_.Levels);
  const LeafFrames::Habit habit{p_.LeafBend, l.rotate_v, std::max(0.0, l.down_angle_v)};
  leaf_frames_.reckon(habit, glm::vec3(p_.LeafScale * p_.LeafScaleX, p_.LeafScale, p_.LeafScale),
                      writer_.extend(leaf_frames_.size()));
  leaf_frames_.clear();
}

}  // namespace seedmesh::tree
