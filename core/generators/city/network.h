#pragma once
/// The street network while it grows within one cell of major streets, and the local constraints of a new piece
/// of road. Coordinates are centimetres. Everything in a cell depends on the cell alone.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geom/polygon/cm_point.h"

namespace seedmesh::city {

/// Classes of edges, also the tags of the planar graph. Given streets with a cross section of their own have tags
/// from `first_given` on.
enum class EdgeClass : std::uint32_t { border, shore, highway, major, minor, lane };
constexpr std::uint32_t first_given = 6;
constexpr bool is_street_tag(std::uint32_t tag) { return tag > static_cast<std::uint32_t>(EdgeClass::shore); }
constexpr bool is_street_class(EdgeClass kind) { return is_street_tag(static_cast<std::uint32_t>(kind)); }

struct NetworkEdge {
  std::uint32_t from = 0, to = 0;
  EdgeClass kind = EdgeClass::minor;
  bool is_fixed = false;  ///< belongs to two cells and is not split
  bool is_removed = false;
};

/// The box around an edge, in centimetres.
struct EdgeBox {
  std::int32_t low_x = 0, low_y = 0, high_x = 0, high_y = 0;
};

/// Limits of the local constraints. All distances are centimetres.
struct ConstraintLimits {
  double snap = 2500;
  double clearance = 3000;
  double cos_minimal_angle = 0.82;  ///< cosine of the least angle between arms
  double cos_border_angle = 0.71;   ///< the same at the border of the area
  double least_length = 900;        ///< least length of an edge
  double beside = 700;              ///< least distance of an edge from nodes that it does not join
};

enum class PieceState { free, joined, failed };

struct PieceResult {
  PieceState state = PieceState::failed;
  std::uint32_t node = 0;  ///< node where the piece ends
};

class Network {
 public:
  explicit Network(const ConstraintLimits& limits) : limits_(limits) {}

  std::uint32_t add_node(const CmPoint& p);
  std::uint32_t add_edge(std::uint32_t from, std::uint32_t to, EdgeClass kind, bool is_fixed);
  /// Removes an edge that is not fixed.
  void remove_edge(std::uint32_t edge);

  /// Lets no further road end at a node.
  void close_node(std::uint32_t node) { closed_.push_back(node); }
  bool is_closed(std::uint32_t node) const {
    return std::find(closed_.begin(), closed_.end(), node) != closed_.end();
  }

  const std::vector<CmPoint>& nodes() const { return nodes_; }
  const std::vector<NetworkEdge>& edges() const { return edges_; }
  const std::vector<std::uint32_t>& arms(std::uint32_t node) const { return arms_[node]; }

  /// Applies the local constraints to a piece of road from a node to `end`, and adds the piece unless it is
  /// refused. The piece ends at the first road that it meets or reaches within the snapping distance. Otherwise
  /// it must keep its clearance. It is refused if it would make an acute angle or a short edge. Cost: linear in
  /// the edges.
  PieceResult build_piece(std::uint32_t from, const glm::dvec2& end, EdgeClass kind);

  /// Builds a straight piece along `direction` (a unit vector) to the first road within `reach`.
  PieceResult build_to_road(std::uint32_t from, const glm::dvec2& direction, double reach, EdgeClass kind);

 private:
  struct Hit {
    std::uint32_t edge = 0;
    double share = 0;  ///< position along the piece, as a share of its length
    glm::dvec2 at{0};
  };
  template <class Visit>
  bool each_near(const glm::dvec2& a, const glm::dvec2& b, double distance, const Visit& visit) const;
  std::optional<Hit> first_hit(std::uint32_t from, const glm::dvec2& end) const;
  std::optional<std::uint32_t> nearest_node(std::uint32_t from, const glm::dvec2& end) const;
  PieceResult join_edge(std::uint32_t from, const Hit& hit, EdgeClass kind);
  bool may_link(std::uint32_t from, const CmPoint& to, std::uint32_t target, std::uint32_t split) const;
  bool keeps_angles(std::uint32_t node, const CmPoint& towards) const;
  bool is_free(std::uint32_t from, const glm::dvec2& end) const;
  void split(std::uint32_t edge, std::uint32_t node);

  ConstraintLimits limits_;
  std::vector<CmPoint> nodes_;
  std::vector<NetworkEdge> edges_;
  std::vector<EdgeBox> boxes_;  ///< boxes of the edges
  std::vector<std::uint32_t> closed_;
  std::vector<std::vector<std::uint32_t>> arms_;
};

}  // namespace seedmesh::city
