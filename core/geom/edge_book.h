#pragma once
/// Who runs along which edge, and which way the pieces of a mesh must be turned so that all agree on the
/// outside.
#include <span>
#include <vector>

#include "core/geom/places.h"

namespace seedmesh {

/// Takes pieces of surface one by one into layers. In a layer every edge lies in at most two triangles, and
/// the pieces that share edges can be turned so that they agree; how each is turned is known when all are in.
/// Union-find with parity (Tarjan, "Efficiency of a good but not linear set union algorithm", 1975).
class EdgeBook {
 public:
  struct Edge {
    std::uint32_t from, to;  ///< places
  };

  explicit EdgeBook(const Job& job) : use_of_(job, 64), uses_(job), leader_(job), parity_(job) {}

  /// Enters the next piece by those of its directed edges that others may share, and returns the first layer
  /// that takes it. No edge may occur twice in the same direction.
  int add(std::vector<Edge>& edges);

  /// Whether a piece, by the order of entry, is to be turned over. Valid when all are in.
  bool is_turned(std::uint32_t piece) { return find(piece).parity; }

 private:
  struct Use {
    std::uint32_t piece;  ///< the first to run along the edge
    std::uint8_t upward;  ///< it does so from the lower number to the higher
    std::uint8_t times;
  };
  struct Leader {
    std::uint32_t piece;
    std::uint8_t parity;  ///< of the one asked for, against its leader
  };

  static std::uint64_t key(int layer, const Edge& edge);
  Leader find(std::uint32_t piece);
  bool fits(int layer, std::span<const Edge> edges);

  NumberTable use_of_;
  Array<Use> uses_;
  Array<std::uint32_t> leader_;  ///< of each piece
  Array<std::uint8_t> parity_;   ///< against its leader
  std::vector<Leader> bound_;    ///< groups that the next piece touches, and how it lies to their leaders
};

}  // namespace seedmesh
