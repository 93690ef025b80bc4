#include "core/generators/tree/weber_penn.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/tree/weber_penn_grower.h"

namespace seedmesh::tree {
namespace {

// Fewer stems that wait are not worth another thread.
constexpr std::size_t least_stems = 8;
// Trunks that split off are grown ahead, for one may bear half the tree; not more of them.
constexpr std::size_t most_trunks = 16;
// Of the children that stems bear at most, what they bear on the whole, and room for chance.
constexpr double usual_share = 0.7;
// A part may be greater than the others by so much. Small trees have few parts, each of which takes time.
constexpr double room_of_part = 1.5, many_joints = 12'000;

}  // namespace

void WeberPennGrower::run() {
  if (!has_threads(writer_.job())) make_room(1);
  WeberPennStem stem = trunk();
  grow(stem);
  if (!grow_parts()) grow_all();
}

/// About as many joints and leaves as the tree may have.
WeberPennGrower::Expected WeberPennGrower::expected() const {
  double stems = 1, joints = 0;
  for (int n = 0; n < p_.Levels; ++n) {
    const double children = n + 1 < p_.Levels ? level(n + 1).branches : 0;
    joints += stems * (level(n).curve_res + children);
    if (n + 1 < p_.Levels) stems *= children;
  }
  return {usual_share * joints, usual_share * stems * std::abs(p_.Leaves)};
}

void WeberPennGrower::make_room(double share) {
  const Expected all = expected();
  writer_.expect(share * all.joints, share * all.leaves);
}

void WeberPennGrower::grow_all() {
  while (!waiting_.empty()) {
    if (is_twig(waiting_.back())) {
      grow_twigs();
      continue;
    }
    if (bends_ahead_ && next_bend_ == bends_.size() && is_last(waiting_.back())) bend_ahead();
    WeberPennStem stem = waiting_.back();
    waiting_.pop_back();
    grow(stem);
    if (next_bend_ < bends_.size()) ++next_bend_;
  }
  write_leaves();
}

struct WeberPennGrower::Part {
  Part(const WeberPennGrower& whole, const SkeletonWriter& base, std::size_t most)
      : skeleton(whole.writer_.job()),
        writer(skeleton, base, most),
        grower(whole.p_, whole.chances_, writer) {
    grower.scale_ = whole.scale_;
    grower.trunk_length_ = whole.trunk_length_;
  }
  Skeleton skeleton;
  SkeletonWriter writer;
  WeberPennGrower grower;
};

/// In the order in which they are written.
struct WeberPennGrower::Plan {
  /// A trunk that is grown, or else stems that wait at a grower and hang on what it wrote.
  struct Step {
    std::unique_ptr<Part> part;
    const WeberPennGrower* from = nullptr;
    std::size_t begin = 0, end = 0;
  };
  std::vector<Step> steps;
  std::size_t trunks = 0, stems = 0;
};

/// What waits at `from`, the last first; trunks are grown, and what waits at them comes next.
void WeberPennGrower::plan_parts(const WeberPennGrower& from, std::size_t most, Plan& plan) const {
  for (std::size_t end = from.waiting_.size(); end > 0; --end) {
    if (from.waiting_[end - 1].level > 0 || plan.trunks == most_trunks) {
      plan.steps.push_back({nullptr, &from, end - 1, end});
      ++plan.stems;
      continue;
    }
    ++plan.trunks;
    auto part = std::make_unique<Part>(*this, from.writer_, most);
    WeberPennStem trunk = from.waiting_[end - 1];
    part->grower.grow(trunk);
    part->grower.write_leaves();
    const WeberPennGrower& grower = part->grower;
    plan.steps.push_back({std::move(part), nullptr, 0, 0});
    plan_parts(grower, most, plan);
  }
}

/// Joins stems that wait at one grower, up to so many.
void WeberPennGrower::join_steps(Plan& plan, std::size_t stems) {
  std::vector<Plan::Step> joined;
  for (Plan::Step& step : plan.steps) {
    const bool goes_on = !joined.empty() && step.from && joined.back().from == step.from &&
                         joined.back().begin == step.end && joined.back().end - step.begin <= stems;
    if (goes_on) {
      joined.back().begin = step.begin;
    } else {
      joined.push_back(std::move(step));
    }
  }
  plan.steps = std::move(joined);
}

/// What waits, on all threads; false: nothing is grown. No stem knows of another that waits, and what is
/// drawn by chance is drawn by place, so that the result is that of one thread.
bool WeberPennGrower::grow_parts() {
  const Job& job = writer_.job();
  if (!has_threads(job) || waiting_.size() < least_stems) return false;
  const std::size_t parts_a_thread = expected().joints < many_joints ? 2 : 4;
  const std::size_t wanted = parts_a_thread * static_cast<std::size_t>(job.threads());
  const std::size_t most_of_trunk = writer_.most_of_parts(wanted + most_trunks);
  if (most_of_trunk == 0) return false;
  write_leaves();
  Plan plan;
  try {
    plan_parts(*this, most_of_trunk, plan);
    join_steps(plan, std::max<std::size_t>(1, plan.stems / wanted));
    std::vector<Plan::Step>& steps = plan.steps;
    const std::size_t most = writer_.most_of_parts(steps.size());
    parallel_for(job, steps.size(), 1, [&](std::size_t, std::size_t, std::size_t i) {
      if (steps[i].part) return;
      const WeberPennGrower& from = *steps[i].from;
      auto part = std::make_unique<Part>(*this, from.writer_, most);
      part->grower.waiting_.assign(from.waiting_.begin() + static_cast<std::ptrdiff_t>(steps[i].begin),
                                   from.waiting_.begin() + static_cast<std::ptrdiff_t>(steps[i].end));
      part->grower.make_room(room_of_part / static_cast<double>(steps.size()));
      part->grower.grow_all();
      steps[i].part = std::move(part);
    });
  } catch (const SkeletonWriter::Enough&) {
    return false;  // so large that it may meet a limit
  }
  std::vector<SkeletonWriter*> written;
  for (Plan::Step& step : plan.steps) written.push_back(&step.part->writer);
  writer_.take(written);
  return true;
}

WeberPennStem WeberPennGrower::trunk() {
  WeberPennStem stem;
  stem.rng = chances_.trunk;
  scale_ = std::max(0.1 * p_.Scale, p_.Scale + spread(stem.rng.at("scale"), p_.ScaleV));
  stem.length =
      std::max(0.0, (levels_[0].length + spread(stem.rng.at("length"), levels_[0].length_v))) * scale_;
  const double factor = std::max(0.05, p_.trunk_scale + spread(stem.rng.at("radius"), p_.trunk_scale_v));
  stem.radius = stem.length * p_.Ratio * factor;
  stem.parent_length = stem.length;
  stem.parent_length_max = 1;
  stem.frame = roll(Frame{}, math::quick_sincos_degrees(stem.rng.at("roll").uniform(0, 360)));
  trunk_length_ = stem.length;
  SkeletonWriter::Joint root;
  root.radius = root.base_radius = radius_at(stem, 0);
  root.key = stem.rng.key();
  stem.joint = writer_.add(root);
  return stem;
}

void WeberPennGrower::split(WeberPennStem& stem, Frame& frame, const glm::dvec3& at, int segment,
                            std::uint32_t joint) {
  const WeberPennLevel& l = level(stem.level);
  const bool at_base = stem.level == 0 && segment == 0 && p_.base_splits > 0;
  int clones = 0;
  if (at_base) {
    clones = p_.base_splits;
  } else {
    const double wanted = l.seg_splits * stem.readiness + stem.carried_splits;
    clones = std::max(0, static_cast<int>(math::to_int32(std::floor(wanted + 0.5))));
    stem.carried_splits = wanted - clones;
  }
  if (clones == 0) return;
  const Rng rng = stem.rng.at("split").at(static_cast<std::uint64_t>(segment));
  const int left = std::max(1, l.curve_res - segment - 1);
  const double down = declination_of(frame);
  stem.share /= clones + 1;
  stem.readiness = at_base ? stem.readiness : 0.5;
  const auto part = [&](int number) {
    const Rng own = rng.at(static_cast<std::uint64_t>(number));
    const double angle = std::max(0.0, l.split_angle + spread(own.at("angle"), l.split_angle_v) - down);
    Rng chance = own.at("about");
    const double square = chance.unit();
    double about = 20 + 0.75 * (30 + std::abs(down - 90)) * square * square;
    if (chance.unit() < 0.5) about = -about;
    if (at_base) about = 360.0 * number / (clones + 1);
    Frame turned = pitch(frame, math::quick_sincos_degrees(angle));
    if (number > 0 || at_base) turned = rotated(turned, {0, 1, 0}, math::quick_sincos_degrees(about));
    return std::pair{turned, angle / left};
  };
  for (int number = clones; number >= 1; --number) {
    WeberPennStem clone = stem;
    const auto [turned, uncurve] = part(number);
    clone.frame = turned;
    clone.position = at;
    clone.joint = joint;
    clone.segment = segment + 1;
    clone.uncurve = stem.uncurve + uncurve;
    clone.rng = rng.at("clone").at(static_cast<std::uint64_t>(number));
    clone.carried_children = clone.rng.at("phase").unit();
    clone.carried_splits = 0;
    clones_.push_back(clone);
  }
  const auto [turned, uncurve] = part(0);
  frame = turned;
  stem.uncurve += uncurve;
}

void WeberPennGrower::begin(const WeberPennStem& stem) {
  is_written_ = stem.level == 0 || !writer_.leaves_out(stem.radius);
  last_joint_ = stem.joint;
  starts_ = true;
  bare_ = stem.level == 0 ? std::min(base_length(), 0.99 * stem.length) : 0;
  count_ = math::to_int32(std::floor(children_of(stem) + 0.5));
  const bool is_fan = is_last(stem) && p_.Leaves < 0;
  spacing_ = count_ > 0 && !is_fan ? (stem.length - bare_) / count_ : 0;
  clones_.clear();
  first_child_ = next_child_ = waiting_.size();
  if (is_last(stem)) {
    leaf_chance_ = chances_.leaves.at(stem.rng.key());
    return;
  }
  const Rng own = stem.level == 0 ? chances_.branches.at(stem.segment == 0 ? 0 : stem.rng.key()) : stem.rng;
  child_chance_ = own.at(place_of("child"));
  const WeberPennLevel& next = level(stem.level + 1);
  child_max_ = std::max(0.0, next.length + spread(stem.rng.at(place_of("child_length")), next.length_v));
  // Twigs that nobody draws need no joints where they stand closer than the stem is thick.
  marks_feet_ = is_written_ && (stem.level == 0 || spacing_ > 2 * stem.radius || writer_.marks_every_foot() ||
                                stem.radius * power(child_max_, p_.RatioPower) >= p_.twig_radius);
}

/// What grows from the stem waits then, clones before children.
void WeberPennGrower::grow(WeberPennStem& stem) {
  const int segments = level(stem.level).curve_res;
  if (!(stem.length > 0)) return;
  begin(stem);
  if (is_written_) last_radius_ = radius_at(stem, stem.segment * segment_length(stem) / stem.length);
  Frame frame = stem.frame;
  glm::dvec3 at = stem.position;
  for (int segment = stem.segment; segment < segments; ++segment) {
    if (segment > stem.segment) {
      frame = next_bend_ < bends_.size() ? bends_.frame(next_bend_, segment) : turned(stem, frame, segment);
      if (sways()) frame = swayed_at(stem, frame, segment);
    }
    walk_segment(stem, frame, segment, at);
    if (segment + 1 < segments && may_split(stem)) split(stem, frame, at, segment, last_joint_);
  }
  settle(stem);
  if (is_last(stem) && p_.Leaves < 0) put_fan(stem, frame, at);
  waiting_.insert(waiting_.begin() + static_cast<std::ptrdiff_t>(first_child_), clones_.begin(),
                  clones_.end());
}

void grow_weber_penn(const TreeParams& params, const Chances& chances, SkeletonWriter& writer) {
  WeberPennGrower(params, chances, writer).run();
}

}  // namespace seedmesh::tree
