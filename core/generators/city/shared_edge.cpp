#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

#include "core/generators/city/division.h"

namespace seedmesh::city {

using glm::dvec2;

void SharedEdge::append_between(const CmPoint& from, const CmPoint& to, CmRing& ring) const {
  if (added.empty()) return;
  const dvec2 origin = in_cm(from), along = in_cm(to) - origin;
  const double length2 = glm::dot(along, along);
  // Most edges have few corners, which need no memory.
  using Found = std::pair<double, CmPoint>;
  constexpr std::size_t few = 8;
  std::array<Found, few> own;
  std::vector<Found> more(added.size() > few ? added.size() : 0);
  const std::span<Found> found = added.size() > few ? std::span(more) : std::span(own);
  std::size_t count = 0;
  for (const CmPoint& p : added) {
    const double share = glm::dot(in_cm(p) - origin, along) / length2;
    if (share > 0 && share < 1 && p != from && p != to) found[count++] = {share, p};
  }
  std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || found[i].second != found[i - 1].second) ring.push_back(found[i].second);
  }
}

}  // namespace seedmesh::city
