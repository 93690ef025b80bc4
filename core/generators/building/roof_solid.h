#pragma once
/// Roofs as solids of the shape grammar: the body that a roof operation makes of a face, and the cover that lies on it.
#include <string>

#include "core/generators/building/solid.h"
#include "core/geom/roof.h"

namespace seedmesh::building {

/// A solid in the unit cube of the scope that begins at `low` and has `size`, both in the frame of the face.
struct RoofPiece {
  Solid solid;
  glm::dvec3 low{0}, size{0};
};

struct RoofPieces {
  RoofPiece body;   ///< closed; no faces where a flat roof has no height
  RoofPiece cover;  ///< closed; no faces without an overhang
  std::vector<std::string> warnings;
};

/// `face` is flat, its normal along `axis` (1 or 2), in a scope of `size`; heights go along the normal. A face that is no
/// plan (it touches itself) gets neither piece and a warning. Numbers of edges in the options are those of its outer
/// loop, then of its holes.
RoofPieces roof_pieces(const Solid& face, int axis, const glm::dvec3& size, const RoofOptions& options,
                       const Job& job);

}  // namespace seedmesh::building
