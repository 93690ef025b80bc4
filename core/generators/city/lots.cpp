#include "core/generators/city/lots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/city/shape.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double greatest_aspect = 5;
constexpr double near_corner = 60;  // cuts that end this near to a corner end there, cm
constexpr double near_line = 3;     // corners this near to a cut's line lie on it, cm
constexpr double least_angle = 16;  // of corners that cuts make, degrees
constexpr double least_block_angle = 12.5;
constexpr std::size_t blocks_a_chunk = 16;
constexpr int deepest = 40;

/// An edge of a division, shared by the pieces on both sides, with the corners that cuts add to it.
struct SharedEdge {
  CmPoint a, b;
  std::uint32_t street = no_index, sidewalk = no_index;
  std::vector<CmPoint> added;

  /// The added corners strictly between two points of the edge, in the order from `from` to `to`.
  std::vector<CmPoint> between(const CmPoint& from, const CmPoint& to) const {
    const dvec2 origin = in_cm(from), along = in_cm(to) - origin;
    const double length2 = glm::dot(along, along);
    std::vector<std::pair<double, CmPoint>> found;
    for (const CmPoint& p : added) {
      const double share = glm::dot(in_cm(p) - origin, along) / length2;
      if (share > 0 && share < 1 && p != from && p != to) found.emplace_back(share, p);
    }
    std::sort(found.begin(), found.end());
    std::vector<CmPoint> points;
    for (const auto& [share, p] : found) {
      if (points.empty() || points.back() != p) points.push_back(p);
    }
    return points;
  }
};

/// A piece of a block: corner i, and the edge from it to the next.
struct Piece {
  CmRing ring;
  std::vector<std::uint32_t> edges;
  std::uint64_t key = 0;
};

class Division {
 public:
  Division(const BlockOutline& outline, const CityLots& lots, std::uint64_t key, Rng rng)
      : lots_(lots), rng_(rng) {
    whole_.ring = outline.ring;
    whole_.key = key;
    const std::size_t count = outline.ring.size();
    for (std::size_t i = 0; i < count; ++i) {
      const BlockEdge& edge = outline.edges[i];
      whole_.edges.push_back(static_cast<std::uint32_t>(edges_.size()));
      edges_.push_back({outline.ring[i], outline.ring[(i + 1) % count], edge.street, edge.sidewalk, {}});
    }
  }

  /// Whether the block can hold lots at all.
  bool holds_lots() const { return is_fit(whole_, least_block_angle, 6.0); }

  void cut() {
    if (lots_.division == CityDivision::none) {
      pieces_.push_back(whole_);
    } else {
      cut(whole_, 0);
    }
  }

  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<SharedEdge>& edges() const { return edges_; }
  const Piece& whole() const { return whole_; }

  /// The outline of a piece with the corners of all neighbours.
  CmRing outline(const Piece& piece) const {
    CmRing ring;
    for (std::size_t i = 0; i < piece.ring.size(); ++i) {
      const CmPoint &from = piece.ring[i], &to = piece.ring[(i + 1) % piece.ring.size()];
      ring.push_back(from);
      const std::vector<CmPoint> added = edges_[piece.edges[i]].between(from, to);
      ring.insert(ring.end(), added.begin(), added.end());
    }
    return ring;
  }

 private:
  double frontage(const Piece& piece) const {
    double sum = 0;
    for (std::size_t i = 0; i < piece.ring.size(); ++i) {
      if (edges_[piece.edges[i]].street != no_index)
        sum += distance(piece.ring[i], piece.ring[(i + 1) % piece.ring.size()]);
    }
    return sum;
  }

  bool is_fit(const Piece& piece, double angle, double aspect) const {
    const double width = lots_.width * 100 + 3;
    if (static_cast<double>(doubled_area(piece.ring)) < 2e4 * lots_.area[0]) return false;
    if (frontage(piece) < width) return false;
    if (sharpest_cosine(piece.ring) > math::cos(math::radians(angle))) return false;
    const LeastBox box = least_box(piece.ring);
    return box.short_side >= width && box.long_side <= aspect * box.short_side;
  }

  void cut(const Piece& piece, int depth) {
    const double area = static_cast<double>(doubled_area(piece.ring)) / 2e4;
    Rng draw = rng_.at(piece.key);
    const double most = lots_.area[1] * draw.uniform(0.75, 1);
    Piece left, right;
    if (area > most && depth < deepest && find_cut(piece, draw, left, right)) {
      left.key = key_at(piece.key, 0);
      right.key = key_at(piece.key, 1);
      cut(left, depth + 1);
      cut(right, depth + 1);
      return;
    }
    pieces_.push_back(piece);
  }

  bool find_cut(const Piece& piece, Rng& draw, Piece& left, Piece& right) {
    const LeastBox box = least_box(piece.ring);
    const dvec2 along = box.long_direction, across(-along.y, along.x);
    const std::array<double, 8> shares = {
        0.5 + lots_.irregularity * 0.5 * (draw.unit() - 0.5), 0.5, 0.4, 0.6, 1 / 3.0, 2 / 3.0, 0.25, 0.75};
    for (const bool is_across : {true, false}) {
      const dvec2 direction = is_across ? across : along;
      const dvec2 step = is_across ? along * box.long_side : across * box.short_side;
      for (const double share : shares) {
        if (try_cut(piece, box.centre + step * (share - 0.5), direction, left, right)) return true;
      }
    }
    return false;
  }

  /// Where a line meets a piece: at a corner, or within the edge behind it.
  struct Meeting {
    std::size_t corner = 0;
    bool is_corner = false;
    CmPoint at{};
  };

  /// Cuts along a line that meets the outline exactly twice.
  bool try_cut(const Piece& piece, const dvec2& origin, const dvec2& direction, Piece& left, Piece& right) {
    const std::size_t count = piece.ring.size();
    const dvec2 normal(-direction.y, direction.x);
    std::vector<double> off;
    for (const CmPoint& p : piece.ring) off.push_back(glm::dot(in_cm(p) - origin, normal));
    std::vector<Meeting> meetings;
    for (std::size_t i = 0; i < count; ++i) {
      const double here = off[i], next = off[(i + 1) % count];
      if (std::abs(here) <= near_line) {
        const double before = off[(i + count - 1) % count];
        if (std::abs(before) <= near_line || std::abs(next) <= near_line) return false;  // along the line
        if ((before > 0) != (next > 0)) meetings.push_back({i, true, piece.ring[i]});
        continue;
      }
      if (std::abs(next) <= near_line || (here > 0) == (next > 0)) continue;
      const CmPoint &a = piece.ring[i], &b = piece.ring[(i + 1) % count];
      const dvec2 at = in_cm(a) + (in_cm(b) - in_cm(a)) * (here / (here - next));
      const CmPoint p = rounded_cm(at);
      if (distance(p, a) < near_corner) {
        meetings.push_back({i, true, a});
      } else if (distance(p, b) < near_corner) {
        meetings.push_back({(i + 1) % count, true, b});
      } else {
        meetings.push_back({i, false, p});
      }
    }
    if (meetings.size() != 2) return false;
    left = side_of(piece, meetings[0], meetings[1]);
    right = side_of(piece, meetings[1], meetings[0]);
    if (left.ring.size() < 3 || right.ring.size() < 3) return false;
    if (!is_simple(left.ring) || !is_simple(right.ring) || !is_fit(left, least_angle, greatest_aspect) ||
        !is_fit(right, least_angle, greatest_aspect))
      return false;
    const auto edge = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({meetings[0].at, meetings[1].at, no_index, no_index, {}});
    left.edges.back() = right.edges.back() = edge;
    for (const Meeting& meeting : meetings) {
      if (!meeting.is_corner) edges_[piece.edges[meeting.corner]].added.push_back(meeting.at);
    }
    return true;
  }

  /// The part of the outline from one meeting to the other, closed by an edge that is not numbered yet. Until
  /// then the closing edge counts as one without a street.
  Piece side_of(const Piece& piece, const Meeting& from, const Meeting& to) {
    const std::size_t count = piece.ring.size();
    Piece part;
    part.ring.push_back(from.at);
    part.edges.push_back(piece.edges[from.corner]);
    std::size_t i = (from.corner + 1) % count;
    const std::size_t last = to.is_corner ? (to.corner + count - 1) % count : to.corner;
    if (from.corner != last) {
      for (;; i = (i + 1) % count) {
        part.ring.push_back(piece.ring[i]);
        part.edges.push_back(piece.edges[i]);
        if (i == last || part.ring.size() > count + 1) break;
      }
    }
    part.ring.push_back(to.at);
    part.edges.push_back(inner_edge());
    return part;
  }

  /// An edge without a street, for pieces whose cut is not decided yet.
  std::uint32_t inner_edge() {
    if (inner_ == no_index) {
      inner_ = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({});
    }
    return inner_;
  }

  const CityLots& lots_;
  Rng rng_;
  Piece whole_;
  std::vector<SharedEdge> edges_;
  std::vector<Piece> pieces_;
  std::uint32_t inner_ = no_index;
};

/// The key of a block: its sorted nodes, here by the corners' streets.
std::uint64_t block_key(const CityPlan& plan, const BlockOutline& outline) {
  std::vector<std::uint64_t> keys;
  for (const BlockEdge& edge : outline.edges) {
    if (edge.street == no_index) continue;
    keys.push_back(plan.graph.node_key[plan.graph.edges[edge.street].from]);
    keys.push_back(plan.graph.node_key[plan.graph.edges[edge.street].to]);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  std::uint64_t key = 0xB10C;
  for (const std::uint64_t each : keys) key = key_at(key, each);
  return key;
}

/// How a block was divided, made by one thread.
struct Divided {
  std::optional<Division> division;
  bool is_park = false;
};

/// Fills in what a lot is, from its piece.
Lot lot_of(const CityPlan& plan, const Division& division, const Piece& piece) {
  Lot lot;
  lot.key = piece.key;
  lot.corners = piece.ring;
  double widest = -1, longest = -1;
  std::uint32_t first_street = no_index;
  for (std::size_t i = 0; i < piece.ring.size(); ++i) {
    const SharedEdge& edge = division.edges()[piece.edges[i]];
    if (edge.street == no_index) continue;
    const CmPoint &a = piece.ring[i], &b = piece.ring[(i + 1) % piece.ring.size()];
    const double length = distance(a, b) / 100, width = plan.class_of(edge.street).width;
    lot.frontage += length;
    lot.is_corner |= first_street != no_index && first_street != edge.street;
    first_street = edge.street;
    if (length < 3 && longest >= 3) continue;
    if (longest < 3 || width > widest || (width == widest && length > longest)) {
      widest = width;
      longest = length;
      lot.street = edge.street;
      lot.front_start = a;
      lot.front_end = b;
    }
  }
  return lot;
}

glm::dvec2 middle_of(const CmRing& ring) {
  glm::dvec2 sum{0};
  for (const CmPoint& p : ring) sum += in_metres(p);
  return sum / static_cast<double>(ring.size());
}

/// Adds the corners that cuts have added to the outline of a block to the sidewalk beside it.
void add_to_sidewalk(Part& sidewalk, const SharedEdge& edge) {
  const std::vector<CmPoint> added = edge.between(edge.b, edge.a);
  if (added.empty()) return;
  CmRing& ring = sidewalk.rings[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] != edge.b || ring[(i + 1) % ring.size()] != edge.a) continue;
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, added.begin(), added.end());
    return;
  }
}

void add_block(CityPlan& plan, const BlockOutline& outline, const Divided& divided, const FieldMap& density) {
  const Division& division = *divided.division;
  const auto number = static_cast<std::uint32_t>(plan.blocks.size());
  Block block;
  block.key = division.whole().key;
  for (const BlockEdge& edge : outline.edges) {
    if (edge.street != no_index) block.streets.push_back(edge.street);
  }
  std::sort(block.streets.begin(), block.streets.end());
  block.streets.erase(std::unique(block.streets.begin(), block.streets.end()), block.streets.end());
  block.rings.push_back(division.outline(division.whole()));
  for (const CmRing& hole : outline.holes) block.rings.push_back(hole);
  if (divided.is_park) {
    Part part;
    const bool is_small = area_of(block.rings) < 1500;
    part.kind = is_small ? PartKind::square : PartKind::park;
    part.block = number;
    part.rings = block.rings;
    plan.parts.push_back(std::move(part));
  }
  plan.blocks.push_back(std::move(block));
  if (divided.is_park) return;
  for (const SharedEdge& edge : division.edges()) {
    if (edge.sidewalk != no_index) add_to_sidewalk(plan.parts[edge.sidewalk], edge);
  }
  for (const Piece& piece : division.pieces()) {
    Lot lot = lot_of(plan, division, piece);
    lot.part = static_cast<std::uint32_t>(plan.parts.size());
    lot.density = density.at(middle_of(piece.ring));
    Part part;
    part.kind = PartKind::lot;
    part.block = number;
    part.street = lot.street;
    part.rings.push_back(division.outline(piece));
    lot.area = area_of(part.rings);
    plan.parts.push_back(std::move(part));
    plan.lots.push_back(std::move(lot));
  }
}

}  // namespace

const char* name_of(PartKind kind) {
  static constexpr const char* names[] = {"carriageway", "junction", "sidewalk", "verge",
                                          "park",        "square",   "lot"};
  return names[static_cast<std::size_t>(kind)];
}

double area_of(const std::vector<CmRing>& rings) {
  double sum = 0;
  for (const CmRing& ring : rings) sum += static_cast<double>(doubled_area(ring));
  return sum / 2e4;
}

void divide_blocks(CityPlan& plan, const std::vector<BlockOutline>& outlines, const CityLots& lots,
                   const FieldMap& density, Job& job) {
  std::vector<Divided> divided(outlines.size());
  const Rng rng = job.rng().at("lots");
  parallel_for(job, outlines.size(), blocks_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin; i < end; ++i) {
      const BlockOutline& outline = outlines[i];
      const std::uint64_t key = block_key(plan, outline);
      Divided& each = divided[i];
      each.division.emplace(outline, lots, key, rng);
      const bool is_empty = density.at(middle_of(outline.ring)) < 0.1;
      each.is_park = !outline.holes.empty() || is_empty || !each.division->holds_lots() ||
                     rng.at("park").at(key).unit() < lots.park_share;
      if (!each.is_park) each.division->cut();
    }
  });
  Meter meter(job, Resource::shapes);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    meter.spend(1 + divided[i].division->pieces().size());
    add_block(plan, outlines[i], divided[i], density);
  }
}

}  // namespace seedmesh::city
