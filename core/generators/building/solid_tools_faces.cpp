/// Triangles, convex faces and extrusions; see solid_tools.h.
#include <algorithm>
#include <array>
#include <map>

#include "core/generators/building/solid_faces.h"
#include "core/generators/building/solid_tools.h"
#include "core/geom/polygon/triangulate.h"

namespace seedmesh::building {

std::vector<std::uint32_t> triangles_of(const Solid& solid, const Face& face, const Job& job) {
  const PlaneAxes plane(unit_normal(solid, face));
  std::vector<glm::dvec2> points;
  std::vector<std::uint32_t> numbers, sizes;
  for (const Loop& loop : loops_of(solid, face)) {
    sizes.push_back(loop.count);
    for (const std::uint32_t point : points_of(solid, loop)) {
      points.push_back(plane.flat(solid.points[point]));
      numbers.push_back(point);
    }
  }
  Triangulator triangulator(&job);
  std::vector<std::uint32_t> out;
  for (const std::uint32_t corner : triangulator.run(points, sizes, 0)) out.push_back(numbers[corner]);
  return out;
}

Solid convex_faces(const Solid& solid, const Job& job) {
  Solid out;
  out.points = solid.points;
  out.is_closed = solid.is_closed;
  for (const Face& face : solid.faces) {
    const glm::dvec3 n = unit_normal(solid, face);
    const std::vector<std::uint32_t> triangles = triangles_of(solid, face, job);
    std::vector<std::vector<std::uint32_t>> pieces;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
      pieces.push_back({triangles[t], triangles[t + 1], triangles[t + 2]});
    const auto is_convex_at = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const glm::dvec3 in = solid.points[b] - solid.points[a], on = solid.points[c] - solid.points[b];
      return glm::dot(glm::cross(in, on), n) >= -1e-12 * glm::length(in) * glm::length(on);
    };
    std::map<DirectedEdge, std::size_t> piece_of;
    const auto enter = [&](std::size_t k) {
      for (std::size_t i = 0; i < pieces[k].size(); ++i)
        piece_of[{pieces[k][i], pieces[k][(i + 1) % pieces[k].size()]}] = k;
    };
    for (std::size_t k = 0; k < pieces.size(); ++k) enter(k);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      if (k % 64 == 0) job.check();
      for (std::size_t i = 0; i < pieces[k].size();) {
        std::vector<std::uint32_t>& own = pieces[k];
        const std::uint32_t a = own[i], b = own[(i + 1) % own.size()];
        const auto found = piece_of.find({b, a});
        if (found == piece_of.end() || found->second <= k || pieces[found->second].empty()) {
          ++i;
          continue;
        }
        const std::vector<std::uint32_t>& other = pieces[found->second];
        const std::size_t at = static_cast<std::size_t>(std::ranges::find(other, a) - other.begin());
        // `other` runs from b to a; behind a come the corners that are not on this edge.
        const std::uint32_t before = own[(i + own.size() - 1) % own.size()],
                            behind = own[(i + 2) % own.size()];
        const std::uint32_t next = other[(at + 1) % other.size()],
                            last = other[(at + other.size() - 2) % other.size()];
        if (!is_convex_at(before, a, next) || !is_convex_at(last, b, behind)) {
          ++i;
          continue;
        }
        std::vector<std::uint32_t> more;
        for (std::size_t c = 1; c + 1 < other.size(); ++c) more.push_back(other[(at + c) % other.size()]);
        own.insert(own.begin() + static_cast<std::ptrdiff_t>(i) + 1, more.begin(), more.end());
        pieces[found->second].clear();
        enter(k);
        i = 0;
      }
    }
    for (const auto& piece : pieces) copy_face(out, face, {piece});
  }
  return out;
}

Solid extruded_by(const Solid& faces, std::span<const glm::dvec3> by) {
  Solid out;
  const auto count = static_cast<std::uint32_t>(faces.points.size());
  out.points = faces.points;
  for (std::uint32_t i = 0; i < count; ++i) out.points.push_back(faces.points[i] + by[i]);
  std::map<DirectedEdge, int> uses;
  for (const Face& face : faces.faces) {
    std::vector<std::vector<std::uint32_t>> low, high;
    for (const Loop& loop : loops_of(faces, face)) {
      const std::span<const std::uint32_t> points = points_of(faces, loop);
      low.emplace_back(points.rbegin(), points.rend());
      std::vector<std::uint32_t>& top = high.emplace_back(points.begin(), points.end());
      for (std::uint32_t& point : top) point += count;
      for (std::size_t i = 0; i < points.size(); ++i) ++uses[{points[i], points[(i + 1) % points.size()]}];
    }
    copy_face(out, face, low);
    copy_face(out, face, high);
  }
  for (const Face& face : faces.faces) {
    for (const Loop& loop : loops_of(faces, face)) {
      const std::span<const std::uint32_t> points = points_of(faces, loop);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t a = points[i], b = points[(i + 1) % points.size()];
        if (uses.contains({b, a})) continue;
        add_face(out, std::array{a, b, b + count, a + count});
      }
    }
  }
  out.is_closed = is_watertight(out);
  return out;
}

bool is_watertight(const Solid& solid) {
  std::map<DirectedEdge, int> uses;
  for (const Loop& loop : solid.loops) {
    const std::span<const std::uint32_t> points = points_of(solid, loop);
    for (std::size_t i = 0; i < points.size(); ++i) ++uses[{points[i], points[(i + 1) % points.size()]}];
  }
  return !uses.empty() && std::ranges::all_of(uses, [&](const auto& each) {
    const auto back = uses.find({each.first.second, each.first.first});
    return back != uses.end() && back->second == each.second;
  });
}

}  // namespace seedmesh::building
