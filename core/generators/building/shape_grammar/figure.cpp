#include "core/generators/building/shape_grammar/figure.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

double length_of(const FigureLine& line) { return glm::length(line.to - line.from); }

/// Where `line` runs along `other`, as distances from the start of `other`; false where the two have no
/// carrier in common. Measured along the longer one, whose direction is known better.
bool run_along(const FigureLine& other, const FigureLine& line, double near, double& low, double& high) {
  const bool is_longer = length_of(other) >= length_of(line);
  const FigureLine& carrier = is_longer ? other : line;
  const FigureLine& short_one = is_longer ? line : other;
  const double length = length_of(carrier);
  if (!(length > 0)) return false;
  const glm::dvec3 along = (carrier.to - carrier.from) / length;
  for (const glm::dvec3& p : {short_one.from, short_one.to}) {
    const glm::dvec3 off = p - carrier.from;
    if (glm::length(off - along * glm::dot(off, along)) > near) return false;
  }
  const glm::dvec3 own = (other.to - other.from) / std::max(length_of(other), 1e-300);
  low = glm::dot(own, line.from - other.from);
  high = glm::dot(own, line.to - other.from);
  if (low > high) std::swap(low, high);
  return true;
}

glm::dvec3 in_solid(const FigureSolid& solid, double x, double y, double z) {
  return solid.base + solid.axes * (glm::dvec3(x - 0.5, y, z - 0.5) * solid.size);
}

}  // namespace

FigureMarker Similarity::of(const FigureMarker& marker) const {
  FigureMarker out = marker;
  for (std::uint32_t i = 0; i < marker.count; ++i) out.points[i] = of(marker.points[i]);
  return out;
}

FigureSolid Similarity::of(const FigureSolid& solid) const {
  FigureSolid out = solid;
  out.base = of(solid.base);
  out.axes = turn * solid.axes;
  out.size = scale * solid.size;
  return out;
}

std::vector<KeyPoint> key_points(const FigureSolid& solid, double& radius) {
  std::vector<KeyPoint> points;
  radius = 0;
  const auto corners = [&](double height, double inset, std::uint32_t role) {
    for (const double x : {inset, 1 - inset}) {
      for (const double z : {inset, 1 - inset}) points.push_back({in_solid(solid, x, height, z), role});
    }
  };
  switch (solid.kind) {
    case SolidKind::box:
      corners(0, 0, 0);
      if (solid.size.y > 0) corners(1, 0, 0);
      break;
    case SolidKind::prism:
      corners(0, 0, 0);
      corners(1, 0.25, 1);
      break;
    case SolidKind::pyramid:
      corners(0, 0, 0);
      points.push_back({in_solid(solid, 0.5, 1, 0.5), 1});
      break;
    case SolidKind::triangular_prism:
      corners(0, 0, 0);
      for (const double z : {0.0, 1.0}) points.push_back({in_solid(solid, 0.5, 1, z), 1});
      break;
    case SolidKind::cylinder:
    case SolidKind::cone:
      radius = 0.5 * solid.size.x;
      points.push_back({solid.base, 0});
      if (solid.size.y > 0)
        points.push_back({in_solid(solid, 0.5, 1, 0.5), solid.kind == SolidKind::cone ? 1U : 0U});
      break;
    case SolidKind::sphere:
      radius = 0.5 * solid.size.x;
      points.push_back({in_solid(solid, 0.5, 0.5, 0.5), 0});
      break;
  }
  return points;
}

bool are_equal(const FigureMarker& a, const FigureMarker& b, double near) {
  if (a.label != b.label || a.count != b.count) return false;
  for (std::uint32_t i = 0; i < a.count; ++i) {
    if (glm::length(a.points[i] - b.points[i]) > near) return false;
  }
  return true;
}

bool are_equal(const FigureSolid& a, const FigureSolid& b, double near) {
  if (a.kind != b.kind || a.material != b.material) return false;
  // A quick look before the points are worked out: the middles of equal solids agree.
  if (glm::length(in_solid(a, 0.5, 0.5, 0.5) - in_solid(b, 0.5, 0.5, 0.5)) > near) return false;
  double radius = 0, other = 0;
  const std::vector<KeyPoint> mine = key_points(a, radius), theirs = key_points(b, other);
  if (mine.size() != theirs.size() || std::abs(radius - other) > near) return false;
  return std::ranges::all_of(mine, [&](const KeyPoint& p) {
    return std::ranges::any_of(
        theirs, [&](const KeyPoint& q) { return p.role == q.role && glm::length(p.at - q.at) <= near; });
  });
}

bool contains(const std::vector<FigureLine>& lines, const FigureLine& line, double near) {
  return std::ranges::any_of(lines, [&](const FigureLine& each) {
    double low = 0, high = 0;
    return run_along(each, line, near, low, high) && low >= -near && high <= length_of(each) + near;
  });
}

void add_line(std::vector<FigureLine>& lines, FigureLine line, double near) {
  if (length_of(line) <= near) return;
  for (std::size_t i = 0; i < lines.size();) {
    double low = 0, high = 0;
    const FigureLine each = lines[i];
    if (!run_along(each, line, near, low, high) || high < -near || low > length_of(each) + near) {
      ++i;
      continue;
    }
    // One line from the farther end to the farther end; it may touch others now, which have been passed.
    const glm::dvec3 along = (each.to - each.from) / length_of(each);
    const bool runs_on = glm::dot(along, line.to - line.from) > 0;
    const glm::dvec3 first = runs_on ? line.from : line.to, last = runs_on ? line.to : line.from;
    line = {low < 0 ? first : each.from, high > length_of(each) ? last : each.to};
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  lines.push_back(line);
}

void remove_line(std::vector<FigureLine>& lines, const FigureLine& line, double near) {
  std::vector<FigureLine> rests;
  std::erase_if(lines, [&](const FigureLine& each) {
    double low = 0, high = 0;
    const double length = length_of(each);
    if (!run_along(each, line, near, low, high) || high <= near || low >= length - near) return false;
    const glm::dvec3 along = (each.to - each.from) / length;
    if (low > near) rests.push_back({each.from, each.from + along * low});
    if (high < length - near) rests.push_back({each.from + along * high, each.to});
    return true;
  });
  lines.insert(lines.end(), rests.begin(), rests.end());
}

void add(Figure& to, const Figure& what, double near) {
  for (const FigureLine& line : what.lines) add_line(to.lines, line, near);
  for (const FigureMarker& marker : what.markers) {
    if (std::ranges::none_of(to.markers,
                             [&](const FigureMarker& each) { return are_equal(each, marker, near); }))
      to.markers.push_back(marker);
  }
  for (const FigureSolid& solid : what.solids) {
    if (std::ranges::none_of(to.solids,
                             [&](const FigureSolid& each) { return are_equal(each, solid, near); }))
      to.solids.push_back(solid);
  }
}

double reach_of(const Figure& figure) {
  double reach = 0;
  const auto take = [&](const glm::dvec3& p) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (const FigureLine& line : figure.lines) {
    take(line.from);
    take(line.to);
  }
  for (const FigureMarker& marker : figure.markers) {
    for (std::uint32_t i = 0; i < marker.count; ++i) take(marker.points[i]);
  }
  for (const FigureSolid& solid : figure.solids) {
    take(solid.base);
    reach = std::max(reach, glm::length(solid.size));
  }
  return reach;
}

}  // namespace seedmesh::building
