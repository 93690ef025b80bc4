#pragma once
/// The samples that a triangle covers, eight at a time. Corners are fixed-point numbers, and each edge
/// belongs to one of its two triangles. The same triangles therefore give the same samples on every machine,
/// without gaps or overlaps.
///
/// Edge functions after Pineda, "A parallel algorithm for polygon rasterization", 1988.
#include <array>
#include <cstdint>
#include <cstring>

#include "core/render/eye.h"

namespace seedmesh::render {

/// Rows [begin, end) of an image.
struct Rows {
  std::int32_t begin = 0, end = 0;
};

/// Samples side by side, for the vector extensions of GCC and Clang.
constexpr std::int32_t lanes = 8;
using Floats = float __attribute__((vector_size(32)));
using Flags = std::int32_t __attribute__((vector_size(32)));  ///< -1 where true

constexpr Floats lane_numbers{0, 1, 2, 3, 4, 5, 6, 7};

/// Whether the flag of any lane is set.
inline bool any_of(Flags flags) {
  std::uint64_t parts[4];
  std::memcpy(parts, &flags, sizeof(flags));
  return ((parts[0] | parts[1]) | (parts[2] | parts[3])) != 0;
}
inline Floats all_lanes(float value) { return value - Floats{}; }
inline Flags all_lanes(std::int32_t value) { return value - Flags{}; }
/// Returns `yes` in lanes whose flag is set, and `no` in the others.
inline Flags chosen(Flags flags, Flags yes, Flags no) { return (yes & flags) | (no & ~flags); }
inline Floats chosen(Flags flags, Floats yes, Floats no) {
  return reinterpret_cast<Floats>(chosen(flags, reinterpret_cast<Flags>(yes), reinterpret_cast<Flags>(no)));
}

/// A quantity that is linear in the image.
struct Plane {
  float at = 0;  ///< at the first sample of the box
  float across = 0, down = 0;

  Floats of(Floats x, float y) const { return all_lanes(at + down * y) + all_lanes(across) * x; }
};

/// A triangle whose corners run clockwise with y down, and the box of samples that it may cover.
struct Cover {
  std::array<std::int32_t, 3> x, y;
  std::int64_t area = 0;  ///< doubled, in fixed-point units
  std::int32_t left, right, top,
      bottom;  ///< of the box, in samples; inclusive; `left` is a multiple of `lanes`
  /// Edge function of the edge opposite of each corner: its value at the first sample of the box, and its increments
  /// from sample to sample to the right and downwards.
  std::array<std::int64_t, 3> row, across, down;

  bool is_small() const {
    constexpr std::int32_t most = 512;  // samples, so that edge functions fit 32 bits
    return right - left < most && bottom - top < most;
  }
  /// The same, divided by `area`: barycentric coordinates, for plane().
  std::array<double, 3> row_share, across_share, down_share;
  Plane plane(double a, double b, double c) const {
    const auto mixed = [&](const std::array<double, 3>& e) {
      return static_cast<float>((e[0] * a + e[1] * b) + e[2] * c);
    };
    return {mixed(row_share), mixed(across_share), mixed(down_share)};
  }
};

/// Sets the box. Returns false if no centre of a sample is inside the box, or the box is outside of the image.
inline bool set_box(Cover& c, std::int32_t size, const Rows& rows) {
  constexpr std::int32_t half = fixed_one / 2;
  const auto [low_x, high_x] = std::minmax({c.x[0], c.x[1], c.x[2]});
  const auto [low_y, high_y] = std::minmax({c.y[0], c.y[1], c.y[2]});
  c.left = (low_x - half + fixed_one - 1) >> fixed_bits;
  c.right = (high_x - half) >> fixed_bits;
  c.top = (low_y - half + fixed_one - 1) >> fixed_bits;
  c.bottom = (high_y - half) >> fixed_bits;
  return c.left <= c.right && c.top <= c.bottom && c.right >= 0 && c.left < size && c.bottom >= rows.begin &&
         c.top < rows.end;
}

inline void set_edges(Cover& c) {
  c.left &= -lanes;
  const std::int64_t px = std::int64_t{c.left} * fixed_one + fixed_one / 2;
  const std::int64_t py = std::int64_t{c.top} * fixed_one + fixed_one / 2;
  const double whole = 1 / static_cast<double>(c.area);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    const std::int64_t dx = std::int64_t{c.x[b]} - c.x[a], dy = std::int64_t{c.y[b]} - c.y[a];
    c.row[i] = dx * (py - c.y[a]) - dy * (px - c.x[a]);
    c.across[i] = -dy * fixed_one;
    c.down[i] = dx * fixed_one;
    c.row_share[i] = static_cast<double>(c.row[i]) * whole;
    c.across_share[i] = static_cast<double>(c.across[i]) * whole;
    c.down_share[i] = static_cast<double>(c.down[i]) * whole;
  }
}

/// Whether a sample on edge i belongs to the triangle: on edges at the top and on the left.
inline bool owns_edge(const Cover& c, std::size_t i) {
  return c.across[i] > 0 || (c.across[i] == 0 && c.down[i] > 0);
}

/// The part of a row that may be covered, as [begin, end) in samples from the left of the box; `begin` is a multiple
/// of `lanes`.
struct Span {
  std::int32_t begin, end;
};
inline Span span_of(const std::array<double, 3>& per_across, const std::array<std::int64_t, 3>& row,
                    Span all) {
  double low = all.begin, high = all.end;
  for (std::size_t i = 0; i < 3; ++i) {
    const double crossing = -static_cast<double>(row[i]) * per_across[i];
    if (per_across[i] > 0) low = std::max(low, crossing - 1);
    if (per_across[i] < 0) high = std::min(high, crossing + 2);
  }
  if (!(low < high)) return {all.begin, all.begin};
  return {static_cast<std::int32_t>(low) & -lanes, static_cast<std::int32_t>(high)};
}

/// The rows and columns of a triangle's box that are in the image.
struct Part {
  std::int32_t top, bottom;  ///< inclusive
  Span columns;
};
inline Part part_of(const Cover& c, std::int32_t size, const Rows& rows) {
  return {std::max(c.top, rows.begin),
          std::min(c.bottom, rows.end - 1),
          {std::max(c.left, 0) - c.left, std::min(c.right + 1, size) - c.left}};
}

/// Returns the edge functions of a row, less 1 where samples on the edge belong to the neighbour: none is below 0
/// inside.
inline std::array<std::int64_t, 3> row_at(const Cover& c, std::int32_t y) {
  std::array<std::int64_t, 3> row;
  for (std::size_t i = 0; i < 3; ++i) row[i] = c.row[i] - (owns_edge(c, i) ? 0 : 1) + c.down[i] * (y - c.top);
  return row;
}

/// Returns numbers that begin at `first` and rise by `step`.
inline Flags steps(std::int64_t first, std::int64_t step) {
  constexpr Flags numbers{0, 1, 2, 3, 4, 5, 6, 7};
  return static_cast<std::int32_t>(first) + static_cast<std::int32_t>(step) * numbers;
}

/// Like each_eight(), for triangles with edge functions of 32 bits.
template <class Visit>
void each_eight_of_small(const Cover& c, const Part& part, const Visit& visit) {
  constexpr std::int32_t worth_spans = 32;
  const Span all = part.columns;
  const bool has_spans = all.end - all.begin > worth_spans;
  std::array<std::int64_t, 3> row = row_at(c, part.top);
  std::array<double, 3> per_across{};
  std::array<Flags, 3> begin, across, down;
  for (std::size_t i = 0; i < 3; ++i) {
    begin[i] = steps(row[i] + c.across[i] * all.begin, c.across[i]);
    across[i] = all_lanes(static_cast<std::int32_t>(lanes * c.across[i]));
    down[i] = all_lanes(static_cast<std::int32_t>(c.down[i]));
    if (has_spans && c.across[i] != 0) per_across[i] = 1 / static_cast<double>(c.across[i]);
  }
  for (std::int32_t y = part.top; y <= part.bottom; ++y) {
    Span span = all;
    Flags a = begin[0], b = begin[1], d = begin[2];
    if (has_spans) {
      span = span_of(per_across, row, all);
      const std::int32_t skipped = (span.begin - all.begin) / lanes;
      a += across[0] * skipped;
      b += across[1] * skipped;
      d += across[2] * skipped;
      for (std::size_t i = 0; i < 3; ++i) row[i] += c.down[i];
    }
    Floats x = all_lanes(static_cast<float>(span.begin)) + lane_numbers;
    const auto from_top = static_cast<float>(y - c.top);
    for (std::int32_t column = span.begin; column < span.end; column += lanes) {
      visit(c.left + column, y, (a | b | d) >= all_lanes(0), x, from_top);
      a += across[0];
      b += across[1];
      d += across[2];
      x += static_cast<float>(lanes);
    }
    for (std::size_t i = 0; i < 3; ++i) begin[i] += down[i];
  }
}

/// Calls visit(x, y, inside, across, down) for each group of eight samples of a row of which at least one is
/// covered. The arguments are the image position of the first sample, flags, and the positions of all eight in
/// the box. `size` is the width of the image; the last group may end beyond it.
template <class Visit>
void each_eight(const Cover& c, std::int32_t size, const Rows& rows, const Visit& visit) {
  const Part part = part_of(c, size, rows);
  if (c.is_small()) return each_eight_of_small(c, part, visit);
  std::array<double, 3> per_across{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (c.across[i] != 0) per_across[i] = 1 / static_cast<double>(c.across[i]);
  }
  for (std::int32_t y = part.top; y <= part.bottom; ++y) {
    const std::array<std::int64_t, 3> row = row_at(c, y);
    const Span span = span_of(per_across, row, part.columns);
    for (std::int32_t x = span.begin; x < span.end; x += lanes) {
      Flags inside{};
      for (int lane = 0; lane < lanes; ++lane) {
        const std::int64_t e = (row[0] + c.across[0] * (x + lane)) | (row[1] + c.across[1] * (x + lane)) |
                               (row[2] + c.across[2] * (x + lane));
        inside[lane] = e >= 0 ? -1 : 0;
      }
      if (any_of(inside)) {
        visit(c.left + x, y, inside, all_lanes(static_cast<float>(x)) + lane_numbers,
              static_cast<float>(y - c.top));
      }
    }
  }
}

}  // namespace seedmesh::render
