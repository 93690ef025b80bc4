#include "core/generators/building/shape_grammar/anchors.h"

#include <algorithm>
#include <cmath>

namespace seedmesh::building {
namespace {

constexpr std::uint32_t first_marker = 2, first_solid = 0x40000000U, solid_owner = 0x80000000U;

bool is_apart(const glm::dvec3& a, const glm::dvec3& b, double extent) {
  return glm::length(a - b) > 1e-6 * extent;
}

bool is_in_line(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double extent) {
  return glm::length(glm::cross(b - a, c - a)) <= 1e-6 * extent * glm::length(b - a);
}

/// Where two lines come nearest to each other, if that is within `near` of both.
bool crossing(const FigureLine& a, const FigureLine& b, double near, glm::dvec3& at) {
  const glm::dvec3 u = a.to - a.from, v = b.to - b.from, w = a.from - b.from;
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
  const double det = uu * vv - uv * uv;
  if (det <= 1e-12 * uu * vv) return false;
  const double s = (uv * glm::dot(v, w) - vv * glm::dot(u, w)) / det;
  const double t = (uu * glm::dot(v, w) - uv * glm::dot(u, w)) / det;
  const double along = near / std::sqrt(uu), other = near / std::sqrt(vv);
  if (s < -along || s > 1 + along || t < -other || t > 1 + other) return false;
  at = a.from + s * u;
  return glm::length(b.from + t * v - at) <= near;
}

double extent_of(const std::vector<FigureAnchor>& anchors) {
  double extent = 0;
  for (const FigureAnchor& each : anchors)
    extent = std::max(extent, glm::length(each.at - anchors.front().at));
  return extent;
}

bool determines_similarity(const std::vector<FigureAnchor>& anchors, bool is_flat) {
  const double extent = extent_of(anchors);
  if (!(extent > 0)) return false;
  if (is_flat) return true;
  const glm::dvec3 first = anchors.front().at;
  const auto second = std::ranges::find_if(
      anchors, [&](const FigureAnchor& each) { return is_apart(each.at, first, extent); });
  return std::ranges::any_of(
      anchors, [&](const FigureAnchor& each) { return !is_in_line(first, second->at, each.at, extent); });
}

}  // namespace

std::vector<FigureAnchor> anchors_of_wholes(const Figure& figure) {
  std::vector<FigureAnchor> out;
  for (std::uint32_t i = 0; i < figure.markers.size(); ++i) {
    const FigureMarker& marker = figure.markers[i];
    for (std::uint32_t k = 0; k < marker.count; ++k)
      out.push_back({marker.points[k], first_marker + 12 * marker.label + 4 * (marker.count - 1) + k, i});
  }
  for (std::uint32_t i = 0; i < figure.solids.size(); ++i) {
    const FigureSolid& solid = figure.solids[i];
    double radius = 0;
    std::uint32_t corner = 0;
    for (const KeyPoint& point : key_points(solid, radius)) {
      const std::uint32_t kind =
          first_solid + (solid.material * 8 + static_cast<std::uint32_t>(solid.kind)) * 2 + point.role;
      out.push_back({point.at, kind, solid_owner | i, corner++});
    }
  }
  return out;
}

std::vector<FigureAnchor> crossings_of(const std::vector<FigureLine>& lines, double near, const Job* job) {
  std::vector<FigureAnchor> out;
  std::uint64_t looked = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = i + 1; k < lines.size(); ++k) {
      if ((++looked & 4095U) == 0 && job != nullptr) job->check();
      glm::dvec3 at(0);
      if (crossing(lines[i], lines[k], near, at)) out.push_back({at, anchor_crossing, no_owner});
    }
  }
  return out;
}

std::vector<FigureAnchor> ends_of(const std::vector<FigureLine>& lines) {
  std::vector<FigureAnchor> out;
  for (const FigureLine& line : lines) {
    out.push_back({line.from, anchor_end, no_owner});
    out.push_back({line.to, anchor_end, no_owner});
  }
  return out;
}

std::vector<FigureAnchor> anchors_of_left(const Figure& left, bool is_flat, bool& is_determined) {
  std::vector<FigureAnchor> anchors = anchors_of_wholes(left);
  const std::vector<FigureAnchor> crossings =
      crossings_of(left.lines, 1e-7 * std::max(reach_of(left), 1e-9), nullptr);
  anchors.insert(anchors.end(), crossings.begin(), crossings.end());
  is_determined = determines_similarity(anchors, is_flat);
  if (!is_determined) {
    const std::vector<FigureAnchor> ends = ends_of(left.lines);
    anchors.insert(anchors.end(), ends.begin(), ends.end());
    is_determined = determines_similarity(anchors, is_flat);
  }
  return anchors;
}

std::array<FigureAnchor, 3> chosen_anchors(const std::vector<FigureAnchor>& anchors, bool is_flat,
                                           const std::map<std::uint32_t, std::size_t>& counts) {
  const double extent = extent_of(anchors);
  std::array<FigureAnchor, 3> chosen{};
  const auto count_of = [&](const FigureAnchor& each, std::size_t before) {
    // A further point of a marker or solid that is chosen already costs nothing to find.
    for (std::size_t k = 0; k < before; ++k) {
      if (each.owner != no_owner && chosen[k].owner == each.owner) return std::size_t{1};
    }
    const auto found = counts.find(each.kind);
    return found == counts.end() ? std::size_t{0} : found->second;
  };
  const std::size_t wanted = is_flat ? 2 : 3;
  for (std::size_t k = 0; k < wanted; ++k) {
    const FigureAnchor* best = nullptr;
    for (const FigureAnchor& each : anchors) {
      if (k > 0 && !is_apart(each.at, chosen[0].at, extent)) continue;
      if (k > 1 && is_in_line(chosen[0].at, chosen[1].at, each.at, extent)) continue;
      if (best == nullptr || count_of(each, k) < count_of(*best, k)) best = &each;
    }
    // The first point may stand where all others are in a line with it: then any second one will do.
    chosen[k] = best != nullptr ? *best : chosen[k - 1];
  }
  if (is_flat) chosen[2] = chosen[1];
  return chosen;
}

}  // namespace seedmesh::building
