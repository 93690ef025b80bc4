#include <cmath>

#include "core/generators/tree/weber_penn_grower.h"

namespace seedmesh::tree {
namespace {

// A pruned stem is tried at so much of its length again and again, and is left out below the least share.
constexpr double prune_step = 0.9, prune_least = 0.15;

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

/// How a child or leaf leaves its stem.
WeberPennGrower::Stance WeberPennGrower::stance(const WeberPennStem& stem, const WeberPennBud& bud,
                                                const Rng& rng) const {
  const WeberPennLevel& l = level(stem.level + 1);
  const double vary = spread(rng.at("rotate"), l.rotate_v);
  const double rotate =
      l.rotate >= 0 ? bud.number * l.rotate + vary : (bud.number % 2) * 180.0 + l.rotate + vary;
  double down = l.down_angle;
  if (l.down_angle_v >= 0) {
    down += spread(rng.at("down"), l.down_angle_v);
  } else {
    const double bare = stem.level == 0 ? base_length() : 0;
    const double room = std::max(1e-9, stem.length - bare);
    down += l.down_angle_v * (1 - 2 * shape_ratio(p_, 0, (stem.length - bud.offset) / room));
  }
  return {rotate, down};
}

void WeberPennGrower::bear(const WeberPennStem& stem, const WeberPennBud& bud, double child_max) {
  const Rng parent =
      stem.level == 0 ? chances_.branches.at(stem.segment == 0 ? 0 : stem.rng.key()) : stem.rng;
  const Rng rng = parent.at("child").at(static_cast<std::uint64_t>(bud.number));
  WeberPennStem child;
  const Stance stands = stance(stem, bud, rng);
  child.frame = pitch(roll(bud_frames_[bud.frame], math::quick_sincos_degrees(stands.about)),
                      math::quick_sincos_degrees(stands.down));
  child.position = bud.position;
  child.joint = bud.joint;
  child.level = stem.level + 1;
  child.offset = bud.offset;
  child.parent_length = stem.length;
  child.parent_length_max = child_max;
  child.rng = rng;
  child.carried_splits = rng.at("splits").uniform(-0.5, 0.5);
  if (stem.level == 0) {
    const double room = std::max(1e-9, trunk_length_ - base_length());
    child.length =
        stem.length * child_max * shape_ratio(p_, p_.crown_shape, (stem.length - bud.offset) / room);
  } else {
    child.length = child_max * (stem.length - 0.6 * bud.offset);
  }
  if (p_.PruneRatio > 0 && !prune(child)) return;
  if (!(child.length > 0)) return;
  const double ratio = std::max(0.0, child.length / stem.length);
  child.radius =
      std::min(radius_at(stem, bud.offset / stem.length), stem.radius * math::pow(ratio, p_.RatioPower));
  waiting_.push_back(child);
}

/// Shortens a stem to what stays within the envelope, as far as PruneRatio wants. False: nothing is left.
bool WeberPennGrower::prune(WeberPennStem& child) const {
  const double whole = child.length;
  WeberPennStem trial = child;
  while (trial.length > prune_least * whole && !fits(trial)) trial.length *= prune_step;
  const double fitted = trial.length > prune_least * whole ? trial.length : 0;
  child.length = whole - (whole - fitted) * p_.PruneRatio;
  return child.length > 1e-6 * whole;
}

bool WeberPennGrower::fits(const WeberPennStem& stem) const {
  glm::dvec3 at = stem.position;
  Frame frame = stem.frame;
  for (int segment = 0; segment < level(stem.level).curve_res; ++segment) {
    if (segment > 0) frame = turned(stem, frame, segment);
    at += frame.heading * segment_length(stem);
    if (!is_in_envelope(p_, scale_, std::sqrt(at.x * at.x + at.z * at.z), at.y)) return false;
  }
  return true;
}

void WeberPennGrower::leaf(const WeberPennStem& stem, const WeberPennBud& bud) {
  const Rng rng = leaf_chance_.at(static_cast<std::uint64_t>(bud.number));
  if (p_.Leaves < 0) return fan_leaf(stem, bud, rng);
  const Stance stands = stance(stem, bud, rng);
  Organ& organ = leaves_[leaf_frames_.size()];
  leaf_frames_.add(bud_frames_[bud.frame], bud.position, stands.about, stands.down);
  organ.position = glm::vec3(bud.position);
  organ.limb_joint = bud.joint;
  organ.key = rng.key();
  if (leaf_frames_.is_full()) put_leaves();
}

/// One of a fan at the end of a stem.
void WeberPennGrower::fan_leaf(const WeberPennStem& stem, const WeberPennBud& bud, const Rng& rng) {
  const WeberPennLevel& l = level(stem.level + 1);
  const double count = -p_.Leaves;
  const double across = count > 1 ? l.rotate * (bud.number / (count - 1) - 0.5) : 0;
  SkeletonWriter::Leaf leaf;
  leaf.frame = pitch(turn(bud_frames_[bud.frame], math::quick_sincos_degrees(across)),
                     math::quick_sincos_degrees(l.down_angle));
  if (p_.LeafBend != 0) leaf.frame = to_light(leaf.frame, bud.position, p_.LeafBend);
  leaf.frame = upper_side_up(leaf.frame);
  leaf.position = bud.position;
  leaf.length = p_.LeafScale;
  leaf.width = p_.LeafScale * p_.LeafScaleX;
  leaf.joint = bud.joint;
  leaf.key = rng.key();
  writer_.add(leaf);
}

/// Those that wait for their frames.
void WeberPennGrower::put_leaves() {
  leaf_frames_.reckon(p_.LeafBend);
  for (std::size_t i = 0; i < leaf_frames_.size(); ++i) {
    Organ& organ = leaves_[i];
    organ.frame = leaf_frames_.frame(i);
    organ.scale = glm::vec3(p_.LeafScale * p_.LeafScaleX, p_.LeafScale, p_.LeafScale);
  }
  writer_.add(std::span<const Organ>(leaves_.data(), leaf_frames_.size()));
  leaf_frames_.clear();
}

void WeberPennGrower::bear_all(const WeberPennStem& stem, double child_max) {
  for (const WeberPennBud& bud : buds_) {
    if (is_last(stem)) {
      leaf(stem, bud);
    } else {
      bear(stem, bud, child_max);
    }
  }
}

}  // namespace seedmesh::tree
