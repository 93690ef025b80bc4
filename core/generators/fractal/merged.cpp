#include "core/generators/fractal/merged.h"

#include "core/base/parallel.h"
#include "core/generators/fractal/sides.h"

namespace seedmesh::fractal {
namespace {

constexpr std::size_t slices_a_chunk = 4;

/// The squares [bit, bit_end) of the rows [row, row_end) of a slice.
struct Rectangle {
  int bit, bit_end, row, row_end;
};

/// Calls use(begin, end) for each run of set bits, in order.
template <class Use>
void each_run(const std::uint64_t* words, int size, Use use) {
  const auto next = [&](int from, bool wanted) {
    while (from < size) {
      std::uint64_t word = words[from / 64];
      if (!wanted) word = ~word;
      word >>= static_cast<unsigned>(from % 64);
      if (word != 0) return std::min(size, from + std::countr_zero(word));
      from = (from / 64 + 1) * 64;
    }
    return size;
  };
  for (int begin = next(0, true); begin < size;) {
    const int end = next(begin, false);
    use(begin, end);
    begin = next(end, true);
  }
}

/// Divides the squares of a slice into rectangles, each a run of bits over all consecutive rows with the same
/// run.
class Cutter {
 public:
  explicit Cutter(const Side& side) : side_(side), squares_(side.grid->row_words()) {}

  void cut(int slice, Array<Rectangle>& out) {
    open_.clear();
    for (int r = 0; r < side_.rows(); ++r) {
      side_.exposed(slice, r, squares_.data());
      still_open_.clear();
      std::size_t above = 0;
      each_run(squares_.data(), side_.grid->size().x, [&](int begin, int end) {
        while (above < open_.size() && open_[above].bit < begin) close(open_[above++], r, out);
        if (above < open_.size() && open_[above].bit == begin && open_[above].bit_end == end) {
          still_open_.push_back(open_[above++]);
        } else {
          still_open_.push_back({begin, end, r, r});
        }
      });
      while (above < open_.size()) close(open_[above++], r, out);
      std::swap(open_, still_open_);
    }
    for (const Rectangle& rectangle : open_) close(rectangle, side_.rows(), out);
  }

 private:
  static void close(Rectangle rectangle, int row_end, Array<Rectangle>& out) {
    rectangle.row_end = row_end;
    out.push_back(rectangle);
  }

  const Side& side_;
  std::vector<std::uint64_t> squares_;
  std::vector<Rectangle> open_, still_open_;  ///< in the order of their first bit
};

/// The rectangles of a chunk of slices of one side.
struct Cuts {
  explicit Cuts(const Job& job) : rectangles(job) {}
  Array<Rectangle> rectangles;
  std::vector<std::size_t> ends;  ///< for each slice, an index into `rectangles`
};

/// A bit for each point of the lattice: is it a corner of a rectangle?
class Corners {
 public:
  Corners(const Job& job, glm::ivec3 cells) {
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      step_[axis] = count;
      count *= static_cast<std::size_t>(cells[static_cast<int>(axis)]) + 1;
    }
    bits_ = Array<std::uint64_t>(job, count / 64 + 1, std::uint64_t{0});
  }

  std::size_t step(int axis) const { return step_[static_cast<std::size_t>(axis)]; }
  void mark(std::size_t point) { bits_[point / 64] |= std::uint64_t{1} << point % 64; }
  bool has(std::size_t point) const { return (bits_[point / 64] >> point % 64 & 1U) != 0; }

 private:
  std::array<std::size_t, 3> step_{};
  Array<std::uint64_t> bits_;
};

/// Indices of points by bit and row of one slice of a side.
struct Plane {
  Plane(const Side& side, const Corners& corners, int slice)
      : bit_step(corners.step(side.world_bits())),
        row_step(corners.step(side.world_rows())),
        first(corners.step(side.world_normal()) * static_cast<std::size_t>(slice + (side.step > 0 ? 1 : 0))) {
  }
  std::size_t at(int bit, int row) const {
    return first + bit_step * static_cast<std::size_t>(bit) + row_step * static_cast<std::size_t>(row);
  }
  std::size_t bit_step, row_step, first;
};

void mark_corners(const Side& side, int first_slice, const Cuts& cuts, Corners& corners) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < cuts.ends.size(); ++i) {
    const Plane plane(side, corners, first_slice + static_cast<int>(i));
    for (; at < cuts.ends[i]; ++at) {
      const Rectangle& r = cuts.rectangles[at];
      corners.mark(plane.at(r.bit, r.row));
      corners.mark(plane.at(r.bit, r.row_end));
      corners.mark(plane.at(r.bit_end, r.row));
      corners.mark(plane.at(r.bit_end, r.row_end));
    }
  }
}

/// The corners on the boundary of a rectangle: bits along its two rows, and rows along its two other sides.
/// The corners of the rectangle itself are in two lists each.
struct Rim {
  std::vector<int> low, high, left, right;

  void find(const Rectangle& r, const Plane& plane, const Corners& corners) {
    low.clear(), high.clear(), left.clear(), right.clear();
    for (int bit = r.bit; bit <= r.bit_end; ++bit) {
      if (corners.has(plane.at(bit, r.row))) low.push_back(bit);
      if (corners.has(plane.at(bit, r.row_end))) high.push_back(bit);
    }
    for (int row = r.row; row <= r.row_end; ++row) {
      if (corners.has(plane.at(r.bit, row))) left.push_back(row);
      if (corners.has(plane.at(r.bit_end, row))) right.push_back(row);
    }
  }
  std::size_t triangles() const { return low.size() + high.size() + left.size() + right.size() - 4 - 2; }
};

/// The first vertex and triangle of a slice in the mesh.
struct Start {
  std::size_t vertex = 0, triangle = 0;
};

/// Counts or writes one slice.
class SliceMaker {
 public:
  SliceMaker(const Side& side, const Corners& corners) : side_(side), corners_(corners), vertices_(side) {}

  Start count(int slice, std::span<const Rectangle> rectangles) {
    mark(slice, rectangles);
    return {vertices_.count(), triangles_};
  }

  void write(int slice, std::span<const Rectangle> rectangles, const Start& start, const Solid& solid,
             const SideColors* colors, Mesh& mesh) {
    if (rectangles.empty()) return;
    mark(slice, rectangles);
    vertices_.write(solid, slice, colors, mesh, start.vertex);
    out_ = mesh.index.wide.data() + 3 * start.triangle;
    const Plane plane(side_, corners_, slice);
    for (const Rectangle& rectangle : rectangles) {
      rim_.find(rectangle, plane, corners_);
      fill(rectangle);
    }
  }

 private:
  void mark(int slice, std::span<const Rectangle> rectangles) {
    vertices_.clear();
    triangles_ = 0;
    const Plane plane(side_, corners_, slice);
    for (const Rectangle& r : rectangles) {
      rim_.find(r, plane, corners_);
      triangles_ += rim_.triangles();
      for (const int bit : rim_.low) set(r.row, bit);
      for (const int bit : rim_.high) set(r.row_end, bit);
      for (const int row : rim_.left) set(row, r.bit);
      for (const int row : rim_.right) set(row, r.bit_end);
    }
  }
  void set(int row, int bit) { vertices_.row(row)[bit / 64] |= std::uint64_t{1} << bit % 64; }
  std::uint32_t vertex(int row, int bit) const {
    return vertices_.number(row, static_cast<std::size_t>(bit) / 64, static_cast<std::size_t>(bit) % 64);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const bool right = side_.turns_right();
    *out_++ = a;
    *out_++ = right ? b : c;
    *out_++ = right ? c : b;
  }

  /// Writes triangles between the two rows, from left to right. The first has the left side as an edge and
  /// the last the right side. If there are corners on such a side, that triangle becomes a fan.
  void fill(const Rectangle& r) {
    std::size_t i = 0, j = 0;
    const std::size_t low_end = rim_.low.size() - 1, high_end = rim_.high.size() - 1;
    while (i < low_end || j < high_end) {
      const bool first = i + j == 0, last = i + j + 1 == low_end + high_end;
      const bool along_low = j == high_end || (i < low_end && rim_.low[i + 1] <= rim_.high[j + 1]);
      const std::uint32_t low = vertex(r.row, rim_.low[i]), high = vertex(r.row_end, rim_.high[j]);
      const std::uint32_t next = along_low ? vertex(r.row, rim_.low[++i]) : vertex(r.row_end, rim_.high[++j]);
      if (first) {
        for (std::size_t k = rim_.left.size() - 1; k > 0; --k)
          triangle(vertex(rim_.left[k], r.bit), vertex(rim_.left[k - 1], r.bit), next);
      } else if (last) {
        const std::uint32_t apex = along_low ? low : high;
        for (std::size_t k = 0; k + 1 < rim_.right.size(); ++k)
          triangle(vertex(rim_.right[k], r.bit_end), vertex(rim_.right[k + 1], r.bit_end), apex);
      } else {
        triangle(low, next, high);
      }
    }
  }

  const Side& side_;
  const Corners& corners_;
  CornerRows vertices_;
  Rim rim_;
  std::size_t triangles_ = 0;
  std::uint32_t* out_ = nullptr;
};

/// All rectangles of a side, by chunks of slices.
std::vector<Cuts> cut_side(const Side& side, Job& job) {
  const auto slices = static_cast<std::size_t>(side.slices());
  std::vector<Cuts> cuts;
  for (std::size_t i = 0; i < chunk_count(slices, slices_a_chunk); ++i) cuts.emplace_back(job);
  parallel_for(job, slices, slices_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
    Cutter cutter(side);
    for (std::size_t slice = begin; slice < end; ++slice) {
      job.check();
      const std::size_t before = cuts[chunk].rectangles.size();
      cutter.cut(static_cast<int>(slice), cuts[chunk].rectangles);
      cuts[chunk].ends.push_back(cuts[chunk].rectangles.size());
      job.spend(Resource::triangles, 2 * (cuts[chunk].rectangles.size() - before));
    }
  });
  return cuts;
}

/// Calls make(maker, slice, its rectangles) for every slice of a side, in parallel.
template <class Make>
void each_slice(const Side& side, const std::vector<Cuts>& cuts, const Corners& corners, const Job& job,
                Make make) {
  parallel_for(job, static_cast<std::size_t>(side.slices()), slices_a_chunk,
               [&](std::size_t begin, std::size_t end, std::size_t chunk) {
                 SliceMaker maker(side, corners);
                 std::size_t from = 0;
                 for (std::size_t slice = begin; slice < end; ++slice) {
                   job.check();
                   const std::size_t to = cuts[chunk].ends[slice - begin];
                   make(maker, slice, cuts[chunk].rectangles.span().subspan(from, to - from));
                   from = to;
                 }
               });
}

}  // namespace

Mesh merged_faces(const Solid& solid, const SideColors* colors, Job& job) {
  const std::array<Side, 6> sides = sides_of(solid);
  std::array<std::vector<Cuts>, 6> cuts;
  Corners corners(job, solid.by_x.size());
  std::size_t rectangles = 0;
  for (std::size_t s = 0; s < 6; ++s) {
    cuts[s] = cut_side(sides[s], job);
    for (std::size_t i = 0; i < cuts[s].size(); ++i) {
      rectangles += cuts[s][i].rectangles.size();
      mark_corners(sides[s], static_cast<int>(i * slices_a_chunk), cuts[s][i], corners);
    }
  }

  std::array<std::vector<Start>, 6> starts;
  Start end;
  for (std::size_t s = 0; s < 6; ++s) {
    starts[s].resize(static_cast<std::size_t>(sides[s].slices()));
    each_slice(sides[s], cuts[s], corners, job, [&](SliceMaker& maker, std::size_t slice, auto list) {
      starts[s][slice] = maker.count(static_cast<int>(slice), list);
    });
    for (Start& start : starts[s]) {
      const Start size = start;
      start = end;
      end.vertex += size.vertex;
      end.triangle += size.triangle;
    }
  }
  job.spend(Resource::triangles, end.triangle - 2 * rectangles);

  Mesh mesh;
  mesh.position = Array<glm::vec3>(job, end.vertex);
  mesh.normal = Array<glm::vec3>(job, end.vertex);
  if (colors) mesh.color = Array<glm::u8vec4>(job, end.vertex);
  mesh.index.wide = Array<std::uint32_t>(job, 3 * end.triangle);
  for (std::size_t s = 0; s < 6; ++s) {
    each_slice(sides[s], cuts[s], corners, job, [&](SliceMaker& maker, std::size_t slice, auto list) {
      maker.write(static_cast<int>(slice), list, starts[s][slice], solid, colors, mesh);
    });
  }
  return mesh;
}

}  // namespace seedmesh::fractal
