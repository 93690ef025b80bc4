#pragma once
/// Rounds of writing: the first writes all limbs, later ones only limbs for which something has changed.
#include <functional>
#include <vector>

#include "core/geom/plant/graft/bark_buffers.h"
#include "core/geom/plant/graft/graft_input.h"

namespace seedmesh {

/// Which faces of a limb have to be checked again: none, those at the loop that it begins with, or all.
enum class Recheck : std::uint8_t { nothing, loop, all };

struct BarkRounds {
  std::vector<JoinMode> written;      ///< GraftInput::join at the last round; empty before the first one
  std::vector<std::uint32_t> parent;  ///< parent of each limb; empty in the first round
  std::vector<std::uint8_t> dirty;    ///< 1 for each limb that is written in this round
  std::vector<std::uint8_t> touched;  ///< 1 for each pair of groups whose parent or child limb is dirty
  std::vector<Recheck> recheck;       ///< recheck of each limb
  bool is_large = true;               ///< enough to check for more than one thread

  bool is_first() const { return parent.empty(); }
};

/// Writes all limbs, or, from the second round on, those whose join mode or loop has changed and the limbs
/// that they grow from. New ranges lie behind the old ones. Sets what has to be checked. The first round uses
/// all threads of the job where that is faster; the result does not depend on it. Spends Resource::triangles.
void write_round(const GraftInput& in, BarkBuffers& bark, BarkRounds& rounds, Job& job);

/// The first round on all threads of the job: limbs in contiguous parts, each with buffers of its own, which
/// are appended to `bark`. Returns false, with nothing written, for trees that are too small or too large, or
/// whose limbs are in an order that cannot be cut.
bool write_in_parts(const GraftInput& in, BarkBuffers& bark, Job& job);

/// Calls parallel_for(). In a round with little to check, runs `body` on the calling thread instead.
void for_chunks(const BarkRounds& rounds, const Job& job, std::size_t count, std::size_t chunk,
                const std::function<void(std::size_t begin, std::size_t end, std::size_t index)>& body);

/// Returns the end of the triangles of a limb that have to be checked; they begin where its range begins.
std::uint32_t recheck_end(const BarkBuffers& bark, const BarkRounds& rounds, std::size_t limb);

/// Whether a corner of the triangle is on a loop that has changed.
bool is_touched(const BarkBuffers& bark, const BarkRounds& rounds, std::uint32_t triangle);

/// Calls each(triangle) for the triangles of a limb at changed loops, as far as they have to be checked.
template <class Each>
void for_loop_triangles(const BarkBuffers& bark, const BarkRounds& rounds, std::size_t limb,
                        const Each& each) {
  const LimbRange& range = bark.range[limb];
  const std::uint32_t end = recheck_end(bark, rounds, limb);
  for (std::size_t i = range.begin.loop_triangle; i < range.end.loop_triangle; ++i) {
    const std::uint32_t triangle = bark.loop_triangles[i];
    if (triangle >= end) break;
    if (rounds.is_first() || is_touched(bark, rounds, triangle)) each(triangle);
  }
}

}  // namespace seedmesh
