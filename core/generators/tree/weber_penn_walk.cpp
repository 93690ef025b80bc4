#include <algorithm>
#include <cmath>

#include "core/generators/tree/sway.h"
#include "core/generators/tree/weber_penn_grower.h"

namespace seedmesh::tree {
namespace {

// Pieces of one turn of a helix (negative nCurveV).
constexpr int helix_pieces = 6;
// The flare's curve is drawn through these shares of the trunk; it ends at an eighth.
constexpr double flare_stations[] = {0.0, 1.0 / 128, 1.0 / 48, 1.0 / 24, 1.0 / 12, 1.0 / 8};
// A flare wider than this has more.
constexpr double wide_flare = 1.25;
constexpr double wide_flare_stations[] = {1.0 / 256, 1.0 / 72, 1.0 / 32, 1.0 / 16, 5.0 / 48};

std::uint64_t number_of(double x) { return static_cast<std::uint64_t>(math::to_int64(x)); }

}  // namespace

double WeberPennGrower::radius_at(const WeberPennStem& stem, double z) const {
  const double radius = tapered(level(stem.level).taper, stem.radius, stem.length, z);
  if (stem.level > 0) return radius;
  return radius * flared_trunk(p_, z);
}

/// The turn from one segment to the next.
Frame WeberPennGrower::turned(const WeberPennStem& stem, const Frame& frame, int segment) const {
  const WeberPennLevel& l = level(stem.level);
  double curve = curve_before(l, segment);
  if (l.curve_v > 0)
    curve += spread(stem.rng.at(place_of("curve")).at(static_cast<std::uint64_t>(segment)), l.curve_v) /
             l.curve_res;
  curve -= stem.uncurve;
  if (stem.level >= 2 && p_.AttractionUp != 0) curve -= lift(frame, p_.AttractionUp, l.curve_res);
  return pitch(frame, math::quick_sincos_degrees(std::clamp(curve, -170.0, 170.0)));
}

/// Of last stems that wait one behind the other, beginning with the next.
void WeberPennGrower::bend_ahead() {
  bends_.clear();
  next_bend_ = 0;
  for (std::size_t i = waiting_.size(); i-- > 0 && !bends_.is_full() && is_last(waiting_[i]);)
    bends_.add(waiting_[i].frame, waiting_[i].rng.key());
  bends_.reckon(level(p_.Levels - 1), p_.Levels > 2 ? p_.AttractionUp : 0);
}

/// In the wind. Stems are pruned in still air.
Frame WeberPennGrower::swayed_at(const WeberPennStem& stem, const Frame& frame, int segment) const {
  Rng chance = stem.rng.at(place_of("sway"));
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

/// The stem's bark and what it bears, piece by piece; `at`: where the segment begins, and then where it ends.
void WeberPennGrower::walk_segment(WeberPennStem& stem, const Frame& axis, int segment, glm::dvec3& at) {
  const int count = pieces(stem);
  const double length = segment_length(stem);
  const double piece_length = length / count, end = (segment + 1) * length;
  WeberPennPiece piece;
  piece.from = at;
  piece.along = segment * length;
  for (int i = 0; i < count; ++i) {
    piece.frame = piece_frame(stem, axis, segment * count + i);
    piece.end = i + 1 == count ? end : piece.along + piece_length;
    stops_.clear();
    const bool bends = is_written_ && add_bends(stem, piece, segment);
    if (!is_last(stem)) put_children(stem, piece);
    if (is_written_) {
      stops_.push_back(piece.end);
      if (bends) std::sort(stops_.begin(), stops_.end());
      write_joints(stem, piece);
    } else {
      writer_.pass_over(piece.at(piece.end));
      joints_.assign(1, {piece.end, last_joint_});
    }
    if (is_last(stem)) put_leaves(stem, piece);
    piece.from = piece.at(piece.end);
    piece.along = piece.end;
  }
  at = piece.from;
}

/// Stops where the radius of a straight piece does not fall evenly. False: there are none.
bool WeberPennGrower::add_bends(const WeberPennStem& stem, const WeberPennPiece& piece, int segment) {
  const WeberPennLevel& l = level(stem.level);
  if (stem.level == 0) {
    const auto add = [&](std::span<const double> stations) {
      for (const double share : stations) {
        const double stop = share * stem.length;
        if (stop > piece.along + 1e-6 * stem.length && stop < piece.end - 1e-6 * stem.length)
          stops_.push_back(stop);
      }
    };
    add(flare_stations);
    if (piece.along <= stem.length / 8 && flared_trunk(p_, 0) > 1 + wide_flare) add(wide_flare_stations);
  }
  if (l.taper > 1) {
    const int rounds = l.taper > 2 ? 6 : segment + 1 == l.curve_res ? 4 : 0;
    for (int i = 1; i < rounds; ++i) stops_.push_back(piece.along + (piece.end - piece.along) * i / rounds);
  }
  return !stops_.empty();
}

/// One at each stop: children's offsets are joints of the bark too.
void WeberPennGrower::write_joints(const WeberPennStem& stem, const WeberPennPiece& piece) {
  joints_.clear();
  double before = piece.along;
  for (const double stop : stops_) {
    if (stop <= before + 1e-9 * stem.length && stop < piece.end) continue;
    SkeletonWriter::Joint joint;
    joint.parent = last_joint_;
    joint.position = piece.at(stop);
    joint.base_radius = last_radius_;
    joint.radius = last_radius_ = radius_at(stem, std::min(1.0, stop / stem.length));
    joint.starts_limb = starts_ && (stem.level > 0 || stem.segment > 0);
    joint.order = stem.level;
    joint.key = stem.rng.at(number_of(65536 * stop / stem.length)).key();
    last_joint_ = writer_.add(joint);
    starts_ = false;
    before = stop;
    for (; next_child_ < waiting_.size() && waiting_[next_child_].offset <= stop; ++next_child_)
      waiting_[next_child_].joint = last_joint_;
    joints_.push_back({stop, last_joint_});
  }
}

}  // namespace seedmesh::tree
