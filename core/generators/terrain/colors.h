#pragma once
/// What a field looks like: which ground lies where, and its colour.
#include <glm/glm.hpp>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

enum class PaletteName { alpine, desert, tropical, arctic, volcanic, moon, grey, none };

/// Shares of four kinds of ground, which sum to 1: what a splat map holds.
struct Cover {
  float rock = 0, grass = 0, sand = 0, snow = 0;
};

/// The measures of a place that its look depends on.
struct Site {
  float height = 0;  ///< metres
  float slope = 0;   ///< rise in a run of one
  float hollow = 0;  ///< how much lower than its surroundings, in a run of one; ridges are below 0
  float patch = 0;   ///< slow noise, about -1 to 1, that breaks up straight borders
};

/// Colours of one palette over one range of heights.
class Looks {
 public:
  /// `level`: of water; at or below range.low there is none.
  Looks(PaletteName palette, const Range& range, float level);
  Cover cover(const Site& site) const;
  glm::vec3 color(const Site& site) const;  ///< linear

 private:
  struct Shares {
    float bed, shore, cliff, peak, high;  ///< each laid over those before it, `high` on the plain ground
  };
  Shares shares(const Site& site) const;

  PaletteName palette_;
  Range range_;
  float level_, span_;
  bool water_;
};

/// Sites of a field, row by row, margin used: what sites() fills for one row.
class Sites {
 public:
  Sites(const Field& field, const Window& world, Rng rng, const Job& job);
  Site at(std::int32_t x, std::int32_t z) const;
  /// Slopes eastwards and southwards at a sample: from both neighbours, or the one that there is.
  glm::vec2 gradient(std::int32_t x, std::int32_t z) const;

 private:
  const Field& field_;
  Field patches_;
  std::int32_t reach_;
  float per_cell_;
};

/// The linear colour of a sample. About 40 ns.
glm::u8vec4 vertex_color(const Sites& sites, const Looks& looks, std::int32_t x, std::int32_t z);

/// Linear colours of all samples, row by row; empty for the palette `none`. About 40 ns a sample.
Array<glm::u8vec4> vertex_colors(const Field& field, const Sites& sites, const Looks& looks, const Job& job);

/// A linear colour as 8-bit sRGB (IEC 61966-2-1).
glm::u8vec3 srgb_of(const glm::vec3& linear);

}  // namespace seedmesh::terrain
