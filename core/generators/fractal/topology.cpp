/// Bodies and cavities are found by joining runs of cells in neighbouring rows (Rosenfeld and Pfaltz,
/// "Sequential operations in digital picture processing", 1966) with disjoint sets.
#include "core/generators/fractal/topology.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/base/disjoint_sets.h"

namespace seedmesh::fractal {
namespace {

using Words = std::vector<std::uint64_t>;

std::uint64_t ones(std::uint64_t word) { return static_cast<std::uint64_t>(std::popcount(word)); }

/// For each set of full cells among the eight around a corner: is the surface one fan around the corner? Cell
/// i is at (i & 1, i >> 1 & 1, i >> 2).
std::array<bool, 256> plain_corners() {
  std::array<bool, 256> plain{};
  const auto connected = [](unsigned cells) {
    if (cells == 0) return true;
    unsigned reached = cells & (~cells + 1);
    for (int step = 0; step < 8; ++step) {
      unsigned next = reached;
      for (unsigned i = 0; i < 8; ++i) {
        if ((reached >> i & 1U) == 0) continue;
        for (const unsigned axis : {1U, 2U, 4U}) next |= cells & 1U << (i ^ axis);
      }
      reached = next;
    }
    return reached == cells;
  };
  for (unsigned cells = 0; cells < 256; ++cells) plain[cells] = connected(cells) && connected(~cells & 255U);
  return plain;
}

/// Gives rows of cells, which are empty outside the grid and one word longer than the rows of the grid.
class CellRows {
 public:
  explicit CellRows(const BitGrid& grid) : grid_(grid), words_(grid.row_words() + 1) {}
  std::size_t words() const { return words_; }

  void row(int y, int z, Words& out) const {
    out.assign(words_, 0);
    if (y < 0 || z < 0 || y >= grid_.size().y || z >= grid_.size().z) return;
    std::copy_n(grid_.row(y, z), grid_.row_words(), out.begin());
  }

  /// The row moved by one cell: bit i is the cell before corner i.
  static void before(const Words& row, Words& out) {
    std::uint64_t carry = 0;
    out.resize(row.size());
    for (std::size_t w = 0; w < row.size(); ++w) {
      out[w] = row[w] << 1U | carry;
      carry = row[w] >> 63U;
    }
  }

 private:
  const BitGrid& grid_;
  std::size_t words_;
};

/// The four cells around each of 64 edges; a and d are opposite each other, and so are b and c.
void count_edges(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d,
                 SolidTopology& topology) {
  topology.edges += ones((a | b | c | d) & ~(a & b & c & d));
  topology.four_face_edges += ones((a & d & ~b & ~c) | (b & c & ~a & ~d));
}

void count_pinched(const std::array<std::uint64_t, 8>& cells, std::uint64_t corners,
                   SolidTopology& topology) {
  static const std::array<bool, 256> plain = plain_corners();
  for (std::uint64_t left = corners; left != 0; left &= left - 1) {
    const int bit = std::countr_zero(left);
    unsigned around = 0;
    for (unsigned i = 0; i < 8; ++i) around |= static_cast<unsigned>(cells[i] >> bit & 1U) << i;
    topology.pinched_corners += plain[around] ? 0 : 1;
  }
}

enum class Corners { count, classify };

void count_all(const BitGrid& grid, Corners how, const Job& job, SolidTopology& topology) {
  const CellRows cells(grid);
  std::array<Words, 4> rows, moved;  // (y-1, z-1), (y, z-1), (y-1, z), (y, z)
  for (int z = 0; z <= grid.size().z; ++z) {
    job.check();
    for (int y = 0; y <= grid.size().y; ++y) {
      for (int i = 0; i < 4; ++i) {
        cells.row(y - 1 + (i & 1), z - 1 + (i >> 1), rows[static_cast<std::size_t>(i)]);
        CellRows::before(rows[static_cast<std::size_t>(i)], moved[static_cast<std::size_t>(i)]);
      }
      for (std::size_t w = 0; w < cells.words(); ++w) {
        const std::uint64_t a = rows[0][w], b = rows[1][w], c = rows[2][w], d = rows[3][w];
        const std::uint64_t e = moved[0][w], f = moved[1][w], g = moved[2][w], h = moved[3][w];
        count_edges(a, b, c, d, topology);                         // along X, from the corner on
        if (y < grid.size().y) count_edges(f, b, h, d, topology);  // along Y: cells of row y
        if (z < grid.size().z) count_edges(g, c, h, d, topology);  // along Z: cells of slice z
        topology.squares += ones(h ^ d) * (y < grid.size().y && z < grid.size().z ? 1 : 0);
        if (z < grid.size().z) topology.squares += ones(c ^ d);
        if (y < grid.size().y) topology.squares += ones(b ^ d);
        const std::uint64_t corners = (a | b | c | d | e | f | g | h) & ~(a & b & c & d & e & f & g & h);
        topology.corners += ones(corners);
        if (how == Corners::classify) count_pinched({e, a, f, b, g, c, h, d}, corners, topology);
      }
    }
  }
}

/// Counts connected sets of runs.
class Bodies {
 public:
  struct Run {
    int begin, end;
    std::uint32_t set;
  };

  std::uint32_t add() {
    ++count;
    return sets_.add();
  }

  void join(const std::vector<Run>& a, const std::vector<Run>& b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      if (std::max(a[i].begin, b[j].begin) < std::min(a[i].end, b[j].end) && sets_.join(a[i].set, b[j].set))
        --count;
      if (a[i].end < b[j].end) {
        ++i;
      } else {
        ++j;
      }
    }
  }

  std::uint64_t count = 0;

 private:
  DisjointSets sets_;
};

/// Runs of full cells; or, if `empty` is all ones, of empty cells in the grid with a layer of empty cells
/// around it.
std::vector<Bodies::Run> runs_of(const BitGrid& grid, int y, int z, std::uint64_t empty, Bodies& bodies) {
  std::vector<Bodies::Run> runs;
  const glm::ivec3 size = grid.size();
  const bool outside = y < 0 || z < 0 || y >= size.y || z >= size.z;
  if (outside) {
    if (empty != 0) runs.push_back({-1, size.x + 1, bodies.add()});
    return runs;
  }
  const std::uint64_t* row = grid.row(y, z);
  const auto is_in = [&](int x) { return ((row[x / 64] ^ empty) >> (x % 64) & 1U) != 0; };
  int begin = -1;
  bool in = empty != 0;
  for (int x = 0; x < size.x; ++x) {
    if (is_in(x) == in) continue;
    if (in) runs.push_back({begin, x, bodies.add()});
    in = !in;
    begin = x;
  }
  if (in || empty != 0) {
    if (!in) begin = size.x;
    runs.push_back({begin, size.x + 1, bodies.add()});
  }
  return runs;
}

std::uint64_t count_bodies(const BitGrid& grid, bool empty, const Job& job) {
  Bodies bodies;
  const int margin = empty ? 1 : 0;
  const std::uint64_t flip = empty ? ~std::uint64_t{0} : 0;
  std::vector<std::vector<Bodies::Run>> below(static_cast<std::size_t>(grid.size().y + 2 * margin)), here;
  for (int z = -margin; z < grid.size().z + margin; ++z) {
    job.check();
    here.clear();
    for (int y = -margin; y < grid.size().y + margin; ++y) {
      here.push_back(runs_of(grid, y, z, flip, bodies));
      if (here.size() > 1) bodies.join(here[here.size() - 2], here.back());
      bodies.join(below[here.size() - 1], here.back());
    }
    std::swap(below, here);
  }
  return bodies.count;
}

}  // namespace

std::optional<std::uint64_t> SolidTopology::genus() const {
  if (four_face_edges > 0 || pinched_corners > 0) return std::nullopt;
  const std::uint64_t doubled =
      2 * surfaces + edges - corners - squares;  // 2 * genus = 2 * surfaces - Euler number
  return doubled / 2;
}

SolidTopology count_elements(const BitGrid& grid, const Job& job) {
  SolidTopology topology;
  count_all(grid, Corners::count, job, topology);
  return topology;
}

SolidTopology topology_of(const BitGrid& grid, const Job& job) {
  SolidTopology topology;
  topology.cells = grid.count();
  count_all(grid, Corners::classify, job, topology);
  if (topology.four_face_edges == 0 && topology.pinched_corners == 0)
    topology.surfaces = count_bodies(grid, false, job) + count_bodies(grid, true, job) - 1;
  return topology;
}

}  // namespace seedmesh::fractal
