/// Cuts a solid by a plane across an axis. Each loop leaves chains of corners on the kept side. Along the
/// line where the plane meets a face, chains leave and enter alternately. Sorted along this line, each end is
/// joined with the next start (the rule of Weiler and Atherton for a straight clip edge).
#include <algorithm>
#include <cmath>
#include <map>

#include "core/generators/building/solid.h"

namespace seedmesh::building {
namespace {

constexpr double on_plane = 1e-10;  ///< of the unit cube

class Clipper {
 public:
  Clipper(const Solid& in, int axis, double at, double sign) : in_(in), axis_(axis), at_(at), sign_(sign) {
    out_.is_closed = in.is_closed;
    place_.assign(in.points.size(), unplaced);
  }

  Solid run() {
    for (const Face& face : in_.faces) clip(face);
    if (in_.is_closed) cap();
    return std::move(out_);
  }

 private:
  static constexpr std::uint32_t unplaced = 0xFFFFFFFFU;

  /// Corners on the kept side from an entry to an exit; both ends lie on the plane.
  struct Chain {
    std::vector<std::uint32_t> corners;
    bool is_used = false;
  };
  struct End {
    double along = 0;
    std::size_t chain = 0;
    bool leaves = false;
  };

  double height(std::uint32_t point) const { return sign_ * (in_.points[point][axis_] - at_); }
  bool is_kept(std::uint32_t point) const { return height(point) < -on_plane; }

  std::uint32_t keep(std::uint32_t point) {
    if (place_[point] == unplaced) {
      place_[point] = static_cast<std::uint32_t>(out_.points.size());
      out_.points.push_back(in_.points[point]);
    }
    return place_[point];
  }

  /// Where the edge between a kept and an unkept point meets the plane.
  std::uint32_t crossing(std::uint32_t kept, std::uint32_t gone) {
    if (height(gone) <= on_plane) {
      const std::uint32_t at = keep(gone);
      out_.points[at][axis_] = at_;
      return at;
    }
    const std::uint64_t key = static_cast<std::uint64_t>(std::min(kept, gone)) << 32U | std::max(kept, gone);
    const auto [found, is_new] = crossings_.try_emplace(key, static_cast<std::uint32_t>(out_.points.size()));
    if (is_new) {
      const double a = height(kept), b = height(gone);
      glm::dvec3 p = in_.points[kept] + (in_.points[gone] - in_.points[kept]) * (a / (a - b));
      p[axis_] = at_;
      out_.points.push_back(p);
    }
    return found->second;
  }

  void clip(const Face& face) {
    std::vector<std::vector<std::uint32_t>> whole;
    std::vector<Chain> chains;
    for (std::uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l)
      walk(in_.loops[l], whole, chains);
    if (chains.empty()) {
      // If the plane passes between a hole and the outer loop, only the hole remains, and so no face.
      if (whole.empty() || !is_kept(in_.corners[in_.loops[face.first_loop].first])) return;
      add(whole, face.is_round);
      return;
    }
    const glm::dvec3 normal = area_vector(in_, face, glm::dvec3(1));
    glm::dvec3 a(0);
    a[axis_] = sign_;
    const glm::dvec3 along = glm::cross(normal, a);
    std::vector<End> ends;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      ends.push_back({glm::dot(along, out_.points[chains[c].corners.front()]), c, false});
      ends.push_back({glm::dot(along, out_.points[chains[c].corners.back()]), c, true});
    }
    std::ranges::stable_sort(ends, [](const End& x, const End& y) { return x.along < y.along; });
    // The chain that continues where this one leaves.
    std::vector<std::size_t> next(chains.size(), chains.size());
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      const End& leave = ends[i].leaves ? ends[i] : ends[i + 1];
      const End& enter = ends[i].leaves ? ends[i + 1] : ends[i];
      if (!leave.leaves || enter.leaves) continue;
      next[leave.chain] = enter.chain;
    }
    std::vector<std::vector<std::uint32_t>> outers;
    for (std::size_t c = 0; c < chains.size(); ++c) {
      if (chains[c].is_used) continue;
      std::vector<std::uint32_t> loop;
      std::size_t k = c;
      while (k < chains.size() && !chains[k].is_used) {
        chains[k].is_used = true;
        loop.insert(loop.end(), chains[k].corners.begin(), chains[k].corners.end());
        const std::size_t to = next[k];
        if (to < chains.size()) cuts_.emplace_back(chains[k].corners.back(), chains[to].corners.front());
        k = to;
      }
      outers.push_back(std::move(loop));
    }
    make_faces(std::move(outers), std::move(whole), normal, face);
  }

  void walk(const Loop& loop, std::vector<std::vector<std::uint32_t>>& whole, std::vector<Chain>& chains) {
    std::uint32_t start = loop.count;
    for (std::uint32_t i = 0; i < loop.count; ++i) {
      if (!is_kept(corner(loop, i)) && is_kept(corner(loop, i + 1))) {
        start = i;
        break;
      }
    }
    if (start == loop.count) {
      if (!is_kept(corner(loop, 0))) return;
      std::vector<std::uint32_t>& all = whole.emplace_back();
      for (std::uint32_t i = 0; i < loop.count; ++i) all.push_back(keep(corner(loop, i)));
      return;
    }
    for (std::uint32_t i = start; i < start + loop.count; ++i) {
      const std::uint32_t p = corner(loop, i), q = corner(loop, i + 1);
      if (!is_kept(p) && is_kept(q)) {
        chains.emplace_back().corners.push_back(crossing(q, p));
      } else if (is_kept(p)) {
        chains.back().corners.push_back(keep(p));
        if (!is_kept(q)) chains.back().corners.push_back(crossing(p, q));
      }
    }
  }

  std::uint32_t corner(const Loop& loop, std::uint32_t i) const {
    return in_.corners[loop.first + i % loop.count];
  }

  /// Joins equal neighbours; false if no area remains.
  static bool tidy(std::vector<std::uint32_t>& loop) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    return loop.size() >= 3;
  }

  double doubled_area(const std::vector<std::uint32_t>& loop, const glm::dvec3& normal) const {
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sum += glm::cross(out_.points[loop[i]] - out_.points[loop[0]],
                        out_.points[loop[(i + 1) % loop.size()]] - out_.points[loop[0]]);
    }
    return glm::dot(sum, normal) / std::max(glm::length(normal), 1e-300);
  }

  bool is_inside_loop(const std::vector<std::uint32_t>& loop, const glm::dvec3& p, const glm::dvec3& normal) {
    const auto first = static_cast<std::uint32_t>(out_.corners.size());
    out_.corners.insert(out_.corners.end(), loop.begin(), loop.end());
    const Loop probe{first, static_cast<std::uint32_t>(loop.size())};
    const bool inside = is_inside(out_, std::span(&probe, 1), normal, p);
    out_.corners.resize(first);
    return inside;
  }

  /// Makes faces of loops of either direction: each hole goes to the outer loop around it.
  void make_faces(std::vector<std::vector<std::uint32_t>> loops, std::vector<std::vector<std::uint32_t>> more,
                  const glm::dvec3& normal, const Face& face) {
    loops.insert(loops.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    std::vector<std::vector<std::vector<std::uint32_t>>> groups;
    std::vector<std::vector<std::uint32_t>> holes;
    for (auto& loop : loops) {
      if (!tidy(loop)) continue;
      const double area = doubled_area(loop, normal);
      if (std::abs(area) < 1e-14) continue;
      if (area > 0) {
        groups.push_back({std::move(loop)});
      } else {
        holes.push_back(std::move(loop));
      }
    }
    for (auto& hole : holes) {
      for (auto& group : groups) {
        if (groups.size() > 1 && !is_inside_loop(group.front(), out_.points[hole.front()], normal)) continue;
        group.push_back(std::move(hole));
        break;
      }
    }
    for (const auto& group : groups) add(group, face.is_round);
  }

  void add(const std::vector<std::vector<std::uint32_t>>& loops, bool is_round) {
    Face face{static_cast<std::uint32_t>(out_.loops.size()), static_cast<std::uint32_t>(loops.size()),
              is_round};
    for (const auto& loop : loops) add_loop(out_, loop);
    out_.faces.push_back(face);
  }

  /// Adds caps, whose borders are the reversed cut segments.
  void cap() {
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const std::pair<std::uint32_t, std::uint32_t>& cut : cuts_) {
      const std::uint32_t from = cut.first, to = cut.second;
      if (from == to) continue;
      // A face in the plane has the same edge in the other direction; the two cancel.
      const auto range = next.equal_range(from);
      const auto back =
          std::find_if(range.first, range.second, [&](const auto& each) { return each.second == to; });
      if (back != range.second) {
        next.erase(back);
      } else {
        next.emplace(to, from);
      }
    }
    std::vector<std::vector<std::uint32_t>> loops;
    while (!next.empty()) {
      std::vector<std::uint32_t>& loop = loops.emplace_back();
      std::uint32_t at = next.begin()->first;
      const std::uint32_t start = at;
      do {
        const auto step = next.find(at);
        if (step == next.end()) break;
        loop.push_back(at);
        at = step->second;
        next.erase(step);
      } while (at != start);
    }
    glm::dvec3 normal(0);
    normal[axis_] = sign_;
    make_faces(std::move(loops), {}, normal, Face{});
  }

  const Solid& in_;
  int axis_;
  double at_, sign_;
  Solid out_;
  std::vector<std::uint32_t> place_;
  std::map<std::uint64_t, std::uint32_t> crossings_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts_;
};

}  // namespace

Solid clipped(const Solid& solid, int axis, double at, double sign) {
  return Clipper(solid, axis, at, sign).run();
}

}  // namespace seedmesh::building
