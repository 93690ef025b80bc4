#include "core/generators/fractal/faces.h"

#include <algorithm>
#include <bit>

#include "core/base/parallel.h"

namespace seedmesh::fractal {
namespace {

constexpr Axes axes_by_x{0, 1, 2}, axes_by_z{2, 1, 0};
constexpr int band_bits =
    8;  ///< with 16 entries of cache: nine corners of a row wait until the next one uses them

/// One of the six sides: the grid that shows it, which of the grid's axes it looks along, and how the grid's
/// axes lie in the world.
struct Side {
  const BitGrid* grid;
  Axes axes;       ///< of the world
  int slice_axis;  ///< 1 or 2, of the grid
  int step;        ///< +1 or -1 along it

  int rows() const { return grid->size()[3 - slice_axis]; }
  int slices() const { return grid->size()[slice_axis]; }
  int world_normal() const { return axes[static_cast<std::size_t>(slice_axis)]; }
  int world_rows() const { return axes[static_cast<std::size_t>(3 - slice_axis)]; }
  int world_bits() const { return axes[0]; }
  std::size_t number() const { return static_cast<std::size_t>(2 * world_normal() + (step > 0 ? 1 : 0)); }
  /// Do bits, rows, normal make a right-handed frame?
  bool turns_right() const {
    const int bits = world_bits(), rows_axis = world_rows();
    return ((bits + 1) % 3 == rows_axis) == (step > 0);
  }

  const std::uint64_t* row(int slice, int r) const {
    return slice_axis == 2 ? grid->row(r, slice) : grid->row(slice, r);
  }
  /// The exposed squares of a row of a slice.
  void exposed(int slice, int r, std::uint64_t* out) const {
    const std::size_t words = grid->row_words();
    const std::uint64_t* full = row(slice, r);
    const int beyond = slice + step;
    if (beyond < 0 || beyond >= slices()) {
      std::copy_n(full, words, out);
      return;
    }
    const std::uint64_t* cover = row(beyond, r);
    for (std::size_t w = 0; w < words; ++w) out[w] = full[w] & ~cover[w];
  }
};

std::array<Side, 6> sides_of(const Solid& solid) {
  return {Side{&solid.by_z, axes_by_z, 2, -1}, Side{&solid.by_z, axes_by_z, 2, 1},
          Side{&solid.by_x, axes_by_x, 1, -1}, Side{&solid.by_x, axes_by_x, 1, 1},
          Side{&solid.by_x, axes_by_x, 2, -1}, Side{&solid.by_x, axes_by_x, 2, 1}};
}

/// The squares of one slice and the corners that they need, both as rows of bits.
class Slice {
 public:
  explicit Slice(const Side& side)
      : side_(side),
        words_(side.grid->row_words()),
        corner_words_(static_cast<std::size_t>(side.grid->size().x) / 64 + 1),
        squares_(words_ * static_cast<std::size_t>(side.rows())),
        corners_(corner_words_ * (static_cast<std::size_t>(side.rows()) + 1)) {}

  void look(int slice) {
    std::fill(corners_.begin(), corners_.end(), 0);
    squares_count = corners_count = 0;
    for (int r = 0; r < side_.rows(); ++r) {
      std::uint64_t* squares = squares_.data() + static_cast<std::size_t>(r) * words_;
      side_.exposed(slice, r, squares);
      mark_corners(squares, corner_row(r));
      mark_corners(squares, corner_row(r + 1));
    }
    for (const std::uint64_t word : squares_) squares_count += static_cast<std::size_t>(std::popcount(word));
    for (const std::uint64_t word : corners_) corners_count += static_cast<std::size_t>(std::popcount(word));
  }

  const std::uint64_t* squares(int r) const { return squares_.data() + static_cast<std::size_t>(r) * words_; }
  const std::uint64_t* corners(int r) const {
    return corners_.data() + static_cast<std::size_t>(r) * corner_words_;
  }
  std::size_t words() const { return words_; }
  std::size_t corner_words() const { return corner_words_; }

  std::size_t squares_count = 0, corners_count = 0;

 private:
  std::uint64_t* corner_row(int r) { return corners_.data() + static_cast<std::size_t>(r) * corner_words_; }
  void mark_corners(const std::uint64_t* squares, std::uint64_t* corners) const {
    std::uint64_t carry = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      corners[w] |= squares[w] | squares[w] << 1U | carry;
      carry = squares[w] >> 63U;
    }
    if (corner_words_ > words_) corners[words_] |= carry;
  }

  const Side& side_;
  std::size_t words_, corner_words_;
  std::vector<std::uint64_t> squares_, corners_;
};

/// Where the corners and squares of a slice begin in the mesh.
struct Place {
  std::size_t corner = 0, square = 0;
};

/// Writes one slice at its place.
class SliceWriter {
 public:
  SliceWriter(const Side& side, const Solid& solid, const SideColors* colors, Mesh& mesh)
      : side_(side), solid_(solid), colors_(colors), mesh_(mesh), slice_(side), ranks_(0) {}

  void write(int slice, const Place& place) {
    slice_.look(slice);
    if (slice_.squares_count == 0) return;
    write_corners(slice, place.corner);
    write_squares(mesh_.index.wide.data() + 6 * place.square);
  }

 private:
  /// Positions, and for each word of each row of corners the number of the first corner in it.
  void write_corners(int slice, std::size_t at) {
    const int normal = side_.world_normal(), rows = side_.world_rows(), bits = side_.world_bits();
    glm::vec3 up(0);
    up[normal] = static_cast<float>(side_.step);
    const auto along = [&](int axis, int index) {
      return static_cast<float>(solid_.origin[axis] + solid_.cell[axis] * index);
    };
    ranks_.assign(slice_.corner_words() * (static_cast<std::size_t>(side_.rows()) + 1), 0);
    glm::vec3 p(0);
    p[normal] = along(normal, slice + (side_.step > 0 ? 1 : 0));
    for (int r = 0; r <= side_.rows(); ++r) {
      p[rows] = along(rows, r);
      const std::uint64_t* corners = slice_.corners(r);
      for (std::size_t w = 0; w < slice_.corner_words(); ++w) {
        ranks_[static_cast<std::size_t>(r) * slice_.corner_words() + w] = static_cast<std::uint32_t>(at);
        for (std::uint64_t left = corners[w]; left != 0; left &= left - 1) {
          p[bits] = along(bits, static_cast<int>(w) * 64 + std::countr_zero(left));
          mesh_.position[at] = p;
          mesh_.normal[at] = up;
          if (colors_) mesh_.color[at] = (*colors_)[side_.number()];
          ++at;
        }
      }
    }
  }

  void write_squares(std::uint32_t* out) const {
    const bool right = side_.turns_right();
    for (std::size_t band = 0; band < slice_.words() * (64 / band_bits); ++band) {
      const std::size_t w = band / (64 / band_bits), low = band % (64 / band_bits) * band_bits;
      for (int r = 0; r < side_.rows(); ++r) {
        for (std::uint64_t left = slice_.squares(r)[w] >> low & 0xFFU; left != 0; left &= left - 1) {
          const std::size_t bit = low + static_cast<std::size_t>(std::countr_zero(left));
          // The two corners of a square in one row are neighbours in that row's numbering.
          const std::uint32_t a = rank(r, w, bit), b = rank(r + 1, w, bit);
          const std::uint32_t quad[2][6] = {{a, b + 1, a + 1, a, b, b + 1}, {a, a + 1, b + 1, a, b + 1, b}};
          std::copy_n(quad[right ? 1 : 0], 6, out);
          out += 6;
        }
      }
    }
  }

  std::uint32_t rank(int r, std::size_t w, std::size_t bit) const {
    const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
    return ranks_[static_cast<std::size_t>(r) * slice_.corner_words() + w] +
           static_cast<std::uint32_t>(std::popcount(slice_.corners(r)[w] & below));
  }

  const Side& side_;
  const Solid& solid_;
  const SideColors* colors_;
  Mesh& mesh_;
  Slice slice_;
  std::vector<std::uint32_t> ranks_;
};

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
  std::array<std::vector<Place>, 6> places;
  Place end;
  for (std::size_t s = 0; s < 6; ++s) {
    const Side& side = sides[s];
    places[s].resize(static_cast<std::size_t>(side.slices()));
    parallel_for(job, places[s].size(), 4, [&](std::size_t begin, std::size_t stop, std::size_t) {
      Slice slice(side);
      for (std::size_t i = begin; i < stop; ++i) {
        job.check();
        slice.look(static_cast<int>(i));
        places[s][i] = {slice.corners_count, slice.squares_count};
      }
    });
    for (Place& place : places[s]) {
      const Place size = place;
      place = end;
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
    parallel_for(job, places[s].size(), 4, [&](std::size_t begin, std::size_t stop, std::size_t) {
      SliceWriter writer(sides[s], solid, colors, mesh);
      for (std::size_t i = begin; i < stop; ++i) {
        job.check();
        writer.write(static_cast<int>(i), places[s][i]);
      }
    });
  }
  return mesh;
}

}  // namespace seedmesh::fractal
