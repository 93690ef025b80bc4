#pragma once
/// Counts the rings, vertices and triangles of tubes. The writer (tube_writer.h) writes exactly these
/// numbers.
#include <cstdint>
#include <vector>

#include "core/geom/plant/skin.h"
#include "core/geom/plant/tube_formulas.h"
#include "core/geom/plant/tube_twist.h"

namespace seedmesh {

/// The colour indices in use, rising and without gaps.
class Palette {
 public:
  explicit Palette(const Limbs& limbs);
  std::size_t size() const { return colors_.size(); }
  std::int16_t color(std::size_t slot) const { return colors_[slot]; }
  std::size_t slot(std::int16_t color) const { return slots_[static_cast<std::size_t>(color - lowest_)]; }

 private:
  int lowest_ = 0;
  std::vector<std::uint16_t> slots_;
  std::vector<std::int16_t> colors_;
};

/// The numbers of all cross-sections of a limb.
struct CrossSection {
  CrossSection(const SkinOptions& options, int side_count)
      : sides(static_cast<std::uint32_t>(side_count)), corners(sides + (options.uv ? 1U : 0U)) {}
  std::uint32_t sides;
  std::uint32_t corners;  ///< vertices of a ring: sides + 1 where the seam is doubled
};

/// Returns the number of inner rings of an internode. `free`: the length between its two outer rings; `twist`: the
/// cosine of its twist.
inline int inner_rings(const SkinOptions& options, const Scale& scale, glm::vec2 radii, float free,
                       float twist) {
  const int least = rings_of_twist(twist);
  if (options.stacks <= 1 && least == 0) return 0;
  const bool is_even = radii.x == radii.y && !is_twisted(twist) && !options.cuts_all;
  int wanted = is_even ? 0 : options.stacks - 1;
  if (options.adapt && wanted > 0) {
    const float share = free / (0.1F * scale.size);
    wanted = std::min(wanted, static_cast<int>(std::min(share, 1.0F) * static_cast<float>(options.stacks)));
  }
  wanted = std::max(wanted, least);
  if (wanted < 1) return 0;
  const auto pieces = static_cast<float>(std::max(options.stacks, wanted + 1));
  const bool is_room = free >= scale.apart * pieces;
  const bool is_thick =
      std::max(radii.x, radii.y) >= scale.thinnest * pieces || std::min(radii.x, radii.y) >= scale.thinnest;
  return is_room && is_thick ? wanted : 0;
}

/// Whether a tube begins or ends with a flat face, at coarser levels. It begins with one, inside its parent or on the
/// ground. It ends with one if it has three corners, because a cone on three corners would not be visible.
inline bool begins_flat(const SkinOptions& options) {
  return !options.corners.empty() && options.contours.empty();
}
inline bool ends_flat(const SkinOptions& options, std::uint32_t sides) {
  return begins_flat(options) && sides == 3;
}

/// Like tip_length() for a flat end: the outline has the same area as with a cone.
inline float flat_tip_length(float radius, float free) { return 0.5F * tip_length(radius, free); }

/// A sink of walk_limb() that counts for each slot of the palette.
class TubeCounter {
 public:
  TubeCounter(const Limbs& limbs, const SkinOptions& options, const Scale& scale, const Palette& palette,
              TubeCount* counts)
      : limbs_(limbs),
        options_(options),
        section_(options, options.sides),
        twists_(!options.contours.empty() && !limbs.frame.empty()),
        scale_(scale),
        palette_(palette),
        counts_(counts) {}

  void begin_limb(int sides) { section_ = CrossSection(options_, sides); }

  void open(const Internode& first, TubeOpening opening) {
    here_ = &counts_[palette_.slot(first.color)];
    if (opening != TubeOpening::point && begins_flat(options_)) {
      here_->vertices += section_.sides;
      here_->triangles += section_.sides - 2;
    } else {
      here_->vertices += opening == TubeOpening::root ? section_.sides + 1 : 1;
      here_->triangles += section_.sides;
    }
    has_ring_ = false;
    if (opening != TubeOpening::point) ring();
    begin(first, 0);
    if (twists_) twist_ = {first_side(limbs_, first), 1};
  }

  void join(const Turn& turn, const Internode& next) {
    rings(inner_rings(options_, scale_, {radius_, next.base}, length_ - reach_ - turn.reach,
                      cosine_of_twist()));
    ring();
    if (next.color != color_) {
      here_ = &counts_[palette_.slot(next.color)];
      has_ring_ = false;
      ring();
    }
    const glm::vec3 along = along_;
    begin(next, turn.reach);
    if (twists_) twist_ = twist_of(limbs_, scale_, next, carried(twist_.side, along, turn, next.along));
  }

  void close(TubeClosing closing, float free) {
    const float end = closing == TubeClosing::point ? 0 : end_;
    const bool is_flat = closing != TubeClosing::point && ends_flat(options_, section_.sides);
    const float tip = is_flat ? flat_tip_length(end_, free) : tip_length(end_, free);
    const float room = closing == TubeClosing::tip ? free - tip : free;
    rings(inner_rings(options_, scale_, {radius_, end}, room, cosine_of_twist()));
    if (closing != TubeClosing::point) ring();
    here_->vertices += is_flat ? section_.sides : 1;
    here_->triangles += is_flat ? section_.sides - 2 : section_.sides;
  }

 private:
  void begin(const Internode& internode, float reach) {
    radius_ = internode.base < scale_.thinnest ? 0 : internode.base;
    end_ = internode.end;
    length_ = internode.length;
    color_ = internode.color;
    reach_ = reach;
    along_ = internode.along;
    is_round_ = !twists_ || is_round(limbs_, internode.joint);
  }
  float cosine_of_twist() const { return is_round_ ? 1 : twist_.cosine; }
  void ring() {
    here_->vertices += section_.corners;
    if (has_ring_) here_->triangles += 2 * section_.sides;
    has_ring_ = true;
  }
  void rings(int count) {
    for (int i = 0; i < count; ++i) ring();
  }

  const Limbs& limbs_;
  SkinOptions options_;
  CrossSection section_;
  bool twists_;
  bool is_round_ = true;
  Twist twist_;
  glm::vec3 along_{0};
  const Scale& scale_;
  const Palette& palette_;
  TubeCount* counts_;
  TubeCount* here_ = nullptr;
  bool has_ring_ = false;
  float radius_ = 0, end_ = 0, length_ = 0, reach_ = 0;
  std::int16_t color_ = 0;
};

}  // namespace seedmesh
