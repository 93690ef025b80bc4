#include "core/geom/polygon/massing_merge.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace seedmesh {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// The first of the points that are equal to each point; in the order of the points.
std::vector<std::uint32_t> first_equal(const std::vector<glm::dvec3>& points) {
  std::vector<std::uint32_t> order(points.size()), out(points.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const glm::vec3 p = glm::vec3(points[i]) + 0.0F;
    return std::array{p.x, p.y, p.z};
  };
  std::ranges::stable_sort(order, {}, key);
  for (std::size_t i = 0; i < order.size(); ++i)
    out[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? out[order[i - 1]] : order[i];
  return out;
}

/// The corners in order, and whether the triangle turns the other way than they do.
std::pair<Triangle, bool> unturned(Triangle t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  const bool is_turned = t[1] > t[2];
  if (is_turned) std::swap(t[1], t[2]);
  return {t, is_turned};
}

/// Marks pairs of triangles with the same corners that face each other.
void mark_back_to_back(const std::vector<Triangle>& triangles, std::vector<bool>& is_removed) {
  std::map<Triangle, std::array<std::vector<std::size_t>, 2>> open;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (is_removed[i]) continue;
    const auto [corners, is_turned] = unturned(triangles[i]);
    auto& sides = open[corners];
    std::vector<std::size_t>& opposite = sides[is_turned ? 0 : 1];
    if (opposite.empty()) {
      sides[is_turned ? 1 : 0].push_back(i);
    } else {
      is_removed[i] = is_removed[opposite.back()] = true;
      opposite.pop_back();
    }
  }
}

}  // namespace

bool merge_points(Mass& mass) {
  const std::vector<std::uint32_t> first = first_equal(mass.point);
  bool is_same = true;
  for (std::uint32_t i = 0; i < first.size(); ++i) is_same &= first[i] == i;
  if (is_same) return is_closed(mass);
  std::vector<bool> is_removed(mass.triangles.size(), false);
  for (std::size_t i = 0; i < mass.triangles.size(); ++i) {
    Triangle& t = mass.triangles[i];
    for (std::uint32_t& corner : t) corner = first[corner];
    is_removed[i] = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  }
  mark_back_to_back(mass.triangles, is_removed);
  std::vector<Triangle> kept;
  std::vector<Mass::Face> faces;
  for (std::size_t f = 0; f < mass.faces.size(); ++f) {
    const std::size_t end = f + 1 < mass.faces.size() ? mass.faces[f + 1].first : mass.triangles.size();
    Mass::Face face = mass.faces[f];
    const std::size_t from = face.first;
    face.first = static_cast<std::uint32_t>(kept.size());
    for (std::size_t i = from; i < end; ++i) {
      if (!is_removed[i]) kept.push_back(mass.triangles[i]);
    }
    if (kept.size() > face.first) faces.push_back(face);
  }
  mass.triangles = std::move(kept);
  mass.faces = std::move(faces);
  return is_closed(mass);
}

}  // namespace seedmesh
