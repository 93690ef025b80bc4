#include "core/generators/fractal/faces.h"

#include <algorithm>
#include <bit>

#include "core/base/parallel.h"
#include "core/generators/fractal/sides.h"

namespace seedmesh::fractal {
namespace {

// With 16 entries in the vertex cache, the nine corners of a row are still there for the next row.
constexpr int band_bits = 8;

/// The squares of one slice and their corners, both as rows of bits.
class Slice {
 public:
  explicit Slice(const Side& side)
      : side_(side),
        words_(side.grid->row_words()),
        squares_(words_ * static_cast<std::size_t>(side.rows())),
        corners_(side) {}

  void read(int slice) {
    corners_.clear();
    squares_count = 0;
    for (int r = 0; r < side_.rows(); ++r) {
      std::uint64_t* squares = squares_.data() + static_cast<std::size_t>(r) * words_;
      side_.exposed(slice, r, squares);
      mark_corners(squares, corners_.row(r));
      mark_corners(squares, corners_.row(r + 1));
    }
    for (const std::uint64_t word : squares_) squares_count += static_cast<std::size_t>(std::popcount(word));
  }

  const std::uint64_t* squares(int r) const { return squares_.data() + static_cast<std::size_t>(r) * words_; }
  CornerRows& corners() { return corners_; }
  const CornerRows& corners() const { return corners_; }
  std::size_t words() const { return words_; }

  std::size_t squares_count = 0;

 private:
  void mark_corners(const std::uint64_t* squares, std::uint64_t* corners) const {
    std::uint64_t carry = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      corners[w] |= squares[w] | squares[w] << 1U | carry;
      carry = squares[w] >> 63U;
    }
    if (corners_.words() > words_) corners[words_] |= carry;
  }

  const Side& side_;
  std::size_t words_;
  std::vector<std::uint64_t> squares_;
  CornerRows corners_;
};

/// The first corner and square of a slice in the mesh.
struct Start {
  std::size_t corner = 0, square = 0;
};

/// Writes two triangles for each square.
void write_squares(const Side& side, const Slice& slice, std::uint32_t* out) {
  const bool right = side.turns_right();
  const CornerRows& corners = slice.corners();
  for (std::size_t band = 0; band < slice.words() * (64 / band_bits); ++band) {
    const std::size_t w = band / (64 / band_bits), low = band % (64 / band_bits) * band_bits;
    for (int r = 0; r < side.rows(); ++r) {
      for (std::uint64_t left = slice.squares(r)[w] >> low & 0xFFU; left != 0; left &= left - 1) {
        const std::size_t bit = low + static_cast<std::size_t>(std::countr_zero(left));
        // The two corners of a square in one row have consecutive numbers.
        const std::uint32_t a = corners.number(r, w, bit), b = corners.number(r + 1, w, bit);
        const std::uint32_t quad[2][6] = {{a, b + 1, a + 1, a, b, b + 1}, {a, a + 1, b + 1, a, b + 1, b}};
        std::copy_n(quad[right ? 1 : 0], 6, out);
        out += 6;
      }
    }
  }
}

}  // namespace

Solid solid_of(const Lattice& lattice, int rounds, const Job& job) {
  BitGrid by_x = grid_of(lattice, rounds, axes_by_x, job);
  BitGrid by_z = grid_of(lattice, rounds, axes_by_z, job);
  const Placement placement = placement_of(lattice, rounds);
  const glm::dvec3 origin = placement.origin + placement.cell * glm::dvec3(by_x.low());
  return {std::move(by_x), std::move(by_z), origin, placement.cell};
}

std::uint64_t count_exposed(const Solid& solid, const Job& job) {
  std::uint64_t count = 0;
  std::vector<std::uint64_t> row(std::max(solid.by_x.row_words(), solid.by_z.row_words()));
  for (const Side& side : sides_of(solid)) {
    for (int slice = 0; slice < side.slices(); ++slice) {
      job.check();
      for (int r = 0; r < side.rows(); ++r) {
        side.exposed(slice, r, row.data());
        for (std::size_t w = 0; w < side.grid->row_words(); ++w)
          count += static_cast<std::uint64_t>(std::popcount(row[w]));
      }
    }
  }
  return count;
}

Mesh exposed_faces(const Solid& solid, const SideColors* colors, Job& job) {
  const std::array<Side, 6> sides = sides_of(solid);
  std::array<std::vector<Start>, 6> starts;
  Start end;
  for (std::size_t s = 0; s < 6; ++s) {
    const Side& side = sides[s];
    starts[s].resize(static_cast<std::size_t>(side.slices()));
    parallel_for(job, starts[s].size(), 4, [&](std::size_t begin, std::size_t stop, std::size_t) {
      Slice slice(side);
      for (std::size_t i = begin; i < stop; ++i) {
        job.check();
        slice.read(static_cast<int>(i));
        starts[s][i] = {slice.corners().count(), slice.squares_count};
      }
    });
    for (Start& start : starts[s]) {
      const Start size = start;
      start = end;
      end.corner += size.corner;
      end.square += size.square;
    }
  }
  job.spend(Resource::triangles, 2 * end.square);

  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, end.corner);
  mesh.normal = Array<glm::vec3>(job, end.corner);
  if (colors) mesh.color = Array<glm::u8vec4>(job, end.corner);
  mesh.index.wide = Array<std::uint32_t>(job, 6 * end.square);
  mesh.cache_ordered = true;
  for (std::size_t s = 0; s < 6; ++s) {
    parallel_for(job, starts[s].size(), 4, [&](std::size_t begin, std::size_t stop, std::size_t) {
      Slice slice(sides[s]);
      for (std::size_t i = begin; i < stop; ++i) {
        job.check();
        slice.read(static_cast<int>(i));
        if (slice.squares_count == 0) continue;
        slice.corners().write(solid, static_cast<int>(i), colors, mesh, starts[s][i].corner);
        write_squares(sides[s], slice, mesh.index.wide.data() + 6 * starts[s][i].square);
      }
    });
  }
  return mesh;
}

}  // namespace seedmesh::fractal
