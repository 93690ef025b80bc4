/// Points of a left shape are p(t) = c + sum t_k d_k in its open variables t. If a similarity maps it to points q of the picture,
/// its inverse has p = N q + s. Both together are linear in N, s and t. In the plane N has two numbers (a similarity, or a
/// mirrored one); in space it has nine, and only a multiple of an orthonormal matrix is a solution.
#include "core/generators/building/shape_grammar/open_pairs.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/math.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr double same_point = 1e-7;  ///< share of the left shape
constexpr double same_place = 1e-5;  ///< share of the left shape by which matched points may differ
constexpr double no_pivot = 1e-9;    ///< a smaller part of a column depends on the others

using Rows = std::vector<std::vector<double>>;

std::size_t unknowns_of(std::size_t variables, bool is_flat) { return (is_flat ? 4U : 12U) + variables; }

/// The equations of one anchor at the point q: coefficients of N, s and t, and the right side last.
void add_rows(Rows& rows, const OpenAnchor& anchor, const glm::dvec3& q, bool is_flat) {
  const std::size_t count = unknowns_of(anchor.changes.size(), is_flat);
  const auto finish = [&](std::vector<double> row, int axis) {
    for (std::size_t k = 0; k < anchor.changes.size(); ++k)
      row[count - anchor.changes.size() + k] = -anchor.changes[k][axis];
    row[count] = anchor.at[axis];
    rows.push_back(std::move(row));
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (is_flat && axis == 1) continue;
    std::vector<double> row(count + 1, 0.0);
    if (is_flat) {  // N = (a, -b; b, a)
      row[0] = axis == 0 ? q.x : q.z;
      row[1] = axis == 0 ? -q.z : q.x;
      row[axis == 0 ? 2 : 3] = 1;
    } else {
      const auto at = static_cast<std::size_t>(axis);
      for (int k = 0; k < 3; ++k) row[3 * at + static_cast<std::size_t>(k)] = q[k];
      row[9 + at] = 1;
    }
    finish(std::move(row), axis);
  }
}

/// Solves the equations by orthogonal columns (Gram and Schmidt). Returns the rank; `x` is set if it is full.
std::size_t solve(const Rows& rows, std::vector<double>& x) {
  const std::size_t count = rows.empty() ? 0 : rows[0].size() - 1;
  std::vector<std::vector<double>> basis;         // orthonormal columns
  std::vector<std::vector<double>> upper(count);  // of each column: its parts along the basis
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  for (std::size_t c = 0; c < count; ++c) {
    std::vector<double> column;
    for (const std::vector<double>& row : rows) column.push_back(row[c]);
    const double length = std::sqrt(dot(column, column));
    upper[c].assign(basis.size() + 1, 0.0);
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes rounding
      for (std::size_t k = 0; k < basis.size(); ++k) {
        const double part = dot(basis[k], column);
        upper[c][k] += part;
        for (std::size_t i = 0; i < column.size(); ++i) column[i] -= part * basis[k][i];
      }
    }
    const double rest = std::sqrt(dot(column, column));
    if (!(rest > no_pivot * length)) continue;
    upper[c][basis.size()] = rest;
    for (double& each : column) each /= rest;
    basis.push_back(std::move(column));
  }
  if (basis.size() < count) return basis.size();
  std::vector<double> right;
  for (const std::vector<double>& row : rows) right.push_back(row[count]);
  x.assign(count, 0.0);
  for (std::size_t c = count; c-- > 0;) {
    double value = dot(basis[c], right);
    for (std::size_t k = c + 1; k < count; ++k) value -= upper[k][c] * x[k];
    x[c] = value / upper[c][c];
  }
  return count;
}

/// Elements of equal kinds in equal order, so that points can be compared by number.
bool are_alike(const ShapePicture& a, const ShapePicture& b) {
  const auto same_solid = [](const PictureSolid& s, const PictureSolid& o) {
    return s.kind == o.kind && s.material == o.material && glm::length(s.axes[0] - o.axes[0]) <= same_point &&
           glm::length(s.axes[1] - o.axes[1]) <= same_point &&
           glm::length(s.axes[2] - o.axes[2]) <= same_point;
  };
  return a.lines.size() == b.lines.size() && a.markers.size() == b.markers.size() &&
         std::ranges::equal(a.solids, b.solids, same_solid);
}

/// All points of the elements.
std::vector<PictureAnchor> all_points(const ShapePicture& picture) {
  std::vector<PictureAnchor> points = anchors_of_wholes(picture);
  const std::vector<PictureAnchor> ends = ends_of(picture.lines);
  points.insert(points.end(), ends.begin(), ends.end());
  return points;
}

glm::dvec3 point_of(const OpenAnchor& anchor, std::span<const double> values) {
  glm::dvec3 p = anchor.at;
  for (std::size_t k = 0; k < values.size(); ++k) p += values[k] * anchor.changes[k];
  return p;
}

/// Chooses the anchor with the fewest candidates that adds equations, until there are enough. The cost is the number of
/// combinations; infinity where they are not enough.
struct Choice {
  std::vector<std::uint32_t> order;
  double cost = 1;
};

Choice choose_anchors(const std::vector<OpenAnchor>& anchors, bool is_flat, bool with_wholes,
                      const std::map<std::uint32_t, std::size_t>& counts, double per_line) {
  Choice choice;
  Rows rows;
  std::size_t rank = 0;
  const std::size_t wanted = unknowns_of(anchors[0].changes.size(), is_flat);
  std::vector<double> ignored;
  // Values between the samples, at which no points coincide by chance.
  std::vector<double> values;
  for (std::size_t k = 0; k < anchors[0].changes.size(); ++k)
    values.push_back(0.73 + 0.11 * static_cast<double>(k));
  const auto cost_of = [&](const OpenAnchor& each) {
    const bool is_known = std::ranges::any_of(choice.order, [&](std::uint32_t k) {
      return each.owner != no_owner && anchors[k].owner == each.owner;
    });
    if (is_known) return 8.0;
    const bool is_beside = std::ranges::any_of(choice.order, [&](std::uint32_t k) {
      return std::ranges::find(each.beside, k) != each.beside.end();
    });
    const auto found = counts.find(each.kind);
    const double count = found == counts.end() ? 0.0 : static_cast<double>(found->second);
    return is_beside && each.kind == anchor_crossing ? std::min(count, 2 * per_line) : count;
  };
  while (rank < wanted) {
    std::uint32_t best = no_owner;
    double least = 0;
    std::size_t reached = rank;
    for (std::uint32_t i = 0; i < anchors.size(); ++i) {
      if (!with_wholes && anchors[i].owner != no_owner) continue;
      const double cost = cost_of(anchors[i]);
      if (best != no_owner && cost >= least) continue;
      Rows more = rows;
      add_rows(more, anchors[i], point_of(anchors[i], values), is_flat);
      const std::size_t now = solve(more, ignored);
      if (now <= rank) continue;
      best = i;
      least = cost;
      reached = now;
    }
    if (best == no_owner) return {{}, 1e300};
    add_rows(rows, anchors[best], point_of(anchors[best], values), is_flat);
    rank = reached;
    choice.order.push_back(best);
    choice.cost *= least;
  }
  return choice;
}

/// The similarity whose inverse is p = linear q + shift; nothing unless `linear` is a multiple of an orthonormal matrix.
std::optional<Similarity> inverse_of(const glm::dmat3& linear, const glm::dvec3& shift, double near) {
  const double size = glm::length(linear[0]);
  if (!(size > 0)) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k <= i; ++k) {
      const double expected = i == k ? 1 : 0;
      if (std::abs(glm::dot(linear[i], linear[k]) / (size * size) - expected) > near) return std::nullopt;
    }
  }
  const glm::dvec3 x = linear[0] / size;
  const glm::dvec3 y = math::unit(linear[1] - x * glm::dot(x, linear[1]), glm::dvec3(0, 1, 0));
  const glm::dvec3 z = glm::cross(x, y);
  Similarity place;
  place.turn = glm::transpose(glm::dmat3(x, y, glm::dot(z, linear[2]) < 0 ? -z : z));
  place.scale = 1 / size;
  place.shift = -(place.turn * (place.scale * shift));
  return place;
}

}  // namespace

std::vector<double> samples_of(const PicturePair& pair, double share) {
  std::vector<double> values;
  for (const OpenVariable& each : pair.open) values.push_back(each.low + share * (each.high - each.low));
  return values;
}

PictureValues named(const PicturePair& pair, const std::vector<double>& values) {
  PictureValues out;
  for (std::size_t k = 0; k < pair.open.size(); ++k) out[pair.open[k].name] = values[k];
  return out;
}

void check_open_variables(const BuildingPair& given, const std::string& pointer, std::vector<Issue>& issues) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < given.open.size(); ++k) {
    const BuildingOpenVariable& each = given.open[k];
    const std::string at = pointer + "/open/" + std::to_string(k);
    if (!names.insert(each.name).second)
      issues.push_back({IssueKind::conflict, at + "/name", "found two variables of this name, expected one"});
    for (std::size_t side = 0; side < 2; ++side) {
      if (given.pair[side].parameters.contains(each.name))
        issues.push_back({IssueKind::conflict,
                          pointer + "/pair/" + std::to_string(side) + "/parameters/" + each.name,
                          "found a value for an open variable, expected none: a match determines it"});
    }
    if (!(each.low < each.high))
      issues.push_back(
          {IssueKind::out_of_range, at, "found a range without an extent, expected `low` below `high`"});
  }
}

ShapePicture left_shape(const PicturePair& pair, const std::vector<double>& values) {
  ShapePicture out = pair.left;
  const std::vector<double> first = samples_of(pair, first_sample), second = samples_of(pair, second_sample);
  for (std::size_t k = 0; k < pair.open.size(); ++k) {
    const double share = (values[k] - first[k]) / (second[k] - first[k]);
    const ShapePicture& moved = pair.moved[k];
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

void check_open_left(const PicturePair& pair, const ShapePicture& other, const std::vector<double>& values,
                     bool is_flat, const std::string& pointer, std::vector<Issue>& issues) {
  bool is_linear = are_alike(pair.left, other);
  for (const ShapePicture& each : pair.moved) is_linear = is_linear && are_alike(pair.left, each);
  if (is_linear) {
    const std::vector<PictureAnchor> found = all_points(other),
                                     expected = all_points(left_shape(pair, values));
    const double near = same_point * std::max(reach_of(other), 1e-9);
    for (std::size_t i = 0; i < found.size(); ++i)
      is_linear = is_linear && glm::length(found[i].at - expected[i].at) <= near;
  }
  if (!is_linear) {
    issues.push_back(
        {IssueKind::invalid_value, pointer,
         "the points of this shape are not linear in its open variables, or its solids turn with them"});
    return;
  }
  const std::vector<OpenAnchor> anchors = open_anchors(pair);
  if (anchors.empty() || search_order(anchors, is_flat, {}, 1).empty())
    issues.push_back(
        {IssueKind::invalid_value, pointer,
         "the points of this shape do not determine its position, direction and size and the open variables: "
         "expected more points, or fewer open variables (one length stays a number)"});
}

std::vector<OpenAnchor> open_anchors(const PicturePair& pair) {
  const std::vector<PictureAnchor> points = all_points(pair.left);
  std::vector<std::vector<PictureAnchor>> moved;
  for (const ShapePicture& each : pair.moved) moved.push_back(all_points(each));
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
    OpenAnchor anchor{points[i].at, {}, points[i].kind, points[i].owner, points[i].corner, {}};
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

std::vector<std::uint32_t> search_order(const std::vector<OpenAnchor>& anchors, bool is_flat,
                                        const std::map<std::uint32_t, std::size_t>& counts, double per_line) {
  const Choice all = choose_anchors(anchors, is_flat, true, counts, per_line);
  const Choice lines = choose_anchors(anchors, is_flat, false, counts, per_line);
  return lines.cost < all.cost || all.order.empty() ? lines.order : all.order;
}

std::optional<OpenPlace> solve_place(const std::vector<OpenAnchor>& anchors,
                                     std::span<const std::uint32_t> order, std::span<const glm::dvec3> points,
                                     bool is_flat, bool is_mirrored) {
  // The points are centred and scaled, so that the equations are well conditioned.
  const glm::dvec3 centre = points[0];
  double extent = 0;
  for (const glm::dvec3& p : points) extent = std::max(extent, glm::length(p - centre));
  if (!(extent > 0)) return std::nullopt;
  const glm::dvec3 flip(1, 1, is_flat && is_mirrored ? -1 : 1);
  Rows rows;
  for (std::size_t i = 0; i < order.size(); ++i)
    add_rows(rows, anchors[order[i]], flip * (points[i] - centre) / extent, is_flat);
  std::vector<double> x;
  const std::size_t count = rows[0].size() - 1;
  if (solve(rows, x) < count) return std::nullopt;
  OpenPlace found;
  found.values.assign(x.end() - static_cast<std::ptrdiff_t>(anchors[0].changes.size()), x.end());
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
  glm::dmat3 linear(1);
  glm::dvec3 shift(0);
  if (is_flat) {
    linear = glm::dmat3(glm::dvec3(x[0], 0, x[1]), glm::dvec3(0), glm::dvec3(-x[1], 0, x[0]));
    linear[2] *= flip.z;
    linear[1] = glm::dvec3(0, glm::length(linear[0]), 0);
    shift = glm::dvec3(x[2], 0, x[3]);
  } else {
    linear = glm::transpose(glm::dmat3(x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7], x[8]));
    shift = glm::dvec3(x[9], x[10], x[11]);
  }
  linear /= extent;
  const std::optional<Similarity> place = inverse_of(linear, shift - linear * centre, same_place);
  if (!place) return std::nullopt;
  found.place = *place;
  return found;
}

}  // namespace seedmesh::building
