#pragma once
/// A planar straight-line graph on whole centimetres. Segments are added one by one, and wherever two of them meet
/// there is a node. All decisions are exact. Crossings are rounded to the nearest centimetre. Segments that pass
/// within 0.71 cm of a node run through it, so that rounding creates no new crossing. This is the snap rounding of
/// Hobby, "Practical segment intersection with finite precision output", 1999, but segments are inserted one at a
/// time.
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/job.h"
#include "core/geom/polygon/cm_point.h"

namespace seedmesh {

struct PlanarEdge {
  static constexpr std::uint32_t removed = 0xFFFFFFFFU;
  std::uint32_t from = 0, to = 0;  ///< nodes; both `removed` if the edge was split or removed
  std::uint32_t tag = 0;           ///< tag of the caller
  bool is_removed() const { return from == removed; }
};

class PlanarGraph {
 public:
  /// `cell` is the side of the squares of the search grid: about the length of an edge, in centimetres.
  explicit PlanarGraph(std::int32_t cell = 5000) : cell_(cell) {}

  /// Adds a segment. Pieces that coincide with an edge keep that edge and its tag. The order of insertion
  /// matters where crossings are rounded. Cost: about 1 us, and a test of each edge in the cells that it touches.
  void add(const CmPoint& a, const CmPoint& b, std::uint32_t tag);

  /// Returns the number of the node at a point; a new node splits the edges that it lies on.
  std::uint32_t node_at(const CmPoint& p);

  void remove(std::uint32_t edge);

  const std::vector<CmPoint>& nodes() const { return nodes_; }
  /// Edges that were split or removed stay in the list; their is_removed() is true.
  const std::vector<PlanarEdge>& edges() const { return edges_; }

 private:
  struct Piece {
    CmPoint a, b;
    std::uint32_t tag;
  };
  struct Cell {
    std::vector<std::uint32_t> nodes, edges;
  };
  template <class Visit>
  void visit_cells(const CmPoint& a, const CmPoint& b, const Visit& visit) const;
  void insert(const Piece& piece);
  bool route_through_node(const Piece& piece);
  bool split_at_crossing(const Piece& piece);
  void add_edge(const Piece& piece);
  std::uint32_t add_node(const CmPoint& p);
  void split_edges_at(const CmPoint& p);
  void split(std::uint32_t edge, const CmPoint& p);
  void run();

  std::int32_t cell_;
  std::vector<CmPoint> nodes_;
  std::vector<PlanarEdge> edges_;
  std::unordered_map<std::uint64_t, Cell> cells_;  ///< never iterated
  std::vector<Piece> pending_;
};

/// The faces of a planar graph. Half-edge 2 e runs along edge e and 2 e + 1 against it; the face of a half-edge
/// is to its left.
struct PlanarFaces {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  /// A closed walk of half-edges. A dead end is passed on both sides.
  struct Loop {
    std::uint32_t first = 0, count = 0;  ///< range in `half_edges`
    std::int64_t doubled_area = 0;       ///< positive: the outer loop of a face
    std::uint32_t face = none;           ///< none: the unbounded region
  };
  struct Face {
    std::uint32_t outer = none;        ///< loop
    std::vector<std::uint32_t> holes;  ///< loops of components inside
  };
  std::vector<std::uint32_t> half_edges;
  std::vector<Loop> loops;
  std::vector<Face> faces;

  std::span<const std::uint32_t> of(const Loop& loop) const {
    return std::span(half_edges).subspan(loop.first, loop.count);
  }
};

/// Finds all faces. Edges must meet at nodes only, and there are no duplicates. Loops are in the order of their
/// lowest half-edges. Cost: sorting the arms of each node; components inside faces cost one pass over the loops
/// near them.
PlanarFaces faces_of(std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges, const Job& job);

/// Returns the node where a half-edge starts.
inline std::uint32_t start_of(std::span<const PlanarEdge> edges, std::uint32_t half) {
  const PlanarEdge& edge = edges[half / 2];
  return half % 2 == 0 ? edge.from : edge.to;
}
/// Returns the node where a half-edge ends.
inline std::uint32_t end_of(std::span<const PlanarEdge> edges, std::uint32_t half) {
  return start_of(edges, half ^ 1U);
}

/// The half-edges that leave each node, counter-clockwise from east.
struct PlanarArms {
  /// Index into `half_edges` of the first one of each node; one more at the end.
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> half_edges;
  std::span<const std::uint32_t> of(std::uint32_t node) const {
    return std::span(half_edges).subspan(first[node], first[node + 1] - first[node]);
  }
};
/// Sorts the half-edges around all nodes.
PlanarArms arms_of(std::span<const CmPoint> nodes, std::span<const PlanarEdge> edges);

}  // namespace seedmesh
