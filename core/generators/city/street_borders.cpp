// What closes the lots of houses against the streets around them.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "core/generators/city/house_box.h"
#include "core/generators/city/objects.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double behind = 0.3;  // the line of a building's front, m

using Side = std::pair<CmPoint, CmPoint>;

/// An edge of the outline of a lot.
struct Outline {
  dvec2 a{0}, b{0};  // metres
  bool is_street = false;

  dvec2 along() const { return (b - a) / glm::length(b - a); }
};

/// The edges of all streets, each from the lower to the higher corner, sorted.
std::vector<Side> street_sides(const CityPlan& plan, const Job& job) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < plan.parts.size(); ++i) {
    if (i % 1024 == 0) job.check();
    const Part& part = plan.parts[i];
    if (part.is_wall || (!is_street_space(part) && part.kind != PartKind::verge)) continue;
    for (const CmRing& ring : part.rings) {
      for (std::size_t k = 0; k < ring.size(); ++k)
        sides.emplace_back(std::minmax(ring[k], ring[(k + 1) % ring.size()]));
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// The outline of a lot; edges along streets in a row of nearly one direction are one.
std::vector<Outline> outline_of(const CmRing& ring, const std::vector<Side>& sides) {
  constexpr double straight = 0.02;  // sine of the turn
  std::vector<Outline> outline;
  const auto joins = [](const Outline& first, const Outline& second) {
    const dvec2 u = first.along(), v = second.along();
    return first.is_street && second.is_street && glm::dot(u, v) > 0 &&
           std::abs(u.x * v.y - u.y * v.x) < straight;
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const Outline edge{in_metres(a), in_metres(b),
                       std::binary_search(sides.begin(), sides.end(), Side(std::minmax(a, b)))};
    if (!outline.empty() && joins(outline.back(), edge)) {
      outline.back().b = edge.b;
    } else {
      outline.push_back(edge);
    }
  }
  if (outline.size() > 1 && joins(outline.back(), outline.front())) {
    outline.front().a = outline.back().a;
    outline.pop_back();
  }
  return outline;
}

/// Returns how much shorter than its edge a border is at the corner of two edges of an outline, so that it meets no
/// border along the other one. The border runs `inset` inside of the edge.
double shortened_by(const dvec2& along, const Outline& other, bool is_start, double half, double inset) {
  constexpr double gap = 0.01, right_angle = 0.02;
  const dvec2 next = other.along(), first = is_start ? next : along, second = is_start ? along : next;
  const double sine = first.x * second.y - first.y * second.x, cosine = glm::dot(first, second);
  if (other.is_street) {
    const double half_tangent = cosine < -0.99 ? 14.1 : sine / (1 + cosine);  // of the turn
    return inset * half_tangent + half * std::abs(half_tangent) + gap;
  }
  // Borders between lots begin 0.6 m from the corner.
  return sine > 0 && cosine < 0 - right_angle ? (half - cosine * (inset + half)) / sine + gap : gap;
}

/// Adds the borders along the streets beside and behind the house of a lot.
void add_street_sides(const CityPlan& plan, const Lot& lot, const std::vector<Side>& sides, double half,
                      std::vector<BorderPiece>& pieces) {
  constexpr double gap = 0.01, least = 0.3;  // m
  const double inset = half + gap / 2;
  const dvec2 start = in_metres(lot.front_start), run = in_metres(lot.front_end) - start;
  const dvec2 inward = dvec2(-run.y, run.x) / glm::length(run);
  const double front = glm::dot(lot.house->position - start, inward) - lot.house->depth / 2 + behind;
  const HouseBox house = box_of(*lot.house);
  const std::vector<Outline> outline = outline_of(plan.parts[lot.part].rings[0], sides);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Outline& edge = outline[i];
    if (!edge.is_street) continue;
    const dvec2 along = edge.along(), side(-along.y, along.x), origin = edge.a + side * inset;
    double from = shortened_by(along, outline[(i + outline.size() - 1) % outline.size()], true, half, inset),
           to = glm::length(edge.b - edge.a) -
                shortened_by(along, outline[(i + 1) % outline.size()], false, half, inset);
    // The border begins behind that of the front.
    const double rise = glm::dot(along, inward),
                 wanted = front + half + gap + half * std::abs(glm::dot(side, inward)),
                 depth = glm::dot(origin - start, inward);
    if (std::abs(rise) < 1e-6) {
      if (depth < wanted) continue;
    } else if (rise > 0) {
      from = std::max(from, (wanted - depth) / rise);
    } else {
      to = std::min(to, (wanted - depth) / rise);
    }
    if (to - from < least) continue;
    const dvec2 a = origin + along * from, b = origin + along * to;
    const auto taken = covered(house, a, b);
    const auto add = [&](double first, double last) {
      if ((last - first) * (to - from) >= least)
        pieces.push_back({a + (b - a) * first, a + (b - a) * last, lot.part});
    };
    add(0, taken ? (*taken)[0] : 1);
    if (taken) add((*taken)[1], 1);
  }
}

/// Adds borders along the front of a lot, on both sides of its house.
void add_front(const CityPlan& plan, const Lot& lot, std::vector<BorderPiece>& pieces) {
  constexpr double gap = 0.02, least = 0.2;  // m
  const dvec2 start = in_metres(lot.front_start), run = in_metres(lot.front_end) - start;
  const dvec2 along = run / glm::length(run), inward(-along.y, along.x);
  const House& house = *lot.house;
  const double front = glm::dot(house.position - start, inward) - house.depth / 2 + behind;
  const double middle = glm::dot(house.position - start, along), half = house.width / 2 + gap;
  double low = -1e9, high = 1e9;  // of the lot along the line
  for (const CmRing& ring : plan.parts[lot.part].rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = in_metres(ring[i]) - start, b = in_metres(ring[(i + 1) % ring.size()]) - start;
      const double from = glm::dot(a, inward) - front, to = glm::dot(b, inward) - front;
      if ((from > 0) == (to > 0)) continue;
      const double at = glm::dot(a + (b - a) * (from / (from - to)), along);
      if (at < middle) {
        low = std::max(low, at);
      } else {
        high = std::min(high, at);
      }
    }
  }
  if (low < -1e8 || high > 1e8) return;
  const dvec2 origin = start + inward * front;
  const auto add = [&](double from, double to) {
    if (to - from >= least) pieces.push_back({origin + along * from, origin + along * to, lot.part});
  };
  add(low + gap, middle - half);
  add(middle + half, high - gap);
}

}  // namespace

std::optional<std::array<double, 2>> covered(const HouseBox& house, const dvec2& a, const dvec2& b) {
  constexpr double clearance = 0.4;  // m
  std::array<double, 2> range = {0, 1};
  const dvec2 half = house.half + clearance;
  for (const int axis : {0, 1}) {
    const dvec2& direction = axis == 0 ? house.x : house.y;
    const double from = glm::dot(a - house.centre, direction), run = glm::dot(b - a, direction),
                 reach = half[axis];
    if (std::abs(run) < 1e-9) {
      if (std::abs(from) >= reach) return std::nullopt;
      continue;
    }
    const double first = (-reach - from) / run, second = (reach - from) / run;
    range[0] = std::max(range[0], std::min(first, second));
    range[1] = std::min(range[1], std::max(first, second));
  }
  if (range[0] >= range[1]) return std::nullopt;
  return range;
}

std::vector<BorderPiece> front_borders(const CityPlan& plan, const Job& job) {
  std::vector<BorderPiece> pieces;
  for (std::size_t i = 0; i < plan.lots.size(); ++i) {
    if (i % 1024 == 0) job.check();
    if (plan.lots[i].house) add_front(plan, plan.lots[i], pieces);
  }
  return pieces;
}

void end_beside(std::vector<BorderPiece>& fronts, const std::vector<BorderPiece>& between,
                double half_width) {
  constexpr double gap = 0.01;
  std::multimap<std::uint32_t, std::uint32_t> by_part;
  for (std::uint32_t i = 0; i < between.size(); ++i) {
    by_part.emplace(between[i].part, i);
    if (between[i].other != no_index) by_part.emplace(between[i].other, i);
  }
  for (BorderPiece& front : fronts) {
    const dvec2 along = (front.b - front.a) / glm::length(front.b - front.a);
    const auto [begin, end] = by_part.equal_range(front.part);
    const auto is_in_border = [&, first = begin, last = end](const dvec2& p) {
      return std::any_of(first, last, [&](const auto& each) {
        const BorderPiece& piece = between[each.second];
        return distance_to_segment(p, piece.a, piece.b) < half_width;
      });
    };
    const bool at_start = is_in_border(front.a), at_end = is_in_border(front.b);
    if (at_start) front.a += along * (half_width + gap);
    if (at_end) front.b -= along * (half_width + gap);
    if (glm::dot(front.b - front.a, along) <= gap) front.b = front.a;
  }
  std::erase_if(fronts, [](const BorderPiece& each) { return each.a == each.b; });
}

std::vector<BorderPiece> side_street_borders(const CityPlan& plan, double half_width, const Job& job) {
  std::vector<BorderPiece> pieces;
  const std::vector<Side> sides = street_sides(plan, job);
  for (std::size_t i = 0; i < plan.lots.size(); ++i) {
    if (i % 1024 == 0) job.check();
    if (plan.lots[i].house) add_street_sides(plan, plan.lots[i], sides, half_width, pieces);
  }
  return pieces;
}

}  // namespace seedmesh::city
