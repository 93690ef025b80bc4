#pragma once
/// What a tube is made of, counted: rings, vertices, triangles. The writer (tube_writer.h) makes exactly
/// these.
#include <cstdint>
#include <vector>

#include "core/geom/limb_walk.h"
#include "core/geom/skin.h"

namespace seedmesh {

/// Numbers the colour indices in use, rising, without gaps.
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

struct TubeCount {
  std::uint64_t vertices = 0, triangles = 0;
};

/// What the options make of every cross-section.
struct CrossSection {
  CrossSection(const SkinOptions& options, int side_count)
      : sides(static_cast<std::uint32_t>(side_count)), corners(sides + (options.uv ? 1U : 0U)) {}
  std::uint32_t sides;
  std::uint32_t corners;  ///< vertices of a ring: one more than sides where the seam is doubled
};

/// How many rings stand between the two that bound an internode; `free` is the length between the two.
inline int inner_rings(const SkinOptions& options, const Scale& scale, glm::vec2 radii, float free) {
  if (options.stacks <= 1 || radii.x == radii.y) return 0;
  int wanted = options.stacks - 1;
  if (options.adapt) {
    const float share = free / (0.1F * scale.size);
    wanted = std::min(wanted, static_cast<int>(std::min(share, 1.0F) * static_cast<float>(options.stacks)));
    if (wanted < 1) return 0;
  }
  const bool is_room = free >= scale.apart * static_cast<float>(options.stacks);
  const bool is_thick = std::max(radii.x, radii.y) >= scale.thinnest * static_cast<float>(options.stacks) ||
                        std::min(radii.x, radii.y) >= scale.thinnest;
  return is_room && is_thick ? wanted : 0;
}

/// How far the last ring of a free tip stands back from its point, so that a limb is as long as it was drawn.
inline float tip_length(float radius, float free) { return std::min(radius, 0.3F * free); }

/// Sink of walk_limb: counts per slot of the palette.
class TubeCounter {
 public:
  TubeCounter(const SkinOptions& options, const Scale& scale, const Palette& palette, TubeCount* counts)
      : options_(options),
        section_(options, options.sides),
        scale_(scale),
        palette_(palette),
        counts_(counts) {}

  void begin_limb(int sides) { section_ = CrossSection(options_, sides); }

  void open(const Internode& first, TubeOpening opening) {
    here_ = &counts_[palette_.slot(first.color)];
    here_->vertices += opening == TubeOpening::root ? section_.sides + 1 : 1;
    here_->triangles += section_.sides;
    has_ring_ = false;
    if (opening != TubeOpening::point) ring();
    begin(first, 0);
  }

  void join(const Turn& turn, const Internode& next) {
    rings(inner_rings(options_, scale_, {radius_, next.base}, length_ - reach_ - turn.reach));
    ring();
    if (next.color != color_) {
      here_ = &counts_[palette_.slot(next.color)];
      has_ring_ = false;
      ring();
    }
    begin(next, turn.reach);
  }

  void close(TubeClosing closing, float free) {
    const float end = closing == TubeClosing::point ? 0 : end_;
    const float room = closing == TubeClosing::tip ? free - tip_length(end_, free) : free;
    rings(inner_rings(options_, scale_, {radius_, end}, room));
    if (closing != TubeClosing::point) ring();
    here_->vertices += 1;
    here_->triangles += section_.sides;
  }

 private:
  void begin(const Internode& internode, float reach) {
    radius_ = internode.base < scale_.thinnest ? 0 : internode.base;
    end_ = internode.end;
    length_ = internode.length;
    color_ = internode.color;
    reach_ = reach;
  }
  void ring() {
    here_->vertices += section_.corners;
    if (has_ring_) here_->triangles += 2 * section_.sides;
    has_ring_ = true;
  }
  void rings(int count) {
    for (int i = 0; i < count; ++i) ring();
  }

  SkinOptions options_;
  CrossSection section_;
  const Scale& scale_;
  const Palette& palette_;
  TubeCount* counts_;
  TubeCount* here_ = nullptr;
  bool has_ring_ = false;
  float radius_ = 0, end_ = 0, length_ = 0, reach_ = 0;
  std::int16_t color_ = 0;
};

}  // namespace seedmesh
