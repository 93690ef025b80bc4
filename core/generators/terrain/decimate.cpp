#include "core/generators/terrain/decimate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/square.h"

namespace seedmesh::terrain {
namespace {

constexpr std::uint32_t unnamed = 0xFFFFFFFFU;
constexpr std::size_t band = 6;  // squares; two rows of their samples fit into a cache of 16 vertices
using Lines = std::vector<std::int32_t>;

/// Returns the samples that are kept of a line of `squares` + 1, including its ends.
Lines lines_of(std::int32_t squares, std::int32_t step) {
  const std::int32_t count = std::max(1, (squares + step / 2) / step);
  Lines lines;
  for (std::int32_t i = 0; i <= count; ++i)
    lines.push_back(static_cast<std::int32_t>(std::int64_t{i} * squares / count));
  return lines;
}

/// Returns the same without the ends, but at least one. There are at least two squares.
Lines inner_lines_of(std::int32_t squares, std::int32_t step) {
  const Lines lines = lines_of(squares, step);
  if (lines.size() < 3) return {squares / 2};
  return {lines.begin() + 1, lines.end() - 1};
}

std::vector<GridPoint> along_x(const Lines& columns, std::int32_t z) {
  std::vector<GridPoint> line;
  for (const std::int32_t x : columns) line.push_back({x, z});
  return line;
}
std::vector<GridPoint> along_z(std::int32_t x, const Lines& rows) {
  std::vector<GridPoint> line;
  for (const std::int32_t z : rows) line.push_back({x, z});
  return line;
}

/// Collects triangles of a part and numbers its samples by their first use.
class Weave {
 public:
  Weave(const Field& field, const Window& part, Job& job)
      : field_(field),
        part_(part),
        job_(job),
        names_(job, static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.depth), unnamed),
        mesh_{Array<std::uint32_t>(job), Array<std::uint32_t>(job)} {}

  void reserve(std::size_t triangles) {
    job_.spend(Resource::triangles, triangles);
    mesh_.index.reserve(3 * triangles);
  }

  /// Adds two triangles for each square between these columns and rows, in bands that fit the vertex cache.
  void squares(const Lines& columns, const Lines& rows) {
    for (std::size_t first = 0; first + 1 < columns.size(); first += band) {
      const std::size_t last = std::min(first + band, columns.size() - 1);
      job_.check();
      for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
        for (std::size_t i = first; i < last; ++i)
          square({columns[i], rows[j]}, {columns[i + 1], rows[j + 1]});
      }
    }
  }

  /// Adds the strip between all samples of the border and the outermost of these columns and rows.
  void rim(const Lines& columns, const Lines& rows) {
    const std::int32_t east = part_.width - 1, south = part_.depth - 1;
    const Lines all_columns = lines_of(east, 1), all_rows = lines_of(south, 1);
    stitch(along_x(all_columns, 0), along_x(columns, rows.front()), &GridPoint::x);
    stitch(along_x(all_columns, south), along_x(columns, rows.back()), &GridPoint::x);
    stitch(along_z(0, all_rows), along_z(columns.front(), rows), &GridPoint::z);
    stitch(along_z(east, all_rows), along_z(columns.back(), rows), &GridPoint::z);
  }

  Triangulation take() { return std::move(mesh_); }

 private:
  float height(GridPoint at) const { return field_.at(left() + at.x, top() + at.z); }
  std::int32_t left() const { return static_cast<std::int32_t>(part_.x); }
  std::int32_t top() const { return static_cast<std::int32_t>(part_.z); }

  std::uint32_t name(GridPoint at) {
    std::uint32_t& name = names_[static_cast<std::size_t>(at.z) * static_cast<std::size_t>(part_.width) +
                                 static_cast<std::size_t>(at.x)];
    if (name == unnamed) {
      name = static_cast<std::uint32_t>(mesh_.samples.size());
      mesh_.samples.push_back(static_cast<std::uint32_t>((top() + at.z) * field_.width + left() + at.x));
    }
    return name;
  }

  void square(GridPoint nw, GridPoint se) {
    const GridPoint ne{se.x, nw.z}, sw{nw.x, se.z};
    const bool falls = falls_to_south_east(height(nw), height(ne), height(sw), height(se));
    for (const auto& [a, b, c] : divided_square(falls, nw, ne, sw, se)) triangle(a, b, c);
  }

  void triangle(GridPoint a, GridPoint b, GridPoint c) {
    if (doubled_area(a, b, c) < 0) std::swap(b, c);
    for (const GridPoint at : {a, b, c}) mesh_.index.push_back(name(at));
  }

  /// Joins two lines with the same direction along `axis`: each outer sample is joined to the nearest inner
  /// sample along the line.
  void stitch(const std::vector<GridPoint>& outer, const std::vector<GridPoint>& inner,
              std::int32_t GridPoint::*axis) {
    std::size_t i = 0, j = 0;
    while (i + 1 < outer.size() || j + 1 < inner.size()) {
      const bool inner_next =
          i + 1 == outer.size() ||
          (j + 1 < inner.size() && 2 * (outer[i].*axis) >= inner[j].*axis + inner[j + 1].*axis);
      if (inner_next) {
        triangle(outer[i], inner[j], inner[j + 1]);
        ++j;
      } else {
        triangle(outer[i], outer[i + 1], inner[j]);
        ++i;
      }
    }
  }

  const Field& field_;
  Window part_;
  Job& job_;
  Array<std::uint32_t> names_;
  Triangulation mesh_;
};

std::size_t squares_between(const Lines& columns, const Lines& rows) {
  return (columns.size() - 1) * (rows.size() - 1);
}

}  // namespace

Triangulation decimated(const Field& field, const Window& part, std::int32_t step, Border border, Job& job) {
  const std::int32_t east = part.width - 1, south = part.depth - 1;
  Weave weave(field, part, job);
  if (border == Border::by_error || east < 2 || south < 2) {
    // A part that is one square wide consists of its border.
    const std::int32_t kept = border == Border::by_error ? step : 1;
    const Lines columns = lines_of(east, kept), rows = lines_of(south, kept);
    weave.reserve(2 * squares_between(columns, rows));
    weave.squares(columns, rows);
    return weave.take();
  }
  const Lines columns = inner_lines_of(east, step), rows = inner_lines_of(south, step);
  weave.reserve(2 * squares_between(columns, rows) +
                2 * (static_cast<std::size_t>(east + south) + columns.size() + rows.size() - 2));
  weave.squares(columns, rows);
  weave.rim(columns, rows);
  return weave.take();
}

}  // namespace seedmesh::terrain
