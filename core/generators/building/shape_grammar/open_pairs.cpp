/// Points of a left shape are p(t) = c + sum t_k d_k in its open variables t. If a similarity maps it to points q of the figure,
/// its inverse has p = N q + s. In the plane N has two numbers, and the equations are linear in N, s and t together. In space the
/// rotation of N follows first, from three points whose directions do not depend on t; its scale is one more unknown.
#include "core/generators/building/shape_grammar/open_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/math.h"
#include "core/generators/building/shape_grammar/open_equations.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr double same_point = 1e-7;  ///< share of the left shape
constexpr double same_place = 1e-5;  ///< share of the left shape by which matched points may differ

/// Elements of equal kinds in equal order, so that points can be compared by number.
bool are_alike(const Figure& a, const Figure& b) {
  const auto same_solid = [](const FigureSolid& s, const FigureSolid& o) {
    return s.kind == o.kind && s.material == o.material && glm::length(s.axes[0] - o.axes[0]) <= same_point &&
           glm::length(s.axes[1] - o.axes[1]) <= same_point &&
           glm::length(s.axes[2] - o.axes[2]) <= same_point;
  };
  return a.lines.size() == b.lines.size() && a.markers.size() == b.markers.size() &&
         std::ranges::equal(a.solids, b.solids, same_solid);
}

/// All points of the elements.
std::vector<FigureAnchor> all_points(const Figure& figure) {
  std::vector<FigureAnchor> points = anchors_of_wholes(figure);
  const std::vector<FigureAnchor> ends = ends_of(figure.lines);
  points.insert(points.end(), ends.begin(), ends.end());
  return points;
}

glm::dvec3 point_of(const OpenAnchor& anchor, std::span<const double> values) {
  glm::dvec3 p = anchor.at;
  for (std::size_t k = 0; k < values.size(); ++k) p += values[k] * anchor.changes[k];
  return p;
}

/// The axes along a line and in a plane.
glm::dmat3 frame_of(const glm::dvec3& along, const glm::dvec3& in_plane) {
  const glm::dvec3 x = math::unit(along, glm::dvec3(1, 0, 0));
  const glm::dvec3 z = math::unit(glm::cross(x, in_plane), glm::dvec3(0, 1, 0));
  return {x, glm::cross(z, x), z};
}

}  // namespace

std::vector<double> samples_of(const FigurePair& pair, double share) {
  std::vector<double> values;
  for (const OpenVariable& each : pair.open) values.push_back(each.low + share * (each.high - each.low));
  return values;
}

FigureValues named(const FigurePair& pair, const std::vector<double>& values) {
  FigureValues out;
  for (std::size_t k = 0; k < pair.open.size(); ++k) out[pair.open[k].name] = values[k];
  return out;
}

void check_open_variables(const BuildingPair& given, const std::string& pointer, std::vector<Issue>& issues) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < given.open.size(); ++k) {
    const BuildingOpenVariable& each = given.open[k];
    const std::string at = pointer + "/open/" + std::to_string(k);
    if (!names.insert(each.name).second) {
      issues.emplace_back(conflict_with({}), at + "/name", "found two variables of this name, expected one");
    }
    for (std::size_t side = 0; side < 2; ++side) {
      if (given.pair[side].parameters.contains(each.name)) {
        issues.emplace_back(conflict_with({"open"}),
                            pointer + "/pair/" + std::to_string(side) + "/parameters/" + each.name,
                            "found a value for an open variable, expected none: a match determines it");
      }
    }
    if (!(each.low < each.high)) {
      issues.emplace_back(IssueKind::out_of_range, at,
                          "found a range without an extent, expected `low` below `high`");
    }
  }
}

Figure left_shape(const FigurePair& pair, const std::vector<double>& values) {
  Figure out = pair.left;
  const std::vector<double> first = samples_of(pair, first_sample), second = samples_of(pair, second_sample);
  for (std::size_t k = 0; k < pair.open.size(); ++k) {
    const double share = (values[k] - first[k]) / (second[k] - first[k]);
    const Figure& moved = pair.moved[k];
    const auto move = [share](glm::dvec3& p, const glm::dvec3& from, const glm::dvec3& to) {
      p += share * (to - from);
    };
    for (std::size_t i = 0; i < out.lines.size(); ++i) {
      move(out.lines[i].from, pair.left.lines[i].from, moved.lines[i].from);
      move(out.lines[i].to, pair.left.lines[i].to, moved.lines[i].to);
    }
    for (std::size_t i = 0; i < out.markers.size(); ++i) {
      for (std::uint32_t n = 0; n < out.markers[i].count; ++n)
        move(out.markers[i].points[n], pair.left.markers[i].points[n], moved.markers[i].points[n]);
    }
    for (std::size_t i = 0; i < out.solids.size(); ++i) {
      move(out.solids[i].base, pair.left.solids[i].base, moved.solids[i].base);
      move(out.solids[i].size, pair.left.solids[i].size, moved.solids[i].size);
    }
  }
  return out;
}

void check_open_left(const FigurePair& pair, const Figure& other, const std::vector<double>& values,
                     bool is_flat, const std::string& pointer, std::vector<Issue>& issues) {
  bool is_linear = are_alike(pair.left, other);
  for (const Figure& each : pair.moved) is_linear = is_linear && are_alike(pair.left, each);
  if (is_linear) {
    const std::vector<FigureAnchor> found = all_points(other),
                                    expected = all_points(left_shape(pair, values));
    const double near = same_point * std::max(reach_of(other), 1e-9);
    for (std::size_t i = 0; i < found.size(); ++i)
      is_linear = is_linear && glm::length(found[i].at - expected[i].at) <= near;
  }
  if (!is_linear) {
    issues.emplace_back(
        IssueKind::invalid_value, pointer,
        "the points of this shape are not linear in its open variables, or its solids turn with them");
    return;
  }
  const std::vector<OpenAnchor> anchors = open_anchors(pair);
  if (anchors.empty() || search_order(anchors, is_flat, {}, 1).empty()) {
    issues.emplace_back(
        IssueKind::invalid_value, pointer,
        "the points of this shape do not determine its position, direction and size and the open variables: "
        "expected more points, or fewer open variables (one length stays a number)");
  }
}

std::vector<OpenAnchor> open_anchors(const FigurePair& pair) {
  const std::vector<FigureAnchor> points = all_points(pair.left);
  std::vector<std::vector<FigureAnchor>> moved;
  for (const Figure& each : pair.moved) moved.push_back(all_points(each));
  const std::vector<double> first = samples_of(pair, first_sample), second = samples_of(pair, second_sample);
  const double near = same_point * std::max(reach_of(pair.left), 1e-9);
  const std::size_t wholes = points.size() - 2 * pair.left.lines.size();
  const auto coincide = [&](std::size_t a, std::size_t b) {
    bool all = glm::length(points[a].at - points[b].at) <= near;
    for (const auto& each : moved) all = all && glm::length(each[a].at - each[b].at) <= near;
    return all;
  };
  std::vector<OpenAnchor> anchors;
  std::vector<std::uint32_t> number(points.size());  // of the anchor of each point
  std::vector<std::size_t> source;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t same = source.size();
    for (std::size_t k = 0; k < source.size() && i >= wholes; ++k) {
      if (source[k] >= wholes && coincide(source[k], i)) same = k;
    }
    number[i] = static_cast<std::uint32_t>(same);
    if (same < source.size()) continue;
    source.push_back(i);
    OpenAnchor anchor{points[i].at, points[i].at, {}, points[i].kind, points[i].owner, points[i].corner, {}};
    for (std::size_t k = 0; k < moved.size(); ++k) {
      anchor.changes.push_back((moved[k][i].at - points[i].at) / (second[k] - first[k]));
      anchor.at -= first[k] * anchor.changes.back();
    }
    anchors.push_back(std::move(anchor));
  }
  for (std::size_t line = 0; line < pair.left.lines.size(); ++line) {
    const std::uint32_t a = number[wholes + 2 * line], b = number[wholes + 2 * line + 1];
    anchors[a].beside.push_back(b);
    anchors[b].beside.push_back(a);
  }
  // An end that lines of several directions share is a crossing.
  for (OpenAnchor& each : anchors) {
    if (each.beside.size() < 2 || each.owner != no_owner) continue;
    const std::size_t own = source[static_cast<std::size_t>(&each - anchors.data())];
    const glm::dvec3 u = points[source[each.beside[0]]].at - points[own].at;
    const bool crosses = std::ranges::any_of(each.beside, [&](std::uint32_t k) {
      const glm::dvec3 v = points[source[k]].at - points[own].at;
      return glm::length(glm::cross(u, v)) > 1e-6 * glm::length(u) * glm::length(v);
    });
    if (crosses) each.kind = anchor_crossing;
  }
  return anchors;
}

std::optional<OpenPlacement> solve_placement(const std::vector<OpenAnchor>& anchors,
                                             std::span<const std::uint32_t> order,
                                             std::span<const glm::dvec3> points, bool is_flat,
                                             bool is_mirrored) {
  // The points are centred and scaled, so that the equations are well conditioned.
  const glm::dvec3 centre = points[0];
  double extent = 0;
  for (const glm::dvec3& p : points) extent = std::max(extent, glm::length(p - centre));
  if (!(extent > 0)) return std::nullopt;
  glm::dmat3 turn(1);  // of the figure, so that what is left is a scale, or in the plane a rotation
  if (is_flat) {
    turn[2][2] = is_mirrored ? -1 : 1;
  } else {
    const auto sample = [&](std::size_t i) { return anchors[order[i]].sample; };
    glm::dmat3 there = frame_of(points[1] - centre, points[2] - centre);
    if (is_mirrored) there[2] = -there[2];
    turn = frame_of(sample(1) - sample(0), sample(2) - sample(0)) * glm::transpose(there);
  }
  Rows rows;
  for (std::size_t i = 0; i < order.size(); ++i)
    add_rows(rows, anchors[order[i]], turn * ((points[i] - centre) / extent), is_flat);
  std::vector<double> x;
  const std::size_t count = rows[0].size() - 1;
  if (solve(rows, x) < count) return std::nullopt;
  OpenPlacement found;
  found.values.assign(x.begin() + 4, x.end());
  double reach = 0;
  for (const std::uint32_t each : order) {
    reach = std::max(reach, glm::length(point_of(anchors[each], found.values) -
                                        point_of(anchors[order[0]], found.values)));
  }
  for (const std::vector<double>& row : rows) {
    double rest = -row[count];
    for (std::size_t c = 0; c < count; ++c) rest += row[c] * x[c];
    if (!(std::abs(rest) <= same_place * reach)) return std::nullopt;
  }
  // p = size * rotation * turn * (q - centre) + shift, of which the place is the inverse.
  const double size = (is_flat ? std::sqrt(x[0] * x[0] + x[1] * x[1]) : x[0]) / extent;
  if (!(size > 0)) return std::nullopt;
  glm::dmat3 rotation(1);
  if (is_flat) {
    const double c = x[0] / (size * extent), b = x[1] / (size * extent);
    rotation = glm::dmat3(glm::dvec3(c, 0, b), glm::dvec3(0, 1, 0), glm::dvec3(-b, 0, c));
  }
  const glm::dvec3 shift = is_flat ? glm::dvec3(x[2], 0, x[3]) : glm::dvec3(x[1], x[2], x[3]);
  found.place.turn = glm::transpose(rotation * turn);
  found.place.scale = 1 / size;
  found.place.shift = centre - found.place.turn * (found.place.scale * shift);
  return found;
}

}  // namespace seedmesh::building
