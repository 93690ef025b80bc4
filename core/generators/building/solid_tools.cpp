#include "core/generators/building/solid_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/generators/building/solid_faces.h"

namespace seedmesh::building {
namespace {

double largest_size(const Solid& solid) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : solid.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return solid.points.empty() ? 0 : std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

double area_of_loop(const Solid& solid, const std::vector<std::uint32_t>& loop, const PlaneAxes& plane) {
  double sum = 0;
  const glm::dvec2 base = plane.flat(solid.points[loop[0]]);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = plane.flat(solid.points[loop[i]]) - base,
                     b = plane.flat(solid.points[loop[(i + 1) % loop.size()]]) - base;
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * sum;
}

bool contains(const Solid& solid, const std::vector<std::uint32_t>& loop, const PlaneAxes& plane,
              const glm::dvec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = plane.flat(solid.points[loop[i]]),
                     b = plane.flat(solid.points[loop[(i + 1) % loop.size()]]);
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

/// The loops along the border of faces of one plane. At a corner with several ways the way on is the one next to the
/// inside, so that loops touch themselves nowhere.
std::vector<std::vector<std::uint32_t>> loops_around(const Solid& solid,
                                                     const std::vector<DirectedEdge>& edges,
                                                     const PlaneAxes& plane) {
  std::multimap<std::uint32_t, std::size_t> from;
  for (std::size_t e = 0; e < edges.size(); ++e) from.emplace(edges[e].first, e);
  std::vector<std::uint8_t> is_used(edges.size(), 0);
  std::vector<std::vector<std::uint32_t>> loops;
  for (std::size_t first = 0; first < edges.size(); ++first) {
    if (is_used[first] != 0) continue;
    std::vector<std::uint32_t> loop;
    std::size_t e = first;
    while (is_used[e] == 0) {
      is_used[e] = 1;
      loop.push_back(edges[e].first);
      const auto [low, high] = from.equal_range(edges[e].second);
      const glm::dvec2 at = plane.flat(solid.points[edges[e].second]);
      const glm::dvec2 back = plane.flat(solid.points[edges[e].first]) - at;
      std::size_t best = e;
      double least = 1e300;
      for (auto way = low; way != high; ++way) {
        if (is_used[way->second] != 0) continue;
        const glm::dvec2 out = plane.flat(solid.points[edges[way->second].second]) - at;
        double turn = math::atan2(back.y, back.x) - math::atan2(out.y, out.x);
        if (turn <= 1e-12) turn += 2 * math::pi;
        if (turn < least) {
          least = turn;
          best = way->second;
        }
      }
      if (best == e) break;
      e = best;
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  return loops;
}

/// Adds faces of the loops of one plane: outer ones with the holes inside them.
void add_faces(Solid& to, const Face& like, const std::vector<std::vector<std::uint32_t>>& loops,
               const PlaneAxes& plane) {
  std::vector<double> areas;
  areas.reserve(loops.size());
  for (const auto& loop : loops) areas.push_back(area_of_loop(to, loop, plane));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (!(areas[i] > 0)) continue;
    std::vector<std::vector<std::uint32_t>> own{loops[i]};
    for (std::size_t h = 0; h < loops.size(); ++h) {
      if (areas[h] >= 0) continue;
      // The smallest outer loop around the middle of an edge of the hole.
      const glm::dvec2 p = 0.5 * (plane.flat(to.points[loops[h][0]]) + plane.flat(to.points[loops[h][1]]));
      std::size_t around = loops.size();
      for (std::size_t k = 0; k < loops.size(); ++k) {
        if (areas[k] > -areas[h] * (1 - 1e-9) && contains(to, loops[k], plane, p) &&
            (around == loops.size() || areas[k] < areas[around]))
          around = k;
      }
      if (around == i) own.push_back(loops[h]);
    }
    copy_face(to, like, own);
  }
}

}  // namespace

Solid welded(const Solid& solid, double distance) {
  const double cell = std::max(distance, 1e-9 * largest_size(solid));
  Solid out;
  out.is_closed = solid.is_closed;
  std::vector<std::uint32_t> number(solid.points.size());
  std::map<std::array<std::int64_t, 3>, std::vector<std::uint32_t>> cells;
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    const glm::dvec3& p = solid.points[i];
    const auto place = [&](double x) {
      return cell > 0 ? math::to_int64(std::floor(x / cell)) : std::int64_t{0};
    };
    std::uint32_t found = 0xFFFFFFFFU;
    for (int k = 0; k < 27 && found == 0xFFFFFFFFU; ++k) {
      const auto near =
          cells.find({place(p.x) + k % 3 - 1, place(p.y) + k / 3 % 3 - 1, place(p.z) + k / 9 - 1});
      if (near == cells.end()) continue;
      for (const std::uint32_t other : near->second) {
        if (glm::length(out.points[other] - p) <= cell) {
          found = other;
          break;
        }
      }
    }
    if (found == 0xFFFFFFFFU) {
      found = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(p);
      cells[{place(p.x), place(p.y), place(p.z)}].push_back(found);
    }
    number[i] = found;
  }
  for (const Face& face : solid.faces) {
    std::vector<std::vector<std::uint32_t>> loops;
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<std::uint32_t>& own = loops.emplace_back();
      for (const std::uint32_t point : points_of(solid, loop)) {
        if (own.empty() || own.back() != number[point]) own.push_back(number[point]);
      }
      while (own.size() > 1 && own.front() == own.back()) own.pop_back();
    }
    copy_face(out, face, loops);
  }
  return out;
}

Solid with_joined_faces(const Solid& solid, double distance) {
  const double slack = std::max(distance, 1e-7 * largest_size(solid));
  std::vector<glm::dvec3> normals;
  for (const Face& face : solid.faces) normals.push_back(unit_normal(solid, face));
  std::vector<std::uint32_t> set(solid.faces.size());
  const auto root = [&](std::uint32_t i) {
    while (set[i] != i) i = set[i] = set[set[i]];
    return i;
  };
  std::map<DirectedEdge, std::uint32_t> face_of;
  for (std::uint32_t f = 0; f < set.size(); ++f) set[f] = f;
  const auto each_edge = [&](std::uint32_t f, auto&& body) {
    for (const Loop& loop : loops_of(solid, solid.faces[f])) {
      for (std::uint32_t i = 0; i < loop.count; ++i)
        body(DirectedEdge{solid.corners[loop.first + i], solid.corners[loop.first + (i + 1) % loop.count]});
    }
  };
  for (std::uint32_t f = 0; f < set.size(); ++f)
    each_edge(f, [&](const DirectedEdge& e) { face_of.emplace(e, f); });
  for (std::uint32_t f = 0; f < set.size(); ++f) {
    each_edge(f, [&](const DirectedEdge& e) {
      const auto other = face_of.find({e.second, e.first});
      if (other == face_of.end() || other->second == f) return;
      const std::uint32_t g = other->second;
      if (solid.faces[f].tag != solid.faces[g].tag || solid.faces[f].tags != solid.faces[g].tags) return;
      if (glm::dot(normals[f], normals[g]) < 1 - 1e-6) return;
      const glm::dvec3 base = solid.points[solid.corners[solid.loops[solid.faces[root(f)].first_loop].first]];
      const glm::dvec3& n = normals[root(f)];
      bool is_flat = glm::dot(n, normals[g]) >= 1 - 1e-6;
      each_edge(g, [&](const DirectedEdge& own) {
        is_flat &= std::abs(glm::dot(solid.points[own.first] - base, n)) <= slack;
      });
      if (is_flat) set[root(g)] = root(f);
    });
  }
  Solid out;
  out.points = solid.points;
  out.is_closed = solid.is_closed;
  std::vector<std::vector<std::uint32_t>> members(set.size());
  for (std::uint32_t f = 0; f < set.size(); ++f) members[root(f)].push_back(f);
  for (std::uint32_t f = 0; f < set.size(); ++f) {
    if (members[f].empty()) continue;
    std::map<DirectedEdge, int> border;
    for (const std::uint32_t g : members[f]) {
      each_edge(g, [&](const DirectedEdge& e) {
        const auto back = border.find({e.second, e.first});
        if (back != border.end() && back->second > 0) {
          if (--back->second == 0) border.erase(back);
        } else {
          ++border[e];
        }
      });
    }
    std::vector<DirectedEdge> edges;
    for (const auto& [edge, count] : border) edges.insert(edges.end(), static_cast<std::size_t>(count), edge);
    const PlaneAxes plane(normals[f]);
    add_faces(out, solid.faces[f], loops_around(out, edges, plane), plane);
  }
  return out;
}

Solid without_straight_corners(const Solid& solid, double distance) {
  const double slack = std::max(distance, 1e-9 * largest_size(solid));
  std::vector<std::uint8_t> is_needed(solid.points.size(), 0);
  for (const Loop& loop : solid.loops) {
    const std::span<const std::uint32_t> points = points_of(solid, loop);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec3 p = solid.points[points[i]],
                       a = solid.points[points[(i + points.size() - 1) % points.size()]],
                       b = solid.points[points[(i + 1) % points.size()]];
      const glm::dvec3 along = math::unit(b - a, glm::dvec3(0));
      const bool is_straight = glm::length(glm::cross(along, p - a)) <= slack && glm::dot(along, p - a) > 0 &&
                               glm::dot(along, b - p) > 0;
      if (!is_straight) is_needed[points[i]] = 1;
    }
  }
  Solid out;
  out.points = solid.points;
  out.is_closed = solid.is_closed;
  for (const Face& face : solid.faces) {
    std::vector<std::vector<std::uint32_t>> loops;
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<std::uint32_t>& own = loops.emplace_back();
      for (const std::uint32_t point : points_of(solid, loop)) {
        if (is_needed[point] != 0) own.push_back(point);
      }
    }
    copy_face(out, face, loops);
  }
  return welded(out, 0);
}

Solid with_shared_corners(const Solid& solid, double distance, const Job& job) {
  Solid out;
  out.points = solid.points;
  out.is_closed = solid.is_closed;
  // Points by x, so that an edge looks only at those within its extent.
  std::vector<std::uint32_t> order(solid.points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return solid.points[i].x; });
  for (const Face& face : solid.faces) {
    job.check();
    std::vector<std::vector<std::uint32_t>> loops;
    for (const Loop& loop : loops_of(solid, face)) {
      std::vector<std::uint32_t>& own = loops.emplace_back();
      const std::span<const std::uint32_t> points = points_of(solid, loop);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t a = points[i], b = points[(i + 1) % points.size()];
        own.push_back(a);
        const glm::dvec3 &p = solid.points[a], &q = solid.points[b];
        const double length = glm::length(q - p);
        const glm::dvec3 along = math::unit(q - p, glm::dvec3(0));
        std::vector<std::pair<double, std::uint32_t>> on;
        const double low = std::min(p.x, q.x) - distance, high = std::max(p.x, q.x) + distance;
        auto at =
            std::ranges::lower_bound(order, low, {}, [&](std::uint32_t k) { return solid.points[k].x; });
        for (; at != order.end() && solid.points[*at].x <= high; ++at) {
          if (*at == a || *at == b) continue;
          const glm::dvec3 to = solid.points[*at] - p;
          const double s = glm::dot(to, along);
          if (s > distance && s < length - distance && glm::length(to - along * s) <= distance)
            on.emplace_back(s, *at);
        }
        std::ranges::sort(on);
        for (const auto& each : on) own.push_back(each.second);
      }
    }
    copy_face(out, face, loops);
  }
  return out;
}

}  // namespace seedmesh::building
