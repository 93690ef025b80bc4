#pragma once
/// Ground types and colours of a field.
#include <glm/glm.hpp>

#include "core/generators/terrain/field.h"

namespace seedmesh::terrain {

enum class PaletteName { alpine, desert, tropical, arctic, volcanic, moon, stone, mossy, forest, grey, none };

/// Shares of four ground types, which sum to 1: the weights of a splat map.
struct Cover {
  float rock = 0, grass = 0, sand = 0, snow = 0;
};

/// Properties of a position that determine its colour.
struct Site {
  float height = 0;  ///< metres
  float slope = 0;   ///< rise over run
  float hollow = 0;  ///< depth below the surroundings, as rise over run; negative on ridges
  float patch = 0;   ///< noise of low frequency, about -1 to 1, that makes borders irregular
};

inline Site blend(const Site& a, const Site& b, float t) {
  return {a.height + t * (b.height - a.height), a.slope + t * (b.slope - a.slope),
          a.hollow + t * (b.hollow - a.hollow), a.patch + t * (b.patch - a.patch)};
}

/// Returns the share of fallen leaves and needles among the plants on the floor of a forest, by patches.
float litter_share(const Site& site);

/// Colours of one palette for one range of heights.
class GroundColors {
 public:
  /// `level`: height of the water; there is none at or below range.low.
  GroundColors(PaletteName palette, const Range& range, float level);
  Cover cover(const Site& site) const;
  glm::vec3 color(const Site& site) const;                                ///< linear RGB
  float high_share(const Site& site) const { return shares(site).high; }  ///< share of high ground
  PaletteName palette() const { return palette_; }

 private:
  struct Shares {
    float bed, shore, cliff, peak, high;  ///< each covers the ones after it; `high` covers the plain ground
  };
  Shares shares(const Site& site) const;
  struct LinearRamp {
    glm::vec3 bed{0}, shore{0}, low{0}, high{0}, cliff{0}, peak{0};
  };

  PaletteName palette_;
  LinearRamp linear_;
  Range range_;
  float level_, span_;
  bool water_;
};

/// Reads the sites of the samples of a field, including those of the margin.
class Sites {
 public:
  Sites(const Field& field, const Window& world, Rng rng, const Job& job);
  Site at(std::int32_t x, std::int32_t z) const;
  /// Slopes to the east and south at a sample, from both neighbours or the only one.
  glm::vec2 gradient(std::int32_t x, std::int32_t z) const;

 private:
  const Field& field_;
  Field patches_;
  std::int32_t reach_;
  float per_cell_;
};

/// Returns the linear colour of a sample. Cost: about 40 ns.
glm::u8vec4 vertex_color(const Sites& sites, const GroundColors& ground_colors, std::int32_t x,
                         std::int32_t z);

/// Returns the linear colours of all samples, row by row; empty for the palette `none`. Cost: about 40 ns for
/// each sample.
Array<glm::u8vec4> vertex_colors(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                                 const Job& job);

/// Converts a linear colour to 8-bit sRGB (IEC 61966-2-1).
glm::u8vec3 srgb_of(const glm::vec3& linear);

}  // namespace seedmesh::terrain
