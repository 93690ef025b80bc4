#pragma once
/// The fortune wheel reduction copy machine: one point, moved again and again by a map drawn by chance
/// (Barnsley and Demko, "Iterated function systems and the global construction of fractals", 1985).
#include "core/base/array.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// Points, and the number of the map that each came by.
struct Cloud {
  Array<glm::vec3> position;
  Array<std::uint8_t> map;
};

/// `count` points. A chain begins at a point of the unit cube, drawn by its place, and its first `drop`
/// points are left out. Up to 65,536 points are one chain, in the order of the game; more are cut into chunks
/// of that many, of four chains each that take turns, so that the time of one map hides behind the others.
/// Neither chunks nor chains depend on the number of threads. About 7 ns a point and core. Maps contract
/// (checked before).
Cloud play(const Instructions& instructions, std::uint64_t count, std::uint32_t drop, Job& job);

}  // namespace seedmesh::fractal
