#include "core/generators/city/ribbons.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/corners.h"
#include "core/generators/city/kerb_sides.h"
#include "core/generators/city/shape.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double least_progress = 30;  // of a kerb between two corners, cm
constexpr std::size_t faces_a_chunk = 64;

/// One outline of a face.
struct Outline {
  std::vector<std::uint32_t> half_edges;
  bool is_outer = true;
};

/// Shares of the widths of a street, of the radius of fillets and of the cut of corners.
struct Widths {
  double carriageway = 1, walk = 1, fillet = 1, cut = 0;
};
constexpr Widths without_cut[] = {{1, 1, 1}, {1, 1, 0},   {1, 0.6, 0}, {1, 0.3, 0}, {0.8, 0.3, 0},
                                  {1, 0, 0}, {0.6, 0, 0}, {0.3, 0, 0}, {0.1, 0, 0}, {0.03, 0, 0}};

/// How the street space of a face was laid out.
struct FaceLayout {
  bool is_used = false, has_walks = false;
  std::vector<Outline> outlines;
};

class StreetSpace {
 public:
  StreetSpace(CityPlan& plan, const CornerCut& cut, Job& job)
      : plan_(plan),
        graph_(plan.graph),
        job_(job),
        cut_width_(cut.width),
        cos_least_turn_(math::cos(math::radians(180 - cut.greatest_angle))) {
    sides_.resize(graph_.edges.size() * 2);
    if (cut_width_ > 0) attempts_ = {{1, 1, 1, 1}, {1, 1, 1, 0.5}};
    for (const Widths& each : without_cut) attempts_.push_back(each);
  }

  std::vector<BlockOutline> lay_out() {
    const PlanarFaces faces = faces_of(graph_.nodes, graph_.edges, job_);
    std::vector<FaceLayout> layouts(faces.faces.size());
    parallel_for(job_, layouts.size(), faces_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
      for (std::size_t i = begin; i < end; ++i) lay_out_face(faces, faces.faces[i], layouts[i]);
    });
    cut_carriageways(graph_, sides_);
    step_unsound_junctions(faces, layouts);
    plan_.corner_reaches = corner_reaches(graph_, sides_);
    add_junctions();
    add_carriageways();
    std::vector<BlockOutline> blocks;
    for (const FaceLayout& layout : layouts) add_face(layout, blocks);
    for (const FaceLayout& layout : layouts) {
      if (!layout.is_used) add_water(layout);
    }
    return blocks;
  }

 private:
  /// Lays the faces around junctions whose outlines cross themselves out again, with steps between their widths.
  void step_unsound_junctions(const PlanarFaces& faces, std::vector<FaceLayout>& layouts) {
    const std::vector<std::uint32_t> unsound = undo_unsound_cuts(graph_, sides_);
    if (unsound.empty()) return;
    is_stepped_.assign(graph_.nodes.size(), 0);
    for (const std::uint32_t node : unsound) is_stepped_[node] = 1;
    const auto is_near = [&](const Outline& outline) {
      return std::ranges::any_of(outline.half_edges, [&](std::uint32_t half) {
        return is_stepped_[start_of(graph_.edges, half)] != 0;
      });
    };
    for (std::size_t i = 0; i < layouts.size(); ++i) {
      if (!std::ranges::any_of(layouts[i].outlines, is_near)) continue;
      layouts[i] = {};
      lay_out_face(faces, faces.faces[i], layouts[i]);
    }
    cut_carriageways(graph_, sides_);
    undo_unsound_cuts(graph_, sides_);
  }

  double half_width(std::uint32_t half) const {
    return graph_.is_street(half / 2) ? plan_.class_of(half / 2).width * 50 : 0;
  }
  double walk_width(std::uint32_t half) const {
    return graph_.is_street(half / 2) ? plan_.class_of(half / 2).sidewalk[half % 2] * 100 : 0;
  }

  std::vector<CmPoint> corner_at(std::uint32_t before, std::uint32_t half, const Widths& widths,
                                 bool is_kerb) const {
    CornerInput corner;
    corner.at = in_cm(graph_.nodes[start_of(graph_.edges, half)]);
    corner.before = unit_of(graph_, before);
    corner.after = unit_of(graph_, half);
    corner.is_dead_end = before == (half ^ 1U);
    const double walk_before = walk_width(before) * widths.walk, walk_after = walk_width(half) * widths.walk;
    corner.distance_before = half_width(before) * widths.carriageway + (is_kerb ? 0 : walk_before);
    corner.distance_after = half_width(half) * widths.carriageway + (is_kerb ? 0 : walk_after);
    corner.cap = is_kerb ? 0 : walk_after;
    const bool is_between_streets = graph_.is_street(before / 2) && graph_.is_street(half / 2);
    if (is_between_streets && !is_stepped_.empty() && is_stepped_[start_of(graph_.edges, half)] != 0)
      corner.step = least_progress;
    if (!is_kerb && is_between_streets && half_width(before) != half_width(half))
      corner.walk = std::max(walk_before, walk_after);
    if (is_kerb && widths.fillet > 0 && is_between_streets)
      corner.fillet = fillet_of(corner, std::min(walk_before, walk_after));
    if (!is_kerb && is_between_streets && glm::dot(corner.before, corner.after) <= cos_least_turn_)
      corner.chamfer = cut_width_ * widths.cut;
    return corner_points(corner);
  }

  /// Moves the outlines of a face; narrower where they would not stay simple.
  void lay_out_face(const PlanarFaces& faces, const PlanarFaces::Face& face, FaceLayout& layout) {
    const auto add = [&](std::uint32_t loop, bool is_outer) {
      const auto span = faces.of(faces.loops[loop]);
      layout.outlines.push_back({{span.begin(), span.end()}, is_outer});
    };
    add(face.outer, true);
    for (const std::uint32_t hole : face.holes) add(hole, false);
    layout.is_used =
        is_on_land(plan_.region, position_in(graph_.nodes, graph_.edges, layout.outlines[0].half_edges));
    if (!layout.is_used) return;
    if (std::ranges::any_of(attempts_, [&](const Widths& w) { return try_widths(layout, w); })) return;
    // The outlines of the graph itself, all of them: an attempt ends at the first one that is not sound.
    layout.has_walks = false;
    for (const Outline& outline : layout.outlines) place_corners(outline, {0, 0, 0}, false);
    job_.check();
  }

  bool try_widths(FaceLayout& layout, const Widths& widths) {
    layout.has_walks = widths.walk > 0;
    std::vector<CmRing> kerbs, borders;
    for (const Outline& outline : layout.outlines) {
      place_corners(outline, widths, layout.has_walks);
      CmRing kerb, border;
      kerb.reserve(4 * outline.half_edges.size());
      if (layout.has_walks) border.reserve(2 * outline.half_edges.size());
      for (unsigned int half : outline.half_edges) {
        const KerbSide& side = sides_[half];
        if (!advances(half, side.from(), side.to)) return false;
        for (const CmPoint& p : side.corner) append_new(kerb, p);
        if (!layout.has_walks) continue;
        const CmPoint& next = sides_[side.after].outer_corner.front();
        if (!advances(half, side.outer_corner.back(), next)) return false;
        for (const CmPoint& p : side.outer_corner) append_new(border, p);
      }
      close(kerb);
      close(border);
      if (!is_sound(kerb, outline.is_outer)) return false;
      if (layout.has_walks && !is_sound(border, outline.is_outer)) return false;
      kerbs.push_back(std::move(kerb));
      borders.push_back(std::move(border));
    }
    if (!are_nested(kerbs)) return false;
    if (!layout.has_walks) return true;
    if (!are_nested(borders)) return false;
    for (const Outline& outline : layout.outlines) {
      for (const std::uint32_t half : outline.half_edges) {
        if (!graph_.is_street(half / 2)) continue;
        const CmRing ring = sidewalk_ring(sides_, half);
        if (!is_simple(ring) || doubled_area(ring) <= 0) return false;
      }
    }
    return true;
  }

  void place_corners(const Outline& outline, const Widths& widths, bool has_walks) {
    const std::size_t count = outline.half_edges.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t half = outline.half_edges[k], before = outline.half_edges[(k + count - 1) % count];
      KerbSide& side = sides_[half];
      side.before = before;
      side.after = outline.half_edges[(k + 1) % count];
      side.corner = corner_at(before, half, widths, true);
      side.outer_corner = has_walks ? corner_at(before, half, widths, false) : side.corner;
      side.is_laid_out = true;
    }
    for (const std::uint32_t half : outline.half_edges) {
      KerbSide& side = sides_[half];
      side.to = sides_[side.after].corner.front();
      side.cut_from = side.from();
      side.cut_to = side.to;
    }
  }

  /// Shores and the border of the area have edges shorter than `least_progress`.
  bool advances(std::uint32_t half, const CmPoint& from, const CmPoint& to) const {
    const dvec2 d = unit_of(graph_, half), along = in_cm(to) - in_cm(from);
    const double length =
        distance(graph_.nodes[start_of(graph_.edges, half)], graph_.nodes[start_of(graph_.edges, half ^ 1U)]);
    return d.x * along.x + d.y * along.y >= std::min(least_progress, length / 2);
  }

  static bool is_sound(const CmRing& ring, bool is_outer) {
    return is_simple(ring) && is_outer == (doubled_area(ring) > 0);
  }

  /// Whether the outlines of a face do not meet, and all but the first lie inside of the first.
  static bool are_nested(const std::vector<CmRing>& rings) {
    return are_apart(rings) && std::all_of(rings.begin() + 1, rings.end(), [&](const CmRing& hole) {
             return hole.empty() || is_inside(rings[0], in_cm(hole[0]));
           });
  }

  void add_part(PartKind kind, CmRing ring, std::uint32_t street, std::uint32_t node) {
    Part part;
    part.kind = kind;
    part.street = street;
    part.node = node;
    part.rings.push_back(std::move(ring));
    plan_.parts.push_back(std::move(part));
  }

  /// A town wall takes the place of the sidewalk on the right side of its street.
  void add_sidewalk(std::uint32_t half) {
    const bool is_wall = half % 2 == 1 && plan_.class_of(half / 2).has_wall;
    add_part(is_wall ? PartKind::verge : PartKind::sidewalk, sidewalk_ring(sides_, half), half / 2, no_index);
    plan_.parts.back().is_wall = is_wall;
  }

  void add_junctions() {
    for (std::uint32_t node = 0; node < graph_.nodes.size(); ++node) {
      const std::uint32_t degree = graph_.degree(node);
      if (degree == 0 || (graph_.is_border[node] != 0 && degree == 1)) continue;
      CmRing ring = junction_ring(graph_, sides_, node);
      if (ring.size() < 3 || doubled_area(ring) == 0) continue;
      add_part(PartKind::junction, std::move(ring), no_index, node);
    }
  }

  void add_carriageways() {
    plan_.kerbs.assign(graph_.edges.size(), {});
    carriageways_.assign(graph_.edges.size(), no_index);
    for (std::uint32_t edge = 0; edge < graph_.edges.size(); ++edge) {
      if (!graph_.is_street(edge)) continue;
      const KerbSide &left = sides_[2 * edge], &right = sides_[2 * edge + 1];
      CmRing ring = carriageway_ring(graph_, sides_, edge);
      if (ring.size() < 3 || doubled_area(ring) == 0) continue;
      carriageways_[edge] = static_cast<std::uint32_t>(plan_.parts.size());
      add_part(PartKind::carriageway, std::move(ring), edge, no_index);
      if (left.is_laid_out && right.is_laid_out)
        plan_.kerbs[edge] = {left.cut_from, left.cut_to, right.cut_to, right.cut_from};
    }
  }

  void add_face(const FaceLayout& layout, std::vector<BlockOutline>& blocks) {
    if (!layout.is_used) return;
    bool has_street = false;
    for (const Outline& outline : layout.outlines) {
      for (const std::uint32_t half : outline.half_edges) has_street |= graph_.is_street(half / 2);
    }
    if (!layout.has_walks || !has_street) {
      Part part;
      part.kind = has_street ? PartKind::verge : PartKind::park;
      for (const Outline& outline : layout.outlines) {
        CmRing ring = kerb_ring(outline);
        // Streets without a width that end within the face have no area.
        if (outline.is_outer || (ring.size() >= 3 && doubled_area(ring) != 0))
          part.rings.push_back(std::move(ring));
      }
      plan_.parts.push_back(std::move(part));
      return;
    }
    BlockOutline block;
    for (const Outline& outline : layout.outlines) {
      CmRing ring;
      std::vector<std::uint32_t> walks;  // parts, by half-edge of the outline
      for (const std::uint32_t half : outline.half_edges) {
        walks.push_back(graph_.is_street(half / 2) ? static_cast<std::uint32_t>(plan_.parts.size())
                                                   : no_index);
        if (walks.back() != no_index) add_sidewalk(half);
      }
      for (std::size_t i = 0; i < walks.size() && outline.is_outer; ++i)
        add_block_edges(block, outline.half_edges[i], walks[i], walks[(i + walks.size() - 1) % walks.size()]);
      if (outline.is_outer) continue;
      for (const std::uint32_t half : outline.half_edges) {
        for (const CmPoint& p : sides_[half].outer_corner) append_new(ring, p);
        if (graph_.is_street(half / 2)) block.hole_streets.push_back(half / 2);
      }
      close(ring);
      block.holes.push_back(std::move(ring));
    }
    blocks.push_back(std::move(block));
  }

  /// A face outside of the land: water, unless it lies outside of the area. Its outline has the corners of what is on
  /// the other side.
  void add_water(const FaceLayout& layout) {
    const dvec2 p = position_in(graph_.nodes, graph_.edges, layout.outlines[0].half_edges);
    bool is_in_area = false;
    for (const CmRing& ring : plan_.area) is_in_area ^= is_inside(ring, p);
    if (!is_in_area) return;
    Part part;
    part.kind = PartKind::water;
    for (const Outline& outline : layout.outlines) {
      CmRing ring;
      for (const std::uint32_t half : outline.half_edges) {
        append_new(ring, graph_.nodes[start_of(graph_.edges, half)]);
        const KerbSide& other = sides_[half ^ 1U];
        if (!other.is_laid_out) continue;
        append_new(ring, other.to);
        append_new(ring, sides_[other.after].outer_corner.front());
        append_new(ring, other.outer_corner.back());
        append_new(ring, other.from());
      }
      close(ring);
      if (outline.is_outer && doubled_area(ring) <= 0) return;
      part.rings.push_back(std::move(ring));
    }
    plan_.parts.push_back(std::move(part));
  }

  /// The edges of a block along one half-edge. The edges of a corner belong to the sidewalk that has them. `walk` and
  /// `walk_before` are the sidewalks of this half-edge and of the one before it.
  void add_block_edges(BlockOutline& block, std::uint32_t half, std::uint32_t walk,
                       std::uint32_t walk_before) const {
    constexpr double near = 1.5;  // cm
    const KerbSide& side = sides_[half];
    const std::uint32_t street = graph_.is_street(half / 2) ? half / 2 : no_index;
    const auto add = [&block](const CmPoint& p, const BlockEdge& edge) {
      block.ring.push_back(p);
      block.edges.push_back(edge);
    };
    // Where a street ends at a shore at an acute angle, the block lies along the ends of its sidewalk and carriageway.
    const std::uint32_t before = side.before / 2;
    const bool is_end = street == no_index && graph_.is_street(before);
    for (std::size_t i = 0; i < side.outer_corner.size(); ++i) {
      const CmPoint& p = side.outer_corner[i];
      if (!is_end || i + 1 == side.outer_corner.size()) {
        add(p, {street, walk});
        continue;
      }
      const CmPoint &kerb = side.corner.front(), &next = side.outer_corner[i + 1];
      const bool has_kerb = i == 0 && kerb != p && kerb != next &&
                            distance_to_segment(in_cm(kerb), in_cm(p), in_cm(next)) < near;
      if (has_kerb) add(p, {before, walk_before});
      add(has_kerb ? kerb : p, {before, carriageways_[before]});
    }
  }

  CmRing kerb_ring(const Outline& outline) const {
    CmRing ring;
    for (const std::uint32_t half : outline.half_edges) {
      const KerbSide& side = sides_[half];
      for (const CmPoint& p : side.corner) append_new(ring, p);
      append_new(ring, side.cut_from);
      append_new(ring, side.cut_to);
    }
    close(ring);
    return ring;
  }

  CityPlan& plan_;
  const StreetGraph& graph_;
  Job& job_;
  double cut_width_, cos_least_turn_;
  std::vector<Widths> attempts_;
  std::vector<std::uint8_t> is_stepped_;  ///< 1 at a step, indexed by node; empty where no junction has one
  std::vector<KerbSide> sides_;
  std::vector<std::uint32_t> carriageways_;  ///< parts, by edge
};

}  // namespace

std::vector<BlockOutline> lay_out_streets(CityPlan& plan, const CornerCut& cut, Job& job) {
  return StreetSpace(plan, cut, job).lay_out();
}

}  // namespace seedmesh::city
