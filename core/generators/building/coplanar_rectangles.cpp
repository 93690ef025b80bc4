#include "core/generators/building/coplanar_rectangles.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/geom/polygon/orientation.h"

namespace seedmesh::building {
namespace {

constexpr double same_direction = 1e-9;
// Shares of the diagonal.
constexpr double same_place = 1e-6, strip_width = 1e-4;
constexpr double strip_depths[4] = {3e-5, 6e-5, 6e-5, 3e-5};  // of neighbours different ones
constexpr std::size_t most_on_side = 8;                       ///< corners of others

/// Sorts values, and keeps one of those that are nearer to each other than the tolerance.
void sort_and_join(std::vector<double>& values, double tolerance) {
  std::ranges::sort(values);
  std::size_t kept = 0;
  double last = 0;
  for (const double value : values) {
    if (kept == 0 || value - last > tolerance) values[kept++] = value;
    last = value;
  }
  values.resize(kept);
}

/// The position of the last of rising values that is not above a value.
std::uint32_t place_in(const std::vector<double>& values, double value) {
  const auto found = std::ranges::upper_bound(values, value);
  return static_cast<std::uint32_t>(found - values.begin()) - (found == values.begin() ? 0U : 1U);
}

/// A corner as one number that sorts by its line first, which is its position in u or in v.
std::uint64_t corner_key(std::uint32_t line, std::uint32_t at) { return std::uint64_t{line} << 32U | at; }

double stretch(const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(b - a, b - a); }

/// Triangles of a convex ring with corners on straight edges. The ear nearest to an equilateral triangle is
/// cut first; no ear may leave a rest without an area.
void cut_ears(std::span<const glm::dvec2> points, std::vector<std::uint32_t>& index) {
  std::vector<std::uint32_t> ring(points.size());
  for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  double left = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    left += doubled_area(points[0], points[i], points[i + 1]);
  const double least = 1e-9 * left;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    std::size_t best = 0;
    double most = 0, cut = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const glm::dvec2 &a = points[ring[(i + n - 1) % n]], &b = points[ring[i]],
                       &c = points[ring[(i + 1) % n]];
      const double own = doubled_area(a, b, c);
      if (own <= least || left - own <= least) continue;
      const double fatness = own / std::max({stretch(a, b), stretch(b, c), stretch(c, a)});
      if (fatness > most) std::tie(most, best, cut) = std::tuple(fatness, i, own);
    }
    if (most == 0) return;
    for (const std::size_t k : {best + n - 1, best, best + 1}) index.push_back(ring[k % n]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
    left -= cut;
  }
  for (const std::uint32_t k : ring) index.push_back(k);
}

}  // namespace

CoplanarRectangles::CoplanarRectangles(const Shapes& shapes, std::span<const std::uint32_t> drawn,
                                       double diagonal, Job& job)
    : diagonal_(diagonal), places_(drawn.size(), none) {
  std::vector<std::uint32_t> frames(shapes.axes.size(), none);
  std::vector<Rect> found;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const Shape& shape = shapes.shapes[drawn[i]];
    if (shape.geometry != box_geometry || dimension(shape.size) != 2) continue;
    std::uint32_t& frame = frames[shape.axes];
    if (frame == none) frame = frame_of(shapes.axes[shape.axes]);
    Rect rect;
    rect.drawn = static_cast<std::uint32_t>(i);
    rect.frame = frame;
    rect.axis = flat_axis(shape.size);
    const int u = (rect.axis + 1) % 3, v = (rect.axis + 2) % 3;
    const glm::dvec3 origin = glm::transpose(frames_[frame]) * shape.origin;
    rect.at = origin[rect.axis];
    rect.low = {origin[u], origin[v]};
    rect.high = rect.low + glm::dvec2(shape.size[u], shape.size[v]);
    found.push_back(rect);
    if ((i & 4095U) == 4095) job.check();
  }
  std::vector<std::uint32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, {}, [&found](std::uint32_t k) {
    const Rect& r = found[k];
    return std::tuple(r.frame, r.axis, r.at, r.drawn);
  });
  rects_.reserve(found.size());
  for (const std::uint32_t k : order) rects_.push_back(found[k]);
  const double tolerance = same_place * diagonal;
  for (std::size_t begin = 0, end = 0; begin < rects_.size(); begin = end) {
    const Rect& first = rects_[begin];
    while (end < rects_.size() && rects_[end].frame == first.frame && rects_[end].axis == first.axis &&
           (end == begin || rects_[end].at - rects_[end - 1].at <= tolerance))
      ++end;
    job.check();
    add_plane(std::span(rects_).subspan(begin, end - begin), tolerance);
  }
  for (std::uint32_t k = 0; k < rects_.size(); ++k) {
    const Rect& rect = rects_[k];
    if (rect.first.first < rect.last.first && rect.first.second < rect.last.second) places_[rect.drawn] = k;
  }
}

/// The number of a frame. Axes with equal directions have the same frame.
std::uint32_t CoplanarRectangles::frame_of(const glm::dmat3& axes) {
  const auto is_same = [&](const glm::dmat3& other) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(axes[c][r] - other[c][r]));
    }
    return most < same_direction;
  };
  // Further axes are not compared and have frames of their own.
  constexpr std::size_t most_compared = 64;
  const std::size_t compared = std::min(frames_.size(), most_compared);
  for (std::uint32_t i = 0; i < compared; ++i) {
    if (is_same(frames_[i])) return i;
  }
  frames_.push_back(axes);
  return static_cast<std::uint32_t>(frames_.size()) - 1;
}

/// Sorts corners into lines; equal ones are kept once.
CoplanarRectangles::Lines CoplanarRectangles::lines_of(std::vector<std::uint64_t>& corners,
                                                       std::size_t count) {
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  Lines lines;
  lines.begins.reserve(count + 1);
  lines.at.reserve(corners.size());
  for (const std::uint64_t corner : corners) {
    while (lines.begins.size() <= corner >> 32U)
      lines.begins.push_back(static_cast<std::uint32_t>(lines.at.size()));
    lines.at.push_back(static_cast<std::uint32_t>(corner));
  }
  lines.begins.resize(count + 1, static_cast<std::uint32_t>(lines.at.size()));
  return lines;
}

CoplanarRectangles::Range CoplanarRectangles::Lines::between(std::uint32_t line, std::uint32_t from,
                                                             std::uint32_t to) const {
  const auto begin = at.begin() + begins[line], end = at.begin() + begins[line + 1];
  const auto first = std::upper_bound(begin, end, from), last = std::lower_bound(first, end, to);
  return {static_cast<std::uint32_t>(first - at.begin()), static_cast<std::uint32_t>(last - first)};
}

void CoplanarRectangles::add_plane(std::span<Rect> rects, double tolerance) {
  Plane plane;
  plane.at = rects.front().at;
  plane.u.reserve(2 * rects.size());
  plane.v.reserve(2 * rects.size());
  for (const Rect& rect : rects) {
    plane.u.insert(plane.u.end(), {rect.low.x, rect.high.x});
    plane.v.insert(plane.v.end(), {rect.low.y, rect.high.y});
  }
  sort_and_join(plane.u, tolerance);
  sort_and_join(plane.v, tolerance);
  for (Rect& rect : rects) {
    rect.plane = static_cast<std::uint32_t>(planes_.size());
    rect.first = {place_in(plane.u, rect.low.x), place_in(plane.v, rect.low.y)};
    rect.last = {place_in(plane.u, rect.high.x), place_in(plane.v, rect.high.y)};
  }
  if (rects.size() > 1) {  // else no other has corners here
    add_lines(rects, plane);
    for (Rect& rect : rects) find_sides(rect, plane);
  }
  planes_.push_back(std::move(plane));
}

void CoplanarRectangles::add_lines(std::span<const Rect> rects, Plane& plane) {
  std::vector<std::uint64_t> by_u, by_v;
  by_u.reserve(4 * rects.size());
  by_v.reserve(4 * rects.size());
  for (const Rect& rect : rects) {
    for (const std::uint32_t u : {rect.first.first, rect.last.first}) {
      for (const std::uint32_t v : {rect.first.second, rect.last.second}) {
        by_u.push_back(corner_key(u, v));
        by_v.push_back(corner_key(v, u));
      }
    }
  }
  plane.by_u = lines_of(by_u, plane.u.size());
  plane.by_v = lines_of(by_v, plane.v.size());
}

/// Finds the corners of others on each side of a rectangle, and counts its triangles.
void CoplanarRectangles::find_sides(Rect& rect, const Plane& plane) const {
  const auto [u0, v0] = rect.first;
  const auto [u1, v1] = rect.last;
  rect.sides = {plane.by_v.between(v0, u0, u1), plane.by_u.between(u1, v0, v1),
                plane.by_v.between(v1, u0, u1), plane.by_u.between(u0, v0, v1)};
  for (std::size_t side = 0; side < 4; ++side) {
    const std::uint32_t count = rect.sides[side].count;
    rect.is_backed[side] = count > most_on_side;
    rect.more += rect.is_backed[side] ? 2U : count;
  }
}

void CoplanarRectangles::ring(const Rect& rect, std::vector<Corner>& corners) const {
  const Plane& plane = planes_[rect.plane];
  const auto [u0, v0] = rect.first;
  const auto [u1, v1] = rect.last;
  const Corner begins[4] = {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
  corners.clear();
  for (std::size_t side = 0; side < 4; ++side) {
    corners.push_back(begins[side]);
    if (rect.is_backed[side]) continue;
    const auto [first, count] = rect.sides[side];
    const std::vector<std::uint32_t>& at = side % 2 == 0 ? plane.by_v.at : plane.by_u.at;
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t other = at[first + (side < 2 ? k : count - 1 - k)];
      Corner corner = begins[side];
      (side % 2 == 0 ? corner.first : corner.second) = other;
      corners.push_back(corner);
    }
  }
}

glm::dvec3 CoplanarRectangles::place(const Rect& rect, const Corner& corner) const {
  const Plane& plane = planes_[rect.plane];
  glm::dvec3 local(0);
  local[rect.axis] = plane.at;
  local[(rect.axis + 1) % 3] = plane.u[corner.first];
  local[(rect.axis + 2) % 3] = plane.v[corner.second];
  return local;
}

void CoplanarRectangles::outline(std::size_t i, std::vector<glm::dvec3>& points) const {
  points.clear();
  if (places_[i] == none) return;
  const Rect& rect = rects_[places_[i]];
  std::vector<Corner> corners;
  ring(rect, corners);
  for (const Corner& corner : corners) points.push_back(frames_[rect.frame] * place(rect, corner));
}

/// Adds a strip along a side, half of it behind each neighbour.
void CoplanarRectangles::add_strip(const Rect& rect, int side, BodySurface& surface) const {
  const int u = (rect.axis + 1) % 3, v = (rect.axis + 2) % 3, across = side % 2 == 0 ? v : u;
  glm::dvec3 low = place(rect, rect.first), high = place(rect, rect.last);
  (side == 0 || side == 3 ? high : low)[across] = (side == 0 || side == 3 ? low : high)[across];
  low[across] -= strip_width * diagonal_;
  high[across] += strip_width * diagonal_;
  low[rect.axis] -= strip_depths[side] * diagonal_;
  glm::dvec3 normal(0);
  normal[rect.axis] = 1;
  const auto base = static_cast<std::uint32_t>(surface.position.size());
  for (const auto& [is_right, is_upper] :
       {std::pair(false, false), {true, false}, {true, true}, {false, true}}) {
    glm::dvec3 at = low;
    if (is_right) at[u] = high[u];
    if (is_upper) at[v] = high[v];
    surface.position.push_back(at);
    surface.normal.push_back(normal);
  }
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) surface.index.push_back(base + k);
}

bool CoplanarRectangles::fill(std::size_t i, BodySurface& surface) const {
  if (places_[i] == none) return false;
  const Rect& rect = rects_[places_[i]];
  surface.clear();
  std::vector<Corner> corners;
  ring(rect, corners);
  const Plane& plane = planes_[rect.plane];
  glm::dvec3 normal(0);
  normal[rect.axis] = 1;
  for (const Corner& corner : corners) {
    surface.position.push_back(place(rect, corner));
    surface.normal.push_back(normal);
  }
  if (corners.size() == 4) {
    surface.index = {0, 1, 2, 0, 2, 3};
  } else {
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const Corner& corner : corners) flat.emplace_back(plane.u[corner.first], plane.v[corner.second]);
    cut_ears(flat, surface.index);
  }
  for (int side = 0; side < 4; ++side) {
    if (rect.is_backed[static_cast<std::size_t>(side)]) add_strip(rect, side, surface);
  }
  surface.has_face_normals = true;
  return true;
}

}  // namespace seedmesh::building
