#pragma once
/// Consistent orientation of pieces of surface that share edges.
#include <span>
#include <vector>

#include "core/geom/mesh/point_grid.h"

namespace seedmesh {

/// Assigns pieces of surface to layers, one by one. In a layer, every edge belongs to at most two triangles,
/// and the pieces can be flipped so that neighbours have the same outside. Which pieces to flip is known
/// after all are added. Method: union-find with parity (Tarjan, "Efficiency of a good but not linear set
/// union algorithm", 1975).
class EdgeAdjacency {
 public:
  struct Edge {
    std::uint32_t from, to;  ///< numbers of positions
  };

  explicit EdgeAdjacency(const Job& job) : use_of_(job, 64), uses_(job), leader_(job), parity_(job) {}

  /// Adds the next piece and returns its layer, the first that is possible. `edges` are the directed edges of
  /// the piece that other pieces may share, none of them twice in the same direction; the call sorts them.
  int add(std::vector<Edge>& edges);

  /// True where piece number `piece`, in the order of add(), has to be flipped. Valid after all are added.
  bool is_turned(std::uint32_t piece) { return find(piece).parity; }

 private:
  struct Use {
    std::uint32_t piece;  ///< the first piece with this edge
    std::uint8_t upward;  ///< 1: that piece has the edge from the lower to the higher position number
    std::uint8_t times;   ///< number of triangles at the edge
  };
  struct Leader {
    std::uint32_t piece;
    std::uint8_t parity;  ///< 1: the piece of the query is flipped relative to its leader
  };

  static std::uint64_t key(int layer, const Edge& edge);
  Leader find(std::uint32_t piece);
  bool fits(int layer, std::span<const Edge> edges);

  NumberTable use_of_;
  Array<Use> uses_;
  Array<std::uint32_t> leader_;  ///< leader of each piece
  Array<std::uint8_t> parity_;   ///< parity of each piece: 1 where it is flipped against its leader
  std::vector<Leader> bound_;    ///< groups that the next piece touches, and its parity against their leaders
};

}  // namespace seedmesh
