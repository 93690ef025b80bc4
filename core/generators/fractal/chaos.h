#pragma once
/// The chaos game (fortune wheel reduction copy machine): one point is moved again and again by a random map
/// (Barnsley and Demko, "Iterated function systems and the global construction of fractals", 1985).
#include "core/base/array.h"
#include "core/generators/fractal/instructions.h"

namespace seedmesh::fractal {

/// Points, and for each the index of the last map.
struct Cloud {
  Array<glm::vec3> position;
  Array<std::uint8_t> map;
};

/// Gives `count` points. A chain begins at a random point of the unit cube, and its first `drop` points are
/// left out. Up to 65,536 points are one chain, in the order of the game. More are divided into chunks of
/// that size with four alternating chains each, so that their maps are computed at the same time. Chunks and
/// chains do not depend on the number of threads. About 7 ns for each point on one core. The maps must
/// contract.
Cloud play(const Instructions& instructions, std::uint64_t count, std::uint32_t drop, Job& job);

}  // namespace seedmesh::fractal
