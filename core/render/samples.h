#pragma once
/// The surfaces that are visible to a camera.
#include "core/render/fragment.h"

namespace seedmesh::render {

/// The samples of a picture, row 0 at the top. Each has the number of the nearest triangle. Colour and normal
/// are computed from the triangle later (fragment.h), so that hidden surfaces cost little.
struct Samples {
  static constexpr std::uint32_t nothing = ~0U, blended = ~0U - 1;

  std::uint32_t size = 0;        ///< samples a side
  std::size_t stride = 0;        ///< length of a row, a multiple of 8
  Array<float> near;             ///< 1 / distance along the axis of the camera; 0: nothing
  Array<std::uint32_t> drawing;  ///< index into Scene::drawings, or one of the two constants
  Array<std::uint32_t> number;   ///< number of the triangle, or of the vertex of lines and points
  Array<Fragment> fragment;      ///< of blended samples; empty where no surface blends

  std::size_t at(std::uint32_t x, std::uint32_t y) const { return y * stride + x; }
};

/// Draws all drawings. Rows are drawn in bands, in parallel; their number does not change the result. Sheets that
/// blend are drawn last, in the order of the items. Cost: about 50 ns a triangle and 1 ns a covered sample.
Samples draw_samples(const ProjectedScene& shown, const Job& job);

/// Returns the depths of surfaces in parallel light, in rows of stride_of() numbers; greater is nearer, and `farthest`
/// where nothing is. Lines, points and surfaces that blend are left out.
Array<float> draw_depths(const ProjectedScene& shown, float farthest, const Job& job);

/// Returns the length of a row of the map.
constexpr std::size_t stride_of(std::uint32_t size) { return (std::size_t{size} + 7) & ~std::size_t{7}; }

}  // namespace seedmesh::render
