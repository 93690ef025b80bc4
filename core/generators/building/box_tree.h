#pragma once
/// A bounding volume hierarchy of axis-aligned boxes, which finds the boxes that intersect another.
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace seedmesh::building {

struct WorldBox {
  glm::dvec3 low{0}, high{0};
};

/// Each node divides its boxes into halves, ordered by their centres along the longest axis. Cost: n log n
/// to build, on average.
class BoxTree {
 public:
  explicit BoxTree(std::span<const WorldBox> boxes);

  /// Returns the indices of the boxes that intersect or touch `box`, in ascending order. Cost: about log n
  /// for each box found.
  std::vector<std::uint32_t> meeting(const WorldBox& box) const;

 private:
  struct Node {
    WorldBox box;
    std::uint32_t first = 0, count = 0;  ///< range of order_, if the node is a leaf
    std::uint32_t child = 0;             ///< index of the first of two adjacent children; 0: a leaf
  };
  void divide(std::uint32_t node);

  std::vector<WorldBox> boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace seedmesh::building
