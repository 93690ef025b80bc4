#pragma once
/// How all meshes of a height field divide a square into two triangles.
#include <array>
#include <cmath>

namespace seedmesh::terrain {

/// Returns true if the diagonal from the north-western to the south-eastern corner divides a square. The
/// diagonal with the smaller difference of heights is used.
template <class Height>
bool falls_to_south_east(Height nw, Height ne, Height sw, Height se) {
  return std::abs(nw - se) <= std::abs(ne - sw);
}

/// Returns the corners of both triangles of a square, counter-clockwise as seen from above.
template <class Corner>
std::array<std::array<Corner, 3>, 2> divided_square(bool falls, Corner nw, Corner ne, Corner sw, Corner se) {
  if (falls) return {{{nw, sw, se}, {nw, se, ne}}};
  return {{{nw, sw, ne}, {ne, sw, se}}};
}

}  // namespace seedmesh::terrain
