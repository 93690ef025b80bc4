#pragma once
/// The chaos game (fortune wheel reduction copy machine): one point is moved again and again by a random map
/// (Barnsley and Demko, "Iterated function systems and the global construction of fractals", 1985).
#include <span>
#include "core/base/array.h"

#include "core/generators/api.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// Points, and for each point the index of the map that was applied last.
struct Cloud {
  Array<glm::vec3> position;
  Array<std::uint8_t> map;
};

/// Draws the first points of chains: uniformly over the surface of an element, or over its lines.
class StartPoints {
 public:
  /// Without primitives, points are drawn in the unit cube.
  explicit StartPoints(std::span<const Primitive> element = {});

  glm::dvec3 draw(Rng rng) const;

 private:
  struct Piece {
    glm::dvec3 a, ab, ac;  ///< a corner and the two edges from it; for a line, `ac` is 0
    double until;          ///< sum of the areas, or lengths, up to this piece
  };
  std::vector<Piece> pieces_;
};

/// Returns the first points of a request: on its element, or in the unit cube. Errors: those of the element's model.
Result<StartPoints> start_of(const FractalParams& params, const GenerateContext& context);

/// Returns `count` points. A chain begins at a point of `start`, and its first `drop` points are left out. Up to
/// 65,536 points are one chain, in the order of the game. More are divided into chunks of that size with four
/// alternating chains each, so that their maps are computed at the same time. Chunks and chains do not depend on
/// the number of threads. About 7 ns for each point on one core. The maps must contract.
Cloud play(const Instructions& instructions, const StartPoints& start, std::uint64_t count,
           std::uint32_t drop, Job& job);

}  // namespace seedmesh::fractal
