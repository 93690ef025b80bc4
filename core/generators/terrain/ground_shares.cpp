#include "core/generators/terrain/ground_shares.h"

#include "core/generators/terrain/smooth_step.h"

namespace seedmesh::terrain {
namespace {

// Bare rock is steeper than loose stones lie (35 degrees), by this much at the borders between both.
constexpr float scree_slope = 0.7F, rock_slope = 0.95F;

}  // namespace

GroundShares ground_shares(const GroundColors& colors, const Site& site) {
  const Cover cover = colors.cover(site);
  const float steep = smooth_step(scree_slope, rock_slope, site.slope + 0.12F * site.patch);
  GroundShares all;
  const auto lay = [&all](GroundShares::Kind kind, float share) { all.of[kind] += share; };
  const auto lay_stone = [&](float share) {
    lay(GroundShares::rock, share * steep);
    lay(GroundShares::scree, share * (1 - steep));
  };
  switch (colors.palette()) {
    case PaletteName::desert:
      lay(GroundShares::sand, cover.grass + cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::arctic:
      lay(GroundShares::snow, cover.grass + cover.snow + cover.sand);
      lay_stone(cover.rock);
      break;
    case PaletteName::volcanic:
    case PaletteName::moon:
    case PaletteName::stone:
      lay(GroundShares::soil, cover.sand + cover.grass);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::mossy: {
      // Between moss and herbs, the floor of a forest is litter.
      const float litter = smooth_step(-0.3F, 0.3F, site.patch);
      lay(GroundShares::grass, cover.grass * (1 - litter));
      lay(GroundShares::soil, cover.grass * litter + cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    }
    case PaletteName::forest: {
      // High ground is above the tree line and has no litter.
      const float litter = litter_share(site) * (1 - colors.high_share(site));
      lay(GroundShares::grass, cover.grass * (1 - litter));
      lay(GroundShares::litter, cover.grass * litter);
      lay(GroundShares::soil, cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    }
    case PaletteName::tropical:
      lay(GroundShares::grass, cover.grass);
      lay(GroundShares::sand, cover.sand);
      lay_stone(cover.rock + cover.snow);
      break;
    case PaletteName::alpine:
      lay(GroundShares::grass, cover.grass);
      lay(GroundShares::snow, cover.snow);
      lay(GroundShares::scree, cover.sand);
      lay_stone(cover.rock);
      break;
    case PaletteName::grey:
    case PaletteName::none:
      lay(GroundShares::soil, cover.sand + cover.grass + cover.snow);
      lay_stone(cover.rock);
  }
  return all;
}

}  // namespace seedmesh::terrain
