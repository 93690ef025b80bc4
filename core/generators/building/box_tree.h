#pragma once
/// A tree of axis-aligned boxes, for searches of what is near.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seedmesh::building {

struct WorldBox {
  glm::dvec3 low{0}, high{0};
};

/// Each node halves its boxes along the longest axis, by their middles. Cost: n log² n to build.
class BoxTree {
 public:
  explicit BoxTree(std::span<const WorldBox> boxes);

  /// Returns the numbers of the boxes that meet or touch this one, rising. Cost: log n and the boxes found.
  std::vector<std::uint32_t> meeting(const WorldBox& box) const;

 private:
  struct Node {
    WorldBox box;
    std::uint32_t first = 0, count = 0;  ///< into order_; of a leaf
    std::uint32_t child = 0;             ///< the first of two neighbours; 0: a leaf
  };
  void divide(std::uint32_t node);

  std::vector<WorldBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace seedmesh::building
