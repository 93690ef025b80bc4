#include "core/generators/building/boolean.h"

#include <algorithm>
#include <cmath>

#include "core/generators/building/solid_tools.h"

namespace seedmesh::building {
namespace {

/// A convex polygon in a plane: the points p with dot(normal, p) = at.
struct Piece {
  std::vector<glm::dvec3> points;
  glm::dvec3 normal{0};
  double at = 0;
  std::uint32_t tags = 0;
  bool is_round = false;

  void flip() {
    std::ranges::reverse(points);
    normal = -normal;
    at = -at;
  }
};

struct Node {
  glm::dvec3 normal{0};
  double at = 0;
  std::vector<Piece> pieces;  ///< pieces in the plane of the node
  int front = -1, back = -1;
};

/// The four positions of a polygon relative to a plane.
struct Sides {
  std::vector<Piece> same, opposite, front, back;
};

class Tree {
 public:
  Tree(std::vector<Piece> pieces, double eps, const Job& job) : eps_(eps), job_(job) {
    nodes_.emplace_back();
    build(std::move(pieces));
  }

  void invert() {
    for (Node& node : nodes_) {
      node.normal = -node.normal;
      node.at = -node.at;
      std::swap(node.front, node.back);
      for (Piece& piece : node.pieces) piece.flip();
    }
  }

  /// Removes what lies inside the solid of this tree.
  std::vector<Piece> clip(std::vector<Piece> pieces) const {
    std::vector<Piece> out;
    std::vector<std::pair<int, std::vector<Piece>>> open;
    open.emplace_back(0, std::move(pieces));
    while (!open.empty()) {
      auto [index, list] = std::move(open.back());
      open.pop_back();
      const Node& node = nodes_[static_cast<std::size_t>(index)];
      Sides sides;
      for (Piece& piece : list) split(node, std::move(piece), sides);
      job_.check();
      std::ranges::move(sides.same, std::back_inserter(sides.front));
      std::ranges::move(sides.opposite, std::back_inserter(sides.back));
      if (node.front >= 0) {
        open.emplace_back(node.front, std::move(sides.front));
      } else {
        std::ranges::move(sides.front, std::back_inserter(out));
      }
      if (node.back >= 0) open.emplace_back(node.back, std::move(sides.back));
    }
    return out;
  }

  void clip_to(const Tree& other) {
    for (Node& node : nodes_) node.pieces = other.clip(std::move(node.pieces));
  }

  std::vector<Piece> pieces() const {
    std::vector<Piece> out;
    for (const Node& node : nodes_) out.insert(out.end(), node.pieces.begin(), node.pieces.end());
    return out;
  }

 private:
  void build(std::vector<Piece> pieces) {
    std::vector<std::pair<std::size_t, std::vector<Piece>>> open;
    open.emplace_back(0, std::move(pieces));
    while (!open.empty()) {
      auto [index, list] = std::move(open.back());
      open.pop_back();
      if (list.empty()) continue;
      const Piece& middle = list[list.size() / 2];
      nodes_[index].normal = middle.normal;
      nodes_[index].at = middle.at;
      Sides sides;
      for (Piece& piece : list) split(nodes_[index], Piece(piece), sides);
      job_.check();
      std::ranges::move(sides.opposite, std::back_inserter(sides.same));
      nodes_[index].pieces = std::move(sides.same);
      for (const bool is_front : {true, false}) {
        std::vector<Piece>& rest = is_front ? sides.front : sides.back;
        if (rest.empty()) continue;
        const auto child = static_cast<int>(nodes_.size());
        nodes_.emplace_back();
        (is_front ? nodes_[index].front : nodes_[index].back) = child;
        open.emplace_back(static_cast<std::size_t>(child), std::move(rest));
      }
    }
  }

  void split(const Node& node, Piece piece, Sides& out) const {
    bool has_front = false, has_back = false;
    std::vector<double> distance;
    for (const glm::dvec3& p : piece.points) {
      distance.push_back(glm::dot(node.normal, p) - node.at);
      has_front |= distance.back() > eps_;
      has_back |= distance.back() < -eps_;
    }
    if (!has_front && !has_back) {
      (glm::dot(node.normal, piece.normal) > 0 ? out.same : out.opposite).push_back(std::move(piece));
    } else if (!has_back) {
      out.front.push_back(std::move(piece));
    } else if (!has_front) {
      out.back.push_back(std::move(piece));
    } else {
      Piece front = piece, back = piece;
      front.points.clear();
      back.points.clear();
      for (std::size_t i = 0; i < piece.points.size(); ++i) {
        const std::size_t next = (i + 1) % piece.points.size();
        if (distance[i] >= -eps_) front.points.push_back(piece.points[i]);
        if (distance[i] <= eps_) back.points.push_back(piece.points[i]);
        if ((distance[i] > eps_ && distance[next] < -eps_) ||
            (distance[i] < -eps_ && distance[next] > eps_)) {
          // From the lower end, so that both neighbours along an edge find the same point.
          const bool is_first = distance[i] < distance[next];
          const std::size_t a = is_first ? i : next, b = is_first ? next : i;
          const glm::dvec3 cut = piece.points[a] + (piece.points[b] - piece.points[a]) *
                                                       (distance[a] / (distance[a] - distance[b]));
          front.points.push_back(cut);
          back.points.push_back(cut);
        }
      }
      if (front.points.size() >= 3) out.front.push_back(std::move(front));
      if (back.points.size() >= 3) out.back.push_back(std::move(back));
    }
  }

  std::vector<Node> nodes_;
  double eps_;
  const Job& job_;
};

std::vector<Piece> pieces_of(const Solid& solid, double eps, const Job& job) {
  std::vector<Piece> out;
  const Solid convex = convex_faces(solid, job);
  for (const Face& face : convex.faces) {
    Piece piece;
    for (const std::uint32_t point : points_of(convex, convex.loops[face.first_loop]))
      piece.points.push_back(convex.points[point]);
    piece.normal = area_vector(convex, face, glm::dvec3(1));
    if (!(glm::length(piece.normal) > eps * eps)) continue;
    piece.normal /= glm::length(piece.normal);
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : piece.points) middle += p;
    piece.at = glm::dot(piece.normal, middle) / static_cast<double>(piece.points.size());
    piece.tags = face.tags;
    piece.is_round = face.is_round;
    out.push_back(std::move(piece));
  }
  return out;
}

double size_of(const Solid& solid) {
  double size = 0;
  for (const glm::dvec3& p : solid.points)
    size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return size;
}

}  // namespace

Solid boolean(const Solid& first, const Solid& second, BooleanKind kind, const Job& job) {
  const double scale = std::max({size_of(first), size_of(second), 1e-6}), eps = 1e-9 * scale;
  Tree a(pieces_of(first, eps, job), eps, job), b(pieces_of(second, eps, job), eps, job);
  if (kind != BooleanKind::unite) a.invert();
  if (kind == BooleanKind::intersect) {
    b.clip_to(a);
    b.invert();
    a.clip_to(b);
    b.clip_to(a);
  } else {
    a.clip_to(b);
    b.clip_to(a);
    b.invert();
    b.clip_to(a);
    b.invert();
  }
  std::vector<Piece> pieces = a.pieces();
  for (Piece& piece : b.pieces()) pieces.push_back(std::move(piece));
  Solid out;
  for (Piece& piece : pieces) {
    if (kind != BooleanKind::unite) piece.flip();
    std::vector<std::uint32_t> corners;
    for (const glm::dvec3& p : piece.points) {
      corners.push_back(static_cast<std::uint32_t>(out.points.size()));
      out.points.push_back(p);
    }
    add_face(out, corners, piece.is_round);
    out.faces.back().tags = piece.tags;
  }
  const double slack = 20 * eps;
  out = with_shared_corners(welded(out, slack), slack, job);
  out = without_straight_corners(with_joined_faces(out, slack), slack);
  out.is_closed = is_watertight(out);
  return out;
}

}  // namespace seedmesh::building
