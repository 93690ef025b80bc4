#include "core/generators/building/box_tree.h"

#include <algorithm>
#include <numeric>

namespace seedmesh::building {
namespace {

constexpr std::uint32_t most_in_leaf = 4;

bool meets(const WorldBox& a, const WorldBox& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis]) return false;
  }
  return true;
}

}  // namespace

BoxTree::BoxTree(std::span<const WorldBox> boxes) : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size()), 0});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) divide(node);
}

void BoxTree::divide(std::uint32_t node) {
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
  WorldBox all{glm::dvec3(1e300), glm::dvec3(-1e300)}, middles = all;
  const auto middle_of = [&](std::uint32_t i) { return 0.5 * (boxes_[i].low + boxes_[i].high); };
  for (std::uint32_t i = first; i < first + count; ++i) {
    all.low = glm::min(all.low, boxes_[order_[i]].low);
    all.high = glm::max(all.high, boxes_[order_[i]].high);
    middles.low = glm::min(middles.low, middle_of(order_[i]));
    middles.high = glm::max(middles.high, middle_of(order_[i]));
  }
  nodes_[node].box = all;
  if (count <= most_in_leaf) return;
  const glm::dvec3 extent = middles.high - middles.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(count), [&](std::uint32_t a, std::uint32_t b) {
                     const double at = middle_of(a)[axis], other = middle_of(b)[axis];
                     return at != other ? at < other : a < b;
                   });
  nodes_[node].child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({{}, first, half, 0});
  nodes_.push_back({{}, first + half, count - half, 0});
}

std::vector<std::uint32_t> BoxTree::meeting(const WorldBox& box) const {
  std::vector<std::uint32_t> found, open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!meets(node.box, box)) continue;
    if (node.child != 0) {
      open.push_back(node.child);
      open.push_back(node.child + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (meets(boxes_[order_[i]], box)) found.push_back(order_[i]);
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace seedmesh::building
