#include "core/generators/city/division.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/math.h"
#include "core/generators/city/shape.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr double greatest_aspect = 5;
constexpr double burgage_aspect = 11;
constexpr double near_corner = 60;  // cuts that end this near to a corner end there, cm
constexpr double near_line = 3;     // corners this near to a cut's line lie on it, cm
constexpr double least_angle = 16;  // of corners that cuts make, degrees
constexpr int deepest = 40;
constexpr double least_space = 100;  // between two sides of a block, cm

}  // namespace

Division::Division(const BlockOutline& outline, const CityLots& lots, std::uint64_t key, Rng rng)
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

bool Division::holds_lots() const {
  return is_fit(whole_, least_block_angle, 6.0) && !has_narrow_part(whole_.ring, least_space);
}

void Division::cut(const Job& job) {
  const CityDivision method = lots_.division;
  std::vector<Piece> first;
  if (method == CityDivision::offset) first = strips_of(*this, lots_.offset_width * 100, job);
  if (method == CityDivision::skeleton || method == CityDivision::burgage)
    first = strips_of(*this, std::numeric_limits<double>::infinity(), job);
  if (method == CityDivision::none) {
    pieces_.push_back(whole_);
    return;
  }
  for (Piece& piece : first) {
    if (piece.is_inner) {
      pieces_.push_back(std::move(piece));
    } else {
      const LeastBox box = least_box(piece.ring);
      cut({std::move(piece), box}, 0);
    }
  }
  const bool has_strips = !first.empty() && is_partition();
  const std::size_t long_strips = has_strips ? long_pieces() : pieces_.size() + 1;
  if (long_strips == 0) return;
  // Without strips, where rounding has folded one of them, and where no cut shortens one of them.
  std::vector<Piece> strips = std::move(pieces_);
  std::vector<SharedEdge> edges;
  if (has_strips) edges = edges_;
  const std::uint32_t inner = inner_;
  reset();
  cut({whole_, least_box(whole_.ring)}, 0);
  const bool is_sound = is_partition();
  if (is_sound && (!has_strips || long_pieces() < long_strips)) return;
  if (has_strips) {
    pieces_ = std::move(strips);
    edges_ = std::move(edges);
    inner_ = inner;
    outlines_.clear();
    return;
  }
  reset();
  pieces_.push_back(whole_);
}

/// How many pieces with access are longer than lots may be.
std::size_t Division::long_pieces() const {
  const double most = lots_.division == CityDivision::burgage ? 12 : 6;
  return static_cast<std::size_t>(std::count_if(pieces_.begin(), pieces_.end(), [most](const Piece& piece) {
    const LeastBox box = least_box(piece.ring);
    return box.long_side > most * box.short_side;
  }));
}

/// Simple outlines whose edges cancel, except those of the block, cover each point of it once. Edges cancel if the sum of
/// their hashes is 0, where an edge in the opposite direction has the negative hash.
bool Division::is_partition() {
  const auto bits = [](const CmPoint& p) {
    return std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32U | static_cast<std::uint32_t>(p.y);
  };
  const auto sum_of = [&bits](const CmRing& ring) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CmPoint &a = ring[i], &b = ring[i + 1 < ring.size() ? i + 1 : 0];
      sum += a < b ? key_at(key_at(0, bits(a)), bits(b)) : 0 - key_at(key_at(0, bits(b)), bits(a));
    }
    return sum;
  };
  std::uint64_t open = sum_of(outline(whole_));
  outlines_.clear();
  outlines_.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    const CmRing& ring = outlines_.emplace_back(outline(piece));
    if (!is_simple(ring) || doubled_area(ring) <= 0) return false;
    open -= sum_of(ring);
  }
  return open == 0;
}

/// Undoes all cuts.
void Division::reset() {
  pieces_.clear();
  outlines_.clear();
  edges_.resize(whole_.ring.size());
  for (SharedEdge& edge : edges_) edge.added.clear();
  inner_ = no_index;
}

CmRing Division::outline(const Piece& piece) const {
  CmRing ring;
  ring.reserve(piece.ring.size() + 2);
  for (std::size_t i = 0; i < piece.ring.size(); ++i) {
    const CmPoint &from = piece.ring[i], &to = piece.ring[(i + 1) % piece.ring.size()];
    ring.push_back(from);
    edges_[piece.edges[i]].append_between(from, to, ring);
  }
  return ring;
}

CmRing Division::take_outline(std::size_t piece) {
  return piece < outlines_.size() ? std::move(outlines_[piece]) : outline(pieces_[piece]);
}

double Division::frontage(const Piece& piece) const {
  double sum = 0;
  for (std::size_t i = 0; i < piece.ring.size(); ++i) {
    if (edges_[piece.edges[i]].street != no_index)
      sum += distance(piece.ring[i], piece.ring[(i + 1) % piece.ring.size()]);
  }
  return sum;
}

bool Division::has_size(const Piece& piece) const {
  return static_cast<double>(doubled_area(piece.ring)) >= 2e4 * lots_.area[0] &&
         frontage(piece) >= least_width();
}

double Division::least_width() const { return lots_.width * 100 + 3; }

bool Division::is_fit(const Piece& piece, double angle, double aspect) const {
  LeastBox box;
  return has_size(piece) && has_shape(piece, math::cos(math::radians(angle)), aspect, box);
}

/// Whether a piece has its least side, no sharper corner than this cosine, and at most this aspect. Sets its box if
/// its corners are wide enough.
bool Division::has_shape(const Piece& piece, double most_cosine, double aspect, LeastBox& box) const {
  if (!is_blunt(piece.ring, most_cosine)) return false;
  box = least_box(piece.ring);
  return box.narrowest >= least_width() && box.long_side <= aspect * box.short_side;
}

/// Whether a piece is to be cut.
bool Division::is_large(const Piece& piece, const LeastBox& box, Rng& draw) const {
  const double area = static_cast<double>(doubled_area(piece.ring)) / 2e4;
  const double most = lots_.area[1] * draw.uniform(0.75, 1);
  if (lots_.division == CityDivision::burgage && frontage(piece) > lots_.width * 100 * draw.uniform(2.1, 2.6))
    return true;
  if (area > most) return true;
  // Strips are cut until they are no longer than lots.
  const double aspect = lots_.division == CityDivision::burgage ? burgage_aspect : greatest_aspect;
  return box.long_side > aspect * box.short_side;
}

void Division::cut(Cut whole, int depth) {
  Rng draw = rng_.at(whole.piece.key);
  const double usual = lots_.division == CityDivision::burgage ? burgage_aspect : greatest_aspect;
  // A piece of a strip may be long while it is shorter than the strip.
  cut_aspect_ = std::max(usual, 0.8 * whole.box.long_side / whole.box.short_side);
  const bool is_across = lots_.division == CityDivision::skeleton || lots_.division == CityDivision::burgage;
  if (depth < deepest && is_large(whole.piece, whole.box, draw)) {
    Cut left, right;
    if ((is_across && find_cut_across_front(whole.piece, draw, left, right)) ||
        find_cut(whole, draw, left, right) ||
        (!is_across && find_cut_across_front(whole.piece, draw, left, right))) {
      left.piece.key = key_at(whole.piece.key, 0);
      right.piece.key = key_at(whole.piece.key, 1);
      cut(std::move(left), depth + 1);
      cut(std::move(right), depth + 1);
      return;
    }
  }
  pieces_.push_back(std::move(whole.piece));
}

/// Cuts at right angles to the street, near the middle of the frontage.
bool Division::find_cut_across_front(const Piece& piece, Rng& draw, Cut& left, Cut& right) {
  const double whole = frontage(piece);
  const double shift = lots_.irregularity * 0.5 * (draw.unit() - 0.5);
  for (const double share : {0.5 + shift, 0.5, 0.45, 0.55, 0.4, 0.6, 1 / 3.0, 2 / 3.0, 0.25, 0.75}) {
    double left_over = whole * share;
    for (std::size_t i = 0; i < piece.ring.size(); ++i) {
      if (edges_[piece.edges[i]].street == no_index) continue;
      const dvec2 a = in_cm(piece.ring[i]), b = in_cm(piece.ring[(i + 1) % piece.ring.size()]);
      const double length = glm::length(b - a);
      if (length < left_over) {
        left_over -= length;
        continue;
      }
      const dvec2 along = (b - a) / length;
      if (try_cut(piece, a + along * left_over, {0 - along.y, along.x}, left, right)) return true;
      break;
    }
  }
  return false;
}

bool Division::find_cut(const Cut& whole, Rng& draw, Cut& left, Cut& right) {
  const LeastBox& box = whole.box;
  const dvec2 along = box.long_direction, across(-along.y, along.x);
  const std::array<double, 8> shares = {
      0.5 + lots_.irregularity * 0.5 * (draw.unit() - 0.5), 0.5, 0.4, 0.6, 1 / 3.0, 2 / 3.0, 0.25, 0.75};
  for (const bool is_across : {true, false}) {
    const dvec2 direction = is_across ? across : along;
    const dvec2 step = is_across ? along * box.long_side : across * box.short_side;
    for (const double share : shares) {
      if (try_cut(whole.piece, box.centre + step * (share - 0.5), direction, left, right)) return true;
    }
  }
  if (box.long_side <= greatest_aspect * box.short_side) return false;
  for (const double share : {0.2, 0.8, 0.3, 0.7, 0.15, 0.85, 0.45, 0.55, 0.35, 0.65}) {
    if (try_cut(whole.piece, box.centre + along * (box.long_side * (share - 0.5)), across, left, right))
      return true;
  }
  return false;
}

/// Keeps the two meetings on both sides of a position 20 cm behind the origin of the line, if there are such.
bool Division::keep_chord(std::vector<Meeting>& meetings, const dvec2& origin, const dvec2& direction) {
  if (meetings.size() < 2 || meetings.size() % 2 != 0) return false;
  constexpr double behind = 20;
  std::vector<std::pair<double, std::size_t>> along;
  for (std::size_t i = 0; i < meetings.size(); ++i)
    along.emplace_back(glm::dot(in_cm(meetings[i].at) - origin, direction), i);
  std::sort(along.begin(), along.end());
  for (std::size_t k = 0; k < along.size(); k += 2) {
    if (along[k].first > behind || along[k + 1].first < behind) continue;
    const std::size_t first = std::min(along[k].second, along[k + 1].second);
    const std::size_t last = std::max(along[k].second, along[k + 1].second);
    meetings = {meetings[first], meetings[last]};
    return true;
  }
  return false;
}

/// Finds where a line meets the outline of a piece. Nothing where it runs along an edge.
void Division::find_meetings(const Piece& piece, const dvec2& origin, const dvec2& direction) {
  const std::size_t count = piece.ring.size();
  const dvec2 normal(-direction.y, direction.x);
  std::vector<double>& off = offsets_;
  off.clear();
  meetings_.clear();
  for (const CmPoint& p : piece.ring) off.push_back(glm::dot(in_cm(p) - origin, normal));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t after = i + 1 < count ? i + 1 : 0;
    const double here = off[i], next = off[after];
    if (std::abs(here) <= near_line) {
      const double before = off[i > 0 ? i - 1 : count - 1];
      if (std::abs(before) <= near_line || std::abs(next) <= near_line) {
        meetings_.clear();
        return;
      }
      if ((before > 0) != (next > 0)) meetings_.push_back({i, true, piece.ring[i]});
      continue;
    }
    if (std::abs(next) <= near_line || (here > 0) == (next > 0)) continue;
    const CmPoint &a = piece.ring[i], &b = piece.ring[after];
    const dvec2 at = in_cm(a) + (in_cm(b) - in_cm(a)) * (here / (here - next));
    const CmPoint p = rounded_cm(at);
    if (distance(p, a) < near_corner) {
      meetings_.push_back({i, true, a});
    } else if (distance(p, b) < near_corner) {
      meetings_.push_back({after, true, b});
    } else {
      meetings_.push_back({i, false, p});
    }
  }
}

/// Cuts along a line that meets the outline twice, or along its chord at the origin.
bool Division::try_cut(const Piece& piece, const dvec2& origin, const dvec2& direction, Cut& left,
                       Cut& right) {
  static const double most_cosine = math::cos(math::radians(least_angle));
  find_meetings(piece, origin, direction);
  if (meetings_.size() != 2 && !keep_chord(meetings_, origin, direction)) return false;
  // The cheapest conditions come first, since most cuts fail by area or frontage.
  const Meeting &from = meetings_[0], &to = meetings_[1];
  if (!has_side_area(piece, from, to) || !has_side_area(piece, to, from)) return false;
  if (!has_side_frontage(piece, from, to) || !has_side_frontage(piece, to, from)) return false;
  set_side(piece, from, to, left.piece);
  set_side(piece, to, from, right.piece);
  if (!has_shape(left.piece, most_cosine, cut_aspect_, left.box) ||
      !has_shape(right.piece, most_cosine, cut_aspect_, right.box) || !is_simple(left.piece.ring) ||
      !is_simple(right.piece.ring))
    return false;
  const auto edge = static_cast<std::uint32_t>(edges_.size());
  edges_.push_back({meetings_[0].at, meetings_[1].at, no_index, no_index, {}});
  left.piece.edges.back() = right.piece.edges.back() = edge;
  for (const Meeting& meeting : meetings_) {
    if (!meeting.is_corner) edges_[piece.edges[meeting.corner]].added.push_back(meeting.at);
  }
  return true;
}

/// Calls `visit` with both ends and the number of each edge of a part of the outline, from one meeting to the other. The
/// part has no inner corner if both are on one edge; `visit` is then not called.
template <class Visit>
void Division::each_edge(const Piece& piece, const Meeting& from, const Meeting& to, const Visit& visit) {
  const std::size_t count = piece.ring.size();
  const std::size_t last = to.is_corner ? (to.corner > 0 ? to.corner - 1 : count - 1) : to.corner;
  if (from.corner == last) return;
  CmPoint start = from.at;
  for (std::size_t i = from.corner; i != last;) {
    const std::uint32_t edge = piece.edges[i];
    i = i + 1 < count ? i + 1 : 0;
    visit(start, piece.ring[i], edge);
    start = piece.ring[i];
  }
  visit(start, to.at, piece.edges[last]);
}

/// Whether the part of the outline from one meeting to the other, closed by the cut, has the least area.
bool Division::has_side_area(const Piece& piece, const Meeting& from, const Meeting& to) const {
  std::int64_t doubled = 0;
  each_edge(piece, from, to,
            [&](const CmPoint& a, const CmPoint& b, std::uint32_t) { doubled += cross(from.at, a, b); });
  return doubled > 0 && static_cast<double>(doubled) >= 2e4 * lots_.area[0];
}

/// Whether that part has the least frontage.
bool Division::has_side_frontage(const Piece& piece, const Meeting& from, const Meeting& to) const {
  double sum = 0;
  each_edge(piece, from, to, [&](const CmPoint& a, const CmPoint& b, std::uint32_t edge) {
    if (edges_[edge].street != no_index) sum += distance(a, b);
  });
  return sum >= least_width();
}

/// Makes `side` the part of the outline from one meeting to the other, closed by an edge that is not numbered yet.
/// Until then the closing edge counts as one without a street.
void Division::set_side(const Piece& piece, const Meeting& from, const Meeting& to, Piece& side) {
  const std::size_t count = piece.ring.size();
  side.ring.clear();
  side.edges.clear();
  side.ring.reserve(count + 2);
  side.edges.reserve(count + 2);
  side.ring.push_back(from.at);
  side.edges.push_back(piece.edges[from.corner]);
  std::size_t i = from.corner + 1 < count ? from.corner + 1 : 0;
  const std::size_t last = to.is_corner ? (to.corner > 0 ? to.corner - 1 : count - 1) : to.corner;
  if (from.corner != last) {
    for (;; i = i + 1 < count ? i + 1 : 0) {
      side.ring.push_back(piece.ring[i]);
      side.edges.push_back(piece.edges[i]);
      if (i == last || side.ring.size() > count + 1) break;
    }
  }
  side.ring.push_back(to.at);
  side.edges.push_back(inner_edge());
}

/// An edge without a street, for pieces whose cut is not decided yet.
std::uint32_t Division::inner_edge() {
  if (inner_ == no_index) {
    inner_ = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back({});
  }
  return inner_;
}

}  // namespace seedmesh::city
