#include "core/generators/tree/weber_penn.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/parallel.h"
#include "core/generators/tree/sway.h"
#include "core/generators/tree/weber_penn_grower.h"

namespace seedmesh::tree {
namespace {

// Pieces of one turn of a helix (negative nCurveV).
constexpr int helix_pieces = 6;
// The flare's curve is drawn through these shares of the trunk; it ends at an eighth.
constexpr double flare_stations[] = {0.0, 1.0 / 128, 1.0 / 48, 1.0 / 24, 1.0 / 12, 1.0 / 8};
// Fewer stems that wait are not worth another thread.
constexpr std::size_t least_stems = 8, parts_a_thread = 4;
// A flare wider than this has more.
constexpr double wide_flare = 1.25;
constexpr double wide_flare_stations[] = {1.0 / 256, 1.0 / 72, 1.0 / 32, 1.0 / 16, 5.0 / 48};
std::uint64_t number_of(double x) { return static_cast<std::uint64_t>(math::to_int64(x)); }

}  // namespace

void WeberPennGrower::run() {
  grow(trunk());
  if (!grow_parts()) grow_all();
}

void WeberPennGrower::grow_all() {
  while (!waiting_.empty()) {
    const WeberPennStem stem = waiting_.back();
    waiting_.pop_back();
    grow(stem);
  }
  put_leaves();
}

struct WeberPennGrower::Part {
  Part(const WeberPennGrower& whole, std::size_t most)
      : skeleton(whole.writer_.job()),
        writer(skeleton, whole.writer_, most),
        grower(whole.p_, whole.chances_, writer) {
    grower.scale_ = whole.scale_;
    grower.trunk_length_ = whole.trunk_length_;
  }
  Skeleton skeleton;
  SkeletonWriter writer;
  WeberPennGrower grower;
};

/// What waits, on all threads; false: nothing is grown. No stem knows of another that waits, and what is
/// drawn by chance is drawn by place, so that the result is that of one thread.
bool WeberPennGrower::grow_parts() {
  const Job& job = writer_.job();
  if (!has_threads(job) || waiting_.size() < least_stems) return false;
  const std::size_t wanted = parts_a_thread * static_cast<std::size_t>(job.threads());
  const std::size_t stems = std::max<std::size_t>(1, waiting_.size() / wanted);
  const std::size_t count = chunk_count(waiting_.size(), stems), most = writer_.most_of_parts(count);
  if (most == 0) return false;
  put_leaves();
  std::vector<std::unique_ptr<Part>> parts(count);
  try {
    parallel_for(job, waiting_.size(), stems, [&](std::size_t begin, std::size_t end, std::size_t index) {
      auto part = std::make_unique<Part>(*this, most);
      part->grower.waiting_.assign(waiting_.begin() + static_cast<std::ptrdiff_t>(begin),
                                   waiting_.begin() + static_cast<std::ptrdiff_t>(end));
      part->grower.grow_all();
      parts[index] = std::move(part);
    });
  } catch (const SkeletonWriter::Enough&) {
    return false;  // so large that it may meet a limit
  }
  std::vector<const SkeletonWriter*> written;
  for (std::size_t i = count; i-- > 0;) written.push_back(&parts[i]->writer);  // the last first, as they wait
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

double WeberPennGrower::radius_at(const WeberPennStem& stem, double z) const {
  const double radius = tapered(level(stem.level).taper, stem.radius, stem.length, z);
  if (stem.level > 0) return radius;
  return radius * flared_trunk(p_, z);
}

/// The turn from one segment to the next.
Frame WeberPennGrower::turned(const WeberPennStem& stem, const Frame& frame, int segment) const {
  const WeberPennLevel& l = level(stem.level);
  double curve = l.curve / l.curve_res;
  if (l.curve_back != 0 && l.curve_res > 1) {
    curve = (2 * segment <= l.curve_res ? l.curve : l.curve_back) / (0.5 * l.curve_res);
  }
  if (l.curve_v > 0)
    curve += spread(stem.rng.at("curve").at(static_cast<std::uint64_t>(segment)), l.curve_v) / l.curve_res;
  curve -= stem.uncurve;
  if (stem.level >= 2 && p_.AttractionUp != 0) {
    const double declination = math::quick_acos(std::clamp(frame.heading.y, -1.0, 1.0));
    curve -= math::degrees(p_.AttractionUp * declination * std::clamp(frame.up.y, -1.0, 1.0)) / l.curve_res;
  }
  return pitch(frame, math::quick_sincos_degrees(std::clamp(curve, -170.0, 170.0)));
}

/// In the wind. Stems are pruned in still air.
Frame WeberPennGrower::swayed_at(const WeberPennStem& stem, const Frame& frame, int segment) const {
  if (p_.sway.wind == 0 && p_.sway.gust == 0) return frame;
  Rng chance = stem.rng.at("sway");
  SwayingStem swaying;
  swaying.length = stem.length;
  swaying.base_radius = stem.radius;
  swaying.segments = level(stem.level).curve_res;
  swaying.offset_x = chance.uniform(0, 2 * math::pi);
  swaying.offset_y = chance.uniform(0, 2 * math::pi);
  const double z = static_cast<double>(segment) / swaying.segments;
  const double radius = tapered(level(stem.level).taper, stem.radius, stem.length, z);
  return swayed(frame, sway_angles(p_.sway, swaying, z, radius));
}

int WeberPennGrower::pieces(const WeberPennStem& stem) const {
  const WeberPennLevel& l = level(stem.level);
  return l.curve_v < 0 ? std::max(1, (helix_pieces + l.curve_res - 1) / l.curve_res) : 1;
}

/// The heading of one piece of a helix about the stem's axis.
Frame WeberPennGrower::piece_frame(const WeberPennStem& stem, const Frame& axis, int piece) const {
  const WeberPennLevel& l = level(stem.level);
  if (l.curve_v >= 0) return axis;
  const Frame around = roll(axis, math::quick_sincos_degrees(360.0 / helix_pieces * piece));
  return pitch(around, math::quick_sincos_degrees(-l.curve_v));
}

/// From `from` to `to` shares of the stem, one joint at each; children's offsets are joints of the bark too.
double WeberPennGrower::walk_segment(WeberPennStem& stem, const Frame& axis, int segment, glm::dvec3& at) {
  const double piece_length = segment_length(stem) / pieces(stem);
  const int first_piece = segment * pieces(stem);
  double along = segment * segment_length(stem);
  for (int piece = first_piece; piece < first_piece + pieces(stem); ++piece) {
    const Frame frame = piece_frame(stem, axis, piece);
    const double end =
        piece + 1 == first_piece + pieces(stem) ? (segment + 1) * segment_length(stem) : along + piece_length;
    std::vector<double>& stops = stops_;
    stops.clear();
    bud_frames_.push_back(frame);
    if (stem.level == 0) {
      for (const double share : flare_stations) {
        const double stop = share * stem.length;
        if (stop > along + 1e-6 * stem.length && stop < end - 1e-6 * stem.length) stops.push_back(stop);
      }
      for (const double share : wide_flare_stations) {
        const double stop = share * stem.length;
        if (flared_trunk(p_, 0) > 1 + wide_flare && stop > along + 1e-6 * stem.length &&
            stop < end - 1e-6 * stem.length)
          stops.push_back(stop);
      }
    }
    if (level(stem.level).taper > 1) {
      const int rounds = level(stem.level).taper > 2 ? 6 : segment + 1 == level(stem.level).curve_res ? 4 : 0;
      for (int i = 1; i < rounds; ++i) stops.push_back(along + (end - along) * i / rounds);
    }
    double from = std::max(along, bare_);
    while (spacing_ > 0 && from < end) {
      const double step = (1 - stem.carried_children) * spacing_ / stem.share;
      if (from + step > end) {
        stem.carried_children += (end - from) * stem.share / spacing_;
        break;
      }
      from += step;
      stem.carried_children = 0;
      const int number = stem.children_before++;
      if (is_last(stem) && !wants_leaf(number)) continue;
      put_bud(at + frame.heading * (from - along), from, number);
      if (!is_last(stem)) stops.push_back(from);
    }
    stops.push_back(end);
    std::sort(stops.begin(), stops.end());
    double before = along;
    for (const double stop : stops) {
      if (stop <= before + 1e-9 * stem.length && stop < end) continue;
      SkeletonWriter::Joint joint;
      joint.parent = last_joint_;
      joint.position = at + frame.heading * (stop - along);
      joint.base_radius = radius_at(stem, before / stem.length);
      joint.radius = radius_at(stem, std::min(1.0, stop / stem.length));
      joint.starts_limb = starts_ && (stem.level > 0 || stem.segment > 0);
      joint.order = stem.level;
      joint.key = stem.rng.at(number_of(65536 * stop / stem.length)).key();
      last_joint_ = writer_.add(joint);
      starts_ = false;
      before = stop;
      for (; next_bud_ < buds_.size() && buds_[next_bud_].offset <= stop; ++next_bud_)
        buds_[next_bud_].joint = last_joint_;
    }
    at += frame.heading * (end - along);
    along = end;
  }
  return along;
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
    waiting_.push_back(clone);
  }
  const auto [turned, uncurve] = part(0);
  frame = turned;
  stem.uncurve += uncurve;
}

void WeberPennGrower::grow(const WeberPennStem& given) {
  WeberPennStem stem = given;
  const WeberPennLevel& l = level(stem.level);
  if (!(stem.length > 0)) return;
  last_joint_ = stem.joint;
  starts_ = true;
  leaf_chance_ = chances_.leaves.at(stem.rng.key());
  bare_ = stem.level == 0 ? std::min(base_length(), 0.99 * stem.length) : 0;
  const double children = std::floor(children_of(stem) + 0.5);
  const bool is_fan = is_last(stem) && p_.Leaves < 0;
  spacing_ = children > 0 && !is_fan ? (stem.length - bare_) / children : 0;
  const double child_max =
      std::max(0.0, level(stem.level + 1).length +
                        spread(stem.rng.at("child_length"), level(stem.level + 1).length_v));
  buds_.clear();
  bud_frames_.clear();
  next_bud_ = 0;
  Frame frame = stem.frame;
  glm::dvec3 at = stem.position;
  for (int segment = stem.segment; segment < l.curve_res; ++segment) {
    if (segment > stem.segment) frame = swayed_at(stem, turned(stem, frame, segment), segment);
    walk_segment(stem, frame, segment, at);
    if (segment + 1 < l.curve_res) split(stem, frame, at, segment, last_joint_);
  }
  for (int i = 0; is_fan && i < static_cast<int>(children); ++i) {
    if (!wants_leaf(i)) continue;
    if (buds_.empty()) bud_frames_.push_back(frame);
    put_bud(at, stem.length, i);
    buds_.back().joint = last_joint_;
  }
  bear_all(stem, child_max);
}

void grow_weber_penn(const TreeParams& params, const Chances& chances, SkeletonWriter& writer) {
  WeberPennGrower(params, chances, writer).run();
}

}  // namespace seedmesh::tree
