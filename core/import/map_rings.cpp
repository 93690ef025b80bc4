#include "core/import/map_rings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/import/map_crossings.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Metres.
constexpr double straight = 0.002, near_point = 0.002, gap = 0.01;
// Square metres: less is no outline.
constexpr double least_area = 0.01;
// Attempts to make holes fit.
constexpr int most_rounds = 8;

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

double rounded(double metres) { return std::floor(metres * 1000 + 0.5) / 1000; }

/// Whether the ring needs the point `p` between two others: it is neither one of them, nor on their edge, nor the end
/// of a spike.
bool is_corner(const dvec2& before, const dvec2& p, const dvec2& after) {
  const dvec2 a = p - before, b = after - p, whole = after - before;
  if (glm::length(a) < near_point) return false;
  const double twice = std::abs(cross(a, b));
  const double longest = std::max({glm::length(a), glm::length(b), glm::length(whole)});
  return twice > straight * longest;
}

PlanRing clean(const PlanRing& ring) {
  PlanRing points;
  for (const dvec2& p : ring) points.emplace_back(rounded(p.x), rounded(p.y));
  // Each pass can make new straight corners; a pass that removes nothing ends the work.
  for (std::size_t before = 0; before != points.size() && points.size() >= 3;) {
    before = points.size();
    PlanRing kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const dvec2 last = kept.empty() ? points.back() : kept.back();
      const dvec2& next =
          i + 1 < points.size() || kept.empty() ? points[(i + 1) % points.size()] : kept.front();
      if (is_corner(last, points[i], next)) kept.push_back(points[i]);
    }
    points = std::move(kept);
  }
  return points;
}

/// The simple loops of a ring that visits points twice.
std::vector<PlanRing> loops_of(const PlanRing& ring) {
  const auto key = [](const dvec2& p) { return std::pair{p.x, p.y}; };
  std::vector<PlanRing> loops;
  PlanRing path;
  std::map<std::pair<double, double>, std::size_t> at;
  for (const dvec2& p : ring) {
    const auto known = at.find(key(p));
    if (known == at.end()) {
      at.emplace(key(p), path.size());
      path.push_back(p);
      continue;
    }
    const std::size_t first = known->second;
    PlanRing loop(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    for (std::size_t i = first + 1; i < path.size(); ++i) at.erase(key(path[i]));
    path.resize(first + 1);
    loops.push_back(std::move(loop));
  }
  loops.push_back(std::move(path));
  std::vector<PlanRing> kept;
  for (const PlanRing& loop : loops) {
    PlanRing whole = clean(loop);
    if (whole.size() >= 3 && std::abs(signed_area(whole)) >= least_area) kept.push_back(std::move(whole));
  }
  return kept;
}

/// The ring with all points nearer to its middle by about `gap`.
PlanRing shrunk(const PlanRing& ring) {
  const dvec2 middle = centroid_of(ring);
  PlanRing made;
  for (const dvec2& p : ring) {
    const double length = glm::length(p - middle);
    const dvec2 q = length > 2 * gap ? p - (p - middle) * (gap / length) : p;
    made.emplace_back(rounded(q.x), rounded(q.y));
  }
  return clean(made);
}

/// The loops of a ring that crosses itself, divided at its crossings. Rounding can make new crossings.
std::vector<PlanRing> divided(const PlanRing& ring, const Job* job) {
  constexpr int most_passes = 3;
  std::vector<PlanRing> loops{ring};
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<PlanRing> next;
    for (const PlanRing& loop : loops) {
      for (PlanRing& part : loops_of(with_crossings(loop, job))) next.push_back(std::move(part));
    }
    const bool is_done = next.size() == loops.size();
    loops = std::move(next);
    if (is_done) break;
  }
  return loops;
}

/// The largest loop around loop `i`; the number of loops without one. Loops touch one another in points at most.
std::size_t loop_around(const std::vector<PlanRing>& loops, std::size_t i) {
  std::size_t best = loops.size();
  double largest = std::abs(signed_area(loops[i]));
  for (std::size_t k = 0; k < loops.size(); ++k) {
    const double size = std::abs(signed_area(loops[k]));
    if (k == i || size <= largest) continue;
    const Plan other{{loops[k]}};
    if (!std::all_of(loops[i].begin(), loops[i].end(), [&](const dvec2& p) { return contains(other, p); }))
      continue;
    best = k;
    largest = size;
  }
  return best;
}

bool has_errors(const Plan& plan, const Job* job) { return !defects_of(plan, job).empty(); }

/// Adds the holes that lie in the outer ring. Those with errors become smaller, and are left out if that does not help.
Plan with_holes(PlanRing outer, const std::vector<PlanRing>& holes, const Job* job, ValidPlans& made) {
  Plan plan = read_plan({std::move(outer)});
  Plan alone = plan;
  for (const PlanRing& hole : holes) {
    if (contains(alone, centroid_of(hole)) || contains(alone, hole[0])) plan.rings.push_back(hole);
  }
  std::vector<bool> is_shrunk(plan.rings.size(), false);
  for (int round = 0; round < most_rounds && plan.rings.size() > 1; ++round) {
    plan = read_plan(std::move(plan.rings));
    std::vector<bool> has_error(plan.rings.size(), false);
    for (const PlanDefect& defect : defects_of(plan, job)) {
      // The second of two rings that meet is named; the first can be the outer ring.
      if (defect.ring > 0) has_error[defect.ring] = true;
    }
    if (std::find(has_error.begin(), has_error.end(), true) == has_error.end()) break;
    std::vector<PlanRing> kept{plan.rings[0]};
    std::vector<bool> kept_shrunk{false};
    for (std::size_t r = 1; r < plan.rings.size(); ++r) {
      PlanRing ring = has_error[r] && !is_shrunk[r] ? shrunk(plan.rings[r]) : plan.rings[r];
      if ((has_error[r] && is_shrunk[r]) || ring.size() < 3) {
        ++made.lost_holes;
        continue;
      }
      kept.push_back(std::move(ring));
      kept_shrunk.push_back(is_shrunk[r] || has_error[r]);
    }
    plan.rings = std::move(kept);
    is_shrunk = std::move(kept_shrunk);
  }
  plan = read_plan(std::move(plan.rings));
  if (!has_errors(plan, job)) return plan;
  made.lost_holes += plan.rings.size() - 1;
  return alone;
}

}  // namespace

ValidPlans valid_plans(const std::vector<PlanRing>& rings, const Job* job) {
  ValidPlans made;
  if (rings.empty()) return made;
  const PlanRing whole = clean(rings[0]);
  std::vector<PlanRing> loops, found = loops_of(whole);
  if (found.empty()) {  // the loops of a ring that crosses itself can cancel out
    found = divided(whole, job);
    made.is_divided = !found.empty();
  }
  for (PlanRing& loop : found) {
    if (!has_errors(read_plan({loop}), job)) {
      loops.push_back(std::move(loop));
      continue;
    }
    made.is_divided = true;
    for (PlanRing& part : divided(loop, job)) {
      if (has_errors(read_plan({part}), job)) {
        made.has_crossing = true;
      } else {
        loops.push_back(std::move(part));
      }
    }
  }
  std::vector<PlanRing> outer, holes;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const std::size_t around = loop_around(loops, i);
    if (around == loops.size()) {
      outer.push_back(loops[i]);
    } else if ((signed_area(loops[i]) > 0) != (signed_area(loops[around]) > 0)) {
      holes.push_back(loops[i]);
    }
  }
  for (std::size_t i = 1; i < rings.size(); ++i) {
    for (PlanRing& loop : loops_of(clean(rings[i]))) holes.push_back(std::move(loop));
  }
  for (PlanRing& loop : outer) made.plans.push_back(with_holes(std::move(loop), holes, job, made));
  return made;
}

std::vector<std::vector<dvec2>> joined_rings(std::vector<std::vector<dvec2>> lines, std::size_t& open) {
  const auto key = [](const dvec2& p) { return std::pair{p.x, p.y}; };
  std::multimap<std::pair<double, double>, std::size_t> ends;
  std::vector<bool> is_used(lines.size(), false);
  std::vector<std::vector<dvec2>> rings;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].size() > 2 && lines[i].front() == lines[i].back()) continue;
    if (lines[i].size() < 2) continue;
    ends.emplace(key(lines[i].front()), i);
    ends.emplace(key(lines[i].back()), i);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_used[i] || lines[i].size() < 2) continue;
    is_used[i] = true;
    std::vector<dvec2> ring = lines[i];
    while (ring.front() != ring.back() || ring.size() < 3) {
      auto [next, last] = ends.equal_range(key(ring.back()));
      while (next != last && is_used[next->second]) next = ends.erase(next);
      if (next == last) break;
      const std::size_t number = next->second;
      ends.erase(next);
      is_used[number] = true;
      std::vector<dvec2> more = lines[number];
      if (more.front() != ring.back()) std::reverse(more.begin(), more.end());
      ring.insert(ring.end(), more.begin() + 1, more.end());
    }
    if (ring.front() != ring.back()) {
      ++open;
      continue;
    }
    ring.pop_back();
    if (ring.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace seedmesh
