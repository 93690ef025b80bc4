#pragma once
/// Placing leaflets and leaves in the drawing of a larger leaf or twig.
#include <utility>

#include "core/base/math.h"
#include "core/geom/plant/leaf_shape.h"

namespace seedmesh {

/// The placement of a leaflet: its base, the direction of its tip in degrees to the right of +y, its length, and a
/// factor of its width. The factor is below 1 for a leaflet that is seen from the side. `bend`: how far the tip is bent
/// to the right, as a share of the length.
struct LeafletPlacement {
  glm::dvec2 at{0};
  double degrees = 0, length = 1, width = 1, bend = 0;

  glm::dvec2 operator()(glm::dvec2 p) const {
    const math::SinCos turn = math::sincos_degrees(degrees);
    const double x = p.x * width + bend * p.y * p.y;
    return at + glm::dvec2{x * turn.cos + p.y * turn.sin, p.y * turn.cos - x * turn.sin} * length;
  }
};

/// Returns the line in the frame of the drawing.
inline LeafLine moved(LeafLine line, const LeafletPlacement& placement) {
  return {placement(line.from), placement(line.to), line.width * placement.length,
          line.end_width * placement.length};
}

/// Adds a blade, given in the frame of the leaflet.
inline void add_blade(LeafDrawing& drawing, const LeafBlade& blade, const LeafletPlacement& placement) {
  LeafBlade moved_blade = blade;
  for (glm::dvec2& p : moved_blade.right) p = placement(p);
  for (glm::dvec2& p : moved_blade.left) p = placement(p);
  moved_blade.base = placement(blade.base);
  moved_blade.tip = placement(blade.tip);
  moved_blade.half_width *= placement.length * placement.width;
  for (LeafLine& vein : moved_blade.veins) vein = moved(vein, placement);
  drawing.blades.push_back(std::move(moved_blade));
}

}  // namespace seedmesh
