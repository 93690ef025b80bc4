#pragma once
/// Frames of many stems as nine columns of numbers, so that a loop over them can be one of vectors.
#include <cstddef>

#include "core/geom/frame.h"

namespace seedmesh::tree {

template <std::size_t most>
inline Frame frame_in(const double (*columns)[most], std::size_t i) {
  return {{columns[0][i], columns[1][i], columns[2][i]},
          {columns[3][i], columns[4][i], columns[5][i]},
          {columns[6][i], columns[7][i], columns[8][i]}};
}

template <std::size_t most>
inline void put_frame(double (*columns)[most], std::size_t i, const Frame& frame) {
  columns[0][i] = frame.heading.x;
  columns[1][i] = frame.heading.y;
  columns[2][i] = frame.heading.z;
  columns[3][i] = frame.left.x;
  columns[4][i] = frame.left.y;
  columns[5][i] = frame.left.z;
  columns[6][i] = frame.up.x;
  columns[7][i] = frame.up.y;
  columns[8][i] = frame.up.z;
}

}  // namespace seedmesh::tree
