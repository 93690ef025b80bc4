// Strips of a block along its streets; see division.h. Vanegas, Kelly, Weber, Halatsch, Aliaga and Mueller,
// "Procedural generation of parcels in urban modeling", 2012, section 5.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "core/base/math.h"
#include "core/generators/city/division.h"
#include "core/generators/city/shape.h"
#include "core/geom/polygon/straight_skeleton.h"
#include "generated/params/city.h"

namespace seedmesh::city {

using glm::dvec2;

namespace {
constexpr double least_bend = 3;      // of corners whose angles count, cm
constexpr double sharpest = 0.976;    // cosine of the least angle of strips, 12.6 degrees
constexpr double near_outline = 1.6;  // points this near to the outline lie on it, cm
}  // namespace

/// Builds the pieces from the faces of a straight skeleton.
class Strips {
 public:
  Strips(Division& division, double depth) : division_(division), depth_(depth) {}

  std::vector<Piece> pieces(const Job& job) {
    if (!add_faces(job)) return {};
    while (const auto cell = unfit_cell()) {
      if (!join_with_neighbour(*cell)) return {};
    }
    std::vector<Piece> all;
    for (const Cell& cell : cells_) {
      if (cell.edges.empty()) continue;
      std::optional<Piece> piece = piece_of(cell);
      if (!piece) return {};
      piece->key = key_at(key_at(division_.whole_.key, 0x57A1), cell.number);
      all.push_back(*std::move(piece));
    }
    if (all.size() < 2) return {};
    publish();
    return all;
  }

 private:
  struct CellEdge {
    CmPoint a, b;
    std::uint32_t edge;
  };
  struct Cell {
    std::vector<CellEdge> edges;
    std::uint64_t number = 0;  ///< number of its street along the outline
    bool is_inner = false;
  };

  bool add_faces(const Job& job) {
    const Piece& whole = division_.whole_;
    const std::size_t count = whole.ring.size();
    Plan plan;
    plan.rings.emplace_back();
    std::vector<double> speed;
    for (std::size_t i = 0; i < count; ++i) {
      plan.rings[0].push_back(in_cm(whole.ring[i]));
      speed.push_back(division_.edges_[whole.edges[i]].street == no_index ? 0 : 1);
    }
    const StraightSkeleton skeleton = straight_skeleton(plan, {speed, depth_}, job);
    if (!skeleton.is_sound) return false;
    const std::vector<std::uint32_t> groups = groups_of(whole);
    cells_.resize(groups.empty() ? 0 : *std::max_element(groups.begin(), groups.end()) + 1);
    for (std::size_t g = 0; g < cells_.size(); ++g) cells_[g].number = g;
    for (const SkeletonFace& face : skeleton.faces) {
      if (!face.holes.empty()) return false;
      if (speed[face.edge] == 0) continue;
      Cell more;
      add_ring(more, skeleton, face.outline);
      if (!more.edges.empty() && !join(cells_[groups[face.edge]], more)) return false;
    }
    for (const SkeletonFront& front : skeleton.fronts) {
      Cell inner;
      inner.is_inner = true;
      inner.number = cells_.size();
      add_ring(inner, skeleton, front.node);
      if (!inner.edges.empty()) cells_.push_back(std::move(inner));
    }
    return true;
  }

  /// Consecutive edges along streets that turn by at most the angle `simplify` of the request belong together.
  std::vector<std::uint32_t> groups_of(const Piece& whole) const {
    const std::size_t count = whole.ring.size();
    const double cos_most = math::cos(math::radians(division_.lots_.simplify));
    const auto joins = [&](std::size_t i) {  // edge i with the one before
      const std::size_t before = (i + count - 1) % count;
      if (division_.edges_[whole.edges[i]].street == no_index ||
          division_.edges_[whole.edges[before]].street == no_index)
        return false;
      const dvec2 u = in_cm(whole.ring[i]) - in_cm(whole.ring[before]),
                  v = in_cm(whole.ring[(i + 1) % count]) - in_cm(whole.ring[i]);
      return glm::dot(u, v) >= cos_most * std::sqrt(glm::dot(u, u) * glm::dot(v, v));
    };
    std::size_t first = 0;
    while (first < count && joins(first)) ++first;
    std::vector<std::uint32_t> groups(count, 0);
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t i = (first + n) % count;
      if (n > 0 && !joins(i)) ++group;
      groups[i] = group;
    }
    return groups;
  }

  /// The corner of the outline, or the earlier point on it, that is near to a point; else the point itself. Points on
  /// one edge then have a clear order.
  CmPoint snapped(const CmPoint& p) {
    constexpr double same = 4;  // cm
    const Piece& whole = division_.whole_;
    for (const CmPoint& corner : whole.ring) {
      if (distance(p, corner) < same) return corner;
    }
    for (const CmPoint& known : on_outline_) {
      if (distance(p, known) < same) return known;
    }
    for (std::size_t i = 0; i < whole.ring.size(); ++i) {
      const CmPoint &a = whole.ring[i], &b = whole.ring[(i + 1) % whole.ring.size()];
      if (distance_to_segment(in_cm(p), in_cm(a), in_cm(b)) > near_outline) continue;
      on_outline_.push_back(p);
      break;
    }
    return p;
  }

  void add_ring(Cell& cell, const StraightSkeleton& skeleton, const std::vector<std::uint32_t>& nodes) {
    CmRing ring;
    for (const std::uint32_t node : nodes) {
      const CmPoint p = snapped(rounded_cm({skeleton.node[node].x, skeleton.node[node].y}));
      if (ring.empty() || ring.back() != p) ring.push_back(p);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() < 3) return;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CmPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
      add_edge(cell, {a, b, edge_of(a, b)});
    }
  }

  /// Adds an edge, or removes it where the cell has it the other way round.
  static void add_edge(Cell& cell, const CellEdge& edge) {
    for (CellEdge& other : cell.edges) {
      if (other.a != edge.b || other.b != edge.a) continue;
      other = cell.edges.back();
      cell.edges.pop_back();
      return;
    }
    cell.edges.push_back(edge);
  }

  /// The edge of the outline on which a segment lies, or a new one between two pieces.
  std::uint32_t edge_of(const CmPoint& a, const CmPoint& b) {
    const Piece& whole = division_.whole_;
    for (std::size_t i = 0; i < whole.ring.size(); ++i) {
      const dvec2 c = in_cm(whole.ring[i]), d = in_cm(whole.ring[(i + 1) % whole.ring.size()]);
      if (distance_to_segment(in_cm(a), c, d) > near_outline ||
          distance_to_segment(in_cm(b), c, d) > near_outline)
        continue;
      if (glm::dot(in_cm(b) - in_cm(a), d - c) <= 0) continue;
      for (const CmPoint& p : {a, b}) {
        if (in_cm(p) != c && in_cm(p) != d) corners_.emplace_back(whole.edges[i], p);
      }
      return whole.edges[i];
    }
    const auto [at, is_new] = inner_.try_emplace({std::min(a, b), std::max(a, b)}, 0);
    if (is_new) {
      at->second = static_cast<std::uint32_t>(division_.edges_.size());
      division_.edges_.push_back({a, b, no_index, no_index, {}});
    }
    return at->second;
  }

  bool join(Cell& cell, const Cell& more) {
    for (const CellEdge& edge : more.edges) add_edge(cell, edge);
    cell.is_inner = cell.is_inner && more.is_inner;
    return true;
  }

  /// The outline of a cell; nothing if it consists of several rings.
  static std::optional<Piece> piece_of(const Cell& cell) {
    std::map<CmPoint, const CellEdge*> next;
    for (const CellEdge& edge : cell.edges) {
      if (!next.emplace(edge.a, &edge).second) return std::nullopt;
    }
    if (next.empty()) return std::nullopt;
    Piece piece;
    piece.is_inner = cell.is_inner;
    CmPoint at = next.begin()->first;
    while (piece.ring.size() < cell.edges.size()) {
      const auto edge = next.find(at);
      if (edge == next.end()) return std::nullopt;
      piece.ring.push_back(at);
      piece.edges.push_back(edge->second->edge);
      at = edge->second->b;
      if (at == piece.ring[0]) break;
    }
    if (piece.ring.size() != cell.edges.size() || at != piece.ring[0] || !is_simple(piece.ring) ||
        doubled_area(piece.ring) <= 0)
      return std::nullopt;
    return piece;
  }

  bool is_fit(const Cell& cell) const {
    const std::optional<Piece> piece = piece_of(cell);
    if (!piece) return false;
    if (sharpest_cosine(without_bends(piece->ring, least_bend)) >= sharpest) return false;
    if (!cell.is_inner) return division_.is_fit(*piece, least_block_angle, 1e9);
    const LeastBox box = least_box(piece->ring);
    return static_cast<double>(doubled_area(piece->ring)) >= 2e4 * division_.lots_.area[0] &&
           box.narrowest >= division_.lots_.width * 100 + 3 && box.long_side <= 6 * box.short_side;
  }

  std::optional<std::size_t> unfit_cell() const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!cells_[i].edges.empty() && !is_fit(cells_[i])) return i;
    }
    return std::nullopt;
  }

  /// Joins a cell with the one that has the longest common border and gives one outline.
  bool join_with_neighbour(std::size_t number) {
    std::vector<std::pair<double, std::size_t>> shared;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (i == number) continue;
      double length = 0;
      for (const CellEdge& edge : cells_[number].edges) {
        for (const CellEdge& other : cells_[i].edges) {
          if (other.a == edge.b && other.b == edge.a) length += distance(edge.a, edge.b);
        }
      }
      if (length > 0) shared.emplace_back(0 - length, i);
    }
    std::sort(shared.begin(), shared.end());
    for (const auto& [length, i] : shared) {
      Cell both = cells_[i];
      join(both, cells_[number]);
      if (!piece_of(both)) continue;
      cells_[i] = std::move(both);
      cells_[number].edges.clear();
      return true;
    }
    return false;
  }

  /// Adds corners on the outline of the block to its edges, where pieces meet there.
  void publish() {
    for (const auto& [edge, p] : corners_) division_.edges_[edge].added.push_back(p);
  }

  Division& division_;
  double depth_;
  std::vector<Cell> cells_;
  std::map<std::pair<CmPoint, CmPoint>, std::uint32_t> inner_;
  std::vector<std::pair<std::uint32_t, CmPoint>> corners_;
  CmRing on_outline_;  ///< points between its corners
};

std::vector<Piece> strips_of(Division& division, double depth, const Job& job) {
  return Strips(division, depth).pieces(job);
}

}  // namespace seedmesh::city
