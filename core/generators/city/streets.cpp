// The street graph from pieces: planar by construction, then cut to the area and to one component.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/growth.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

constexpr auto border_tag = static_cast<std::uint32_t>(EdgeClass::border);
constexpr double least_street = 320;  // cm

std::uint64_t key_of_point(const CmPoint& p) {
  return key_at(key_at(0xC17, static_cast<std::uint32_t>(p.x)), static_cast<std::uint32_t>(p.y));
}

/// The graph of the border and of pieces of streets, without what lies outside of the area.
PlanarGraph graph_of(const std::vector<CmRing>& area, const std::vector<StreetPiece>& pieces, Job& job) {
  PlanarGraph graph;
  for (const CmRing& ring : area) {
    for (std::size_t i = 0; i < ring.size(); ++i) graph.add(ring[i], ring[(i + 1) % ring.size()], border_tag);
  }
  Meter meter(job, Resource::shapes);
  for (const StreetPiece& piece : pieces) {
    meter.spend();
    graph.add(piece.a, piece.b, static_cast<std::uint32_t>(piece.kind));
  }
  return graph;
}

/// Working copy of a graph with the degrees of its nodes.
class Pruned {
 public:
  explicit Pruned(const PlanarGraph& graph) : nodes_(graph.nodes()), degree_(nodes_.size(), 0) {
    for (const PlanarEdge& edge : graph.edges()) {
      if (!edge.is_removed()) edges_.push_back(edge);
    }
    is_border_.assign(nodes_.size(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (edge.tag == border_tag) is_border_[edge.from] = is_border_[edge.to] = 1;
    }
    count_degrees();
  }

  void drop_outside(const std::vector<CmRing>& area) {
    for (PlanarEdge& edge : edges_) {
      if (edge.tag == border_tag) continue;
      const glm::dvec2 middle = (in_cm(nodes_[edge.from]) + in_cm(nodes_[edge.to])) / 2.0;
      if (!is_in_area(area, middle)) remove(edge);
    }
    compact();
  }

  /// Removes majors that end nowhere, back to the last junction.
  void drop_loose_majors() {
    bool goes_on = true;
    while (goes_on) {
      goes_on = false;
      for (PlanarEdge& edge : edges_) {
        if (edge.is_removed() || edge.tag != static_cast<std::uint32_t>(EdgeClass::major)) continue;
        if (!is_loose(edge.from) && !is_loose(edge.to)) continue;
        remove(edge);
        goes_on = true;
      }
    }
    compact();
  }

  /// Removes streets that are shorter than the least length, where rounding and clipping left any.
  void drop_short(double least) {
    for (PlanarEdge& edge : edges_) {
      if (edge.tag != border_tag && distance(nodes_[edge.from], nodes_[edge.to]) < least) remove(edge);
    }
    compact();
  }

  /// Removes edges that leave a node at an angle below the least one to a wider or earlier edge.
  void drop_sharp(double cos_least) {
    for (int round = 0; round < 8; ++round) {
      const PlanarArms arms = arms_of(nodes_, edges_);
      bool goes_on = false;
      for (std::uint32_t node = 0; node < nodes_.size(); ++node)
        goes_on |= drop_sharp_at(node, arms, cos_least);
      compact();
      if (!goes_on) return;
    }
  }

  /// Keeps the component of streets with the greatest length.
  void keep_largest() {
    std::vector<std::uint32_t> root(nodes_.size());
    for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
    const auto find = [&root](std::uint32_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (const PlanarEdge& edge : edges_) {
      if (edge.tag == border_tag) continue;
      const std::uint32_t a = find(edge.from), b = find(edge.to);
      root[std::max(a, b)] = std::min(a, b);
    }
    std::vector<double> length(nodes_.size(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (edge.tag != border_tag) length[find(edge.from)] += distance(nodes_[edge.from], nodes_[edge.to]);
    }
    const auto longest =
        static_cast<std::uint32_t>(std::max_element(length.begin(), length.end()) - length.begin());
    for (PlanarEdge& edge : edges_) {
      if (edge.tag != border_tag && find(edge.from) != longest) remove(edge);
    }
    compact();
  }

  StreetGraph finished() const {
    StreetGraph graph;
    std::vector<std::uint32_t> number(nodes_.size(), no_index);
    const auto node = [&](std::uint32_t old) {
      if (number[old] == no_index) {
        number[old] = static_cast<std::uint32_t>(graph.nodes.size());
        graph.nodes.push_back(nodes_[old]);
        graph.is_border.push_back(is_border_[old]);
        graph.node_key.push_back(key_of_point(nodes_[old]));
      }
      return number[old];
    };
    for (const PlanarEdge& edge : edges_) {
      const std::uint32_t from = node(edge.from), to = node(edge.to);
      graph.edges.push_back({from, to, edge.tag});
      const std::uint64_t a = graph.node_key[from], b = graph.node_key[to];
      graph.edge_key.push_back(key_at(std::min(a, b), std::max(a, b)));
    }
    graph.arms = arms_of(graph.nodes, graph.edges);
    return graph;
  }

 private:
  bool is_loose(std::uint32_t node) const { return degree_[node] == 1 && is_border_[node] == 0; }

  void remove(PlanarEdge& edge) {
    --degree_[edge.from];
    --degree_[edge.to];
    edge.from = edge.to = PlanarEdge::removed;
  }
  void compact() {
    std::erase_if(edges_, [](const PlanarEdge& edge) { return edge.is_removed(); });
    count_degrees();
  }
  void count_degrees() {
    std::fill(degree_.begin(), degree_.end(), 0);
    for (const PlanarEdge& edge : edges_) {
      if (edge.tag == border_tag) continue;
      ++degree_[edge.from];
      ++degree_[edge.to];
    }
  }

  bool drop_sharp_at(std::uint32_t node, const PlanarArms& arms, double cos_least) {
    const auto around = arms.of(node);
    bool has_dropped = false;
    for (std::size_t i = 0; i < around.size() && around.size() > 1; ++i) {
      PlanarEdge& first = edges_[around[i] / 2];
      PlanarEdge& second = edges_[around[(i + 1) % around.size()] / 2];
      if (first.is_removed() || second.is_removed() || (first.tag == border_tag && second.tag == border_tag))
        continue;
      const glm::dvec2 u = direction(first, node), v = direction(second, node);
      if (u.x * v.x + u.y * v.y <= cos_least) continue;
      // The border stays, then the lower class, then the earlier edge.
      const bool drops_second =
          first.tag == border_tag || (second.tag != border_tag && first.tag <= second.tag);
      remove(drops_second ? second : first);
      has_dropped = true;
    }
    return has_dropped;
  }
  glm::dvec2 direction(const PlanarEdge& edge, std::uint32_t node) const {
    const glm::dvec2 along = in_cm(nodes_[edge.from == node ? edge.to : edge.from]) - in_cm(nodes_[node]);
    return along / std::sqrt(along.x * along.x + along.y * along.y);
  }

  std::vector<CmPoint> nodes_;
  std::vector<PlanarEdge> edges_;
  std::vector<std::uint32_t> degree_;
  std::vector<std::uint8_t> is_border_;
};

StreetGraph majors_of(const GrowthInput& input, const std::vector<StreetPiece>& pieces, Job& job) {
  Pruned pruned(graph_of(input.area, pieces, job));
  pruned.drop_outside(input.area);
  pruned.drop_short(least_street);
  pruned.drop_sharp(math::cos(math::radians(input.streets.minimal_angle)));
  pruned.drop_loose_majors();
  pruned.keep_largest();
  pruned.drop_loose_majors();
  return pruned.finished();
}

std::vector<StreetPiece> pieces_of(const StreetGraph& graph) {
  std::vector<StreetPiece> pieces;
  for (const PlanarEdge& edge : graph.edges) {
    if (edge.tag != border_tag)
      pieces.push_back({graph.nodes[edge.from], graph.nodes[edge.to], static_cast<EdgeClass>(edge.tag)});
  }
  return pieces;
}

/// The minor streets of all cells, in the order of the cells.
std::vector<StreetPiece> grow_cells(const GrowthInput& input, const StreetGraph& majors, Job& job) {
  const PlanarFaces faces = faces_of(majors.nodes, majors.edges, job);
  std::vector<std::vector<StreetPiece>> grown(faces.faces.size());
  parallel_for(job, faces.faces.size(), 1, [&](std::size_t begin, std::size_t, std::size_t) {
    const PlanarFaces::Face& face = faces.faces[begin];
    std::vector<std::vector<std::uint32_t>> loops;
    const auto add = [&](std::uint32_t loop) {
      const auto span = faces.of(faces.loops[loop]);
      loops.emplace_back(span.begin(), span.end());
    };
    add(face.outer);
    for (const std::uint32_t hole : face.holes) add(hole);
    const CmPoint& corner = majors.nodes[start_of(majors.edges, loops[0][0])];
    const CmPoint& next = majors.nodes[end_of(majors.edges, loops[0][0])];
    // A hole of the area is a face, too.
    glm::dvec2 side(in_cm(next) - in_cm(corner));
    side = glm::dvec2(-side.y, side.x) / std::sqrt(side.x * side.x + side.y * side.y);
    if (!is_in_area(input.area, (in_cm(corner) + in_cm(next)) / 2.0 + side * 5.0)) return;
    grown[begin] = grow_cell(input, majors, loops, job);
  });
  std::vector<StreetPiece> all;
  for (const std::vector<StreetPiece>& each : grown) all.insert(all.end(), each.begin(), each.end());
  return all;
}

}  // namespace

bool is_in_area(const std::vector<CmRing>& area, const glm::dvec2& cm) {
  bool inside = false;
  for (const CmRing& ring : area) inside ^= is_inside(ring, cm);
  return inside;
}

StreetGraph grow_streets(const GrowthInput& input, Job& job) {
  StreetGraph majors = majors_of(input, grow_majors(input, job), job);
  const CityStreets& streets = input.streets;
  if (streets.pattern == CityPattern::raster &&
      (!streets.minor_pattern || *streets.minor_pattern == CityMinorPattern::raster))
    return majors;
  std::vector<StreetPiece> pieces = pieces_of(majors);
  const std::vector<StreetPiece> minors = grow_cells(input, majors, job);
  pieces.insert(pieces.end(), minors.begin(), minors.end());
  Pruned pruned(graph_of(input.area, pieces, job));
  pruned.drop_short(least_street);
  pruned.drop_sharp(math::cos(math::radians(22.6)));
  pruned.keep_largest();
  return pruned.finished();
}

}  // namespace seedmesh::city
