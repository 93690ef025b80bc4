#include "core/geom/mesh/repeated_pieces.h"

#include <algorithm>
#include <span>
#include <vector>

#include "core/base/wide.h"

namespace seedmesh {
namespace {

// Limits of the search: corners of a piece, and number of attempts.
constexpr std::size_t most_repeated = 4096;
constexpr int most_tries = 32;
constexpr std::size_t stretch = 256;

bool uses_all(std::span<const std::uint32_t> index, std::size_t vertices) {
  std::vector<bool> used(vertices, false);
  for (const std::uint32_t i : index) used[i] = true;
  return std::find(used.begin(), used.end(), false) == used.end();
}

/// True where every index from `corners` on is the index `corners` before it plus `piece`.
SEEDMESH_WIDE bool goes_on(const std::uint32_t* index, std::size_t count, std::size_t corners,
                           std::uint32_t piece) {
  // In blocks, so that an early difference ends the loop early.
  for (std::size_t first = corners; first < count; first += stretch) {
    std::uint32_t off = 0;
    for (std::size_t i = first; i < std::min(count, first + stretch); ++i)
      off |= index[i] - index[i - corners] - piece;
    if (off != 0) return false;
  }
  return true;
}

}  // namespace

Repeats repeats_of(const Array<std::uint32_t>& index, std::size_t vertices) {
  std::uint32_t most = 0;
  int tries = 0;
  for (std::size_t corners = 0; corners + 3 <= std::min(index.size() / 2 + 3, most_repeated); corners += 3) {
    const std::uint32_t* corner = index.data() + corners;
    const std::uint32_t piece = most + 1;
    if (corners > 0 && std::min({corner[0], corner[1], corner[2]}) == piece) {
      const std::size_t times = index.size() / corners;
      bool repeats = times * corners == index.size() && times * piece == vertices;
      repeats = repeats && goes_on(index.data(), index.size(), corners, piece);
      if (repeats && uses_all(index.span().first(corners), piece)) return {piece, corners};
      if (++tries == most_tries) break;
    }
    most = std::max({most, corner[0], corner[1], corner[2]});
  }
  return {};
}

}  // namespace seedmesh
